// SPDX-License-Identifier: Apache-2.0
/// @file The runs of a sweep as HDF5. Needs the CMake target articula::sweep_hdf5.
#pragma once

#include "articula/sweep/jobs/sweep_csv.hpp"
#include "articula/text/numbers.hpp"

#include <hdf5.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace articula {

namespace detail {

/// A handle of the HDF5 library.
class Hdf5Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Hdf5Handle(hid_t id, Close close, const std::string& what) : id_(id), close_(close) {
    if (id < 0) throw std::runtime_error("HDF5: cannot write " + what);
  }
  Hdf5Handle(Hdf5Handle&& other) noexcept
      : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Hdf5Handle& operator=(Hdf5Handle&&) = delete;
  ~Hdf5Handle() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const noexcept { return id_; }  // NOLINT: the library's functions take hid_t

 private:
  hid_t id_;
  Close close_;
};

/// A column that grows.
class Hdf5Column {
 public:
  Hdf5Column(hid_t file, const std::string& name, hid_t type, const std::string& unit)
      : type_(type), name_(name), set_(make(file, name, type)) {
    if (unit.empty()) return;
    const Hdf5Handle text(H5Tcopy(H5T_C_S1), H5Tclose, name_);
    H5Tset_size(text, unit.size());
    const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose, name_);
    const Hdf5Handle attribute(H5Acreate2(set_, "unit", text, space, H5P_DEFAULT, H5P_DEFAULT),
                               H5Aclose, name_);
    check(H5Awrite(attribute, text, unit.data()));
  }

  template <class Number>
  void append(const std::vector<Number>& values) {
    const hsize_t old = size_, count = values.size();
    size_ += count;
    check(H5Dset_extent(set_, &size_));
    const Hdf5Handle space(H5Dget_space(set_), H5Sclose, name_);
    check(H5Sselect_hyperslab(space, H5S_SELECT_SET, &old, nullptr, &count, nullptr));
    const Hdf5Handle memory(H5Screate_simple(1, &count, nullptr), H5Sclose, name_);
    check(H5Dwrite(set_, type_, memory, space, H5P_DEFAULT, values.data()));
  }

 private:
  static Hdf5Handle make(hid_t file, const std::string& name, hid_t type) {
    const hsize_t none = 0, any = H5S_UNLIMITED, chunk = 4096;
    const Hdf5Handle space(H5Screate_simple(1, &none, &any), H5Sclose, name);
    const Hdf5Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, name);
    H5Pset_chunk(creation, 1, &chunk);
    H5Pset_obj_track_times(creation, 0);  // the same rows give the same file
    // A name such as damping.arm/elbow is a dataset in a group.
    const Hdf5Handle linking(H5Pcreate(H5P_LINK_CREATE), H5Pclose, name);
    H5Pset_create_intermediate_group(linking, 1);
    return {H5Dcreate2(file, name.c_str(), type, space, linking, creation, H5P_DEFAULT), H5Dclose,
            name};
  }
  void check(herr_t status) const {
    if (status < 0) throw std::runtime_error("HDF5: cannot write " + name_);
  }

  hid_t type_;
  std::string name_;
  Hdf5Handle set_;
  hsize_t size_ = 0;
};

}  // namespace detail

/// Copies the rows of SweepCsv into an HDF5 file: a dataset for each column, with its unit as an
/// attribute. /run and /seed are unsigned, /end is 0 (stable), 1 (unstable), 2 (non_finite) or
/// 3 (refused). HDF5 does not survive a crash while it writes; so rows are written as CSV, and
/// copied in the end.
/// @param csv         of a SweepCsv
/// @param parameters  of the sweep
/// @param metrics     of the sweep
/// @throws std::runtime_error naming the file or the column that cannot be read or written
/// Real-time: no (writes a file). Memory does not grow with the number of runs.
inline void write_hdf5(const std::filesystem::path& path, const std::filesystem::path& csv,
                       const std::vector<SweepParameter>& parameters,
                       const std::vector<SweepMetric>& metrics) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // errors are thrown, not printed
  const detail::Hdf5Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT),
                                H5Fclose, path.string());
  detail::Hdf5Column run(file, "run", H5T_NATIVE_UINT64, ""),
      seed(file, "seed", H5T_NATIVE_UINT64, "");
  detail::Hdf5Column end(file, "end", H5T_NATIVE_UINT64, "");
  std::vector<detail::Hdf5Column> columns;
  for (const auto& each : parameters)
    columns.emplace_back(file, each.name, H5T_NATIVE_DOUBLE, each.unit);
  for (const auto& each : metrics)
    columns.emplace_back(file, each.name, H5T_NATIVE_DOUBLE, each.unit);

  std::ifstream rows(csv);
  std::string line;
  if (!std::getline(rows, line)) throw std::runtime_error("cannot read " + csv.string());
  const auto refuse = [&] { throw std::runtime_error(csv.string() + ": not a run: " + line); };
  std::vector<std::uint64_t> runs, seeds, ends;
  std::vector<std::vector<double>> values(columns.size());
  const auto flush = [&] {
    run.append(runs);
    seed.append(seeds);
    end.append(ends);
    for (std::size_t k = 0; k < columns.size(); ++k)
      columns[k].append(values[k]), values[k].clear();
    runs.clear(), seeds.clear(), ends.clear();
  };
  while (std::getline(rows, line)) {
    std::string_view rest = line;
    const auto take = [&] {
      const std::size_t comma = rest.find(',');
      const std::string_view item = rest.substr(0, comma);
      rest.remove_prefix(comma == rest.npos ? rest.size() : comma + 1);
      return item;
    };
    const auto take_number = [&]<class Number>(Number number) {
      const std::string_view item = take();
      const auto [stop, error] = std::from_chars(item.data(), item.data() + item.size(), number);
      if (error != std::errc{} || stop != item.data() + item.size()) refuse();
      return number;
    };
    runs.push_back(take_number(std::uint64_t{}));
    seeds.push_back(take_number(std::uint64_t{}));
    const std::string_view word = take();
    const auto end_named =
        std::find(simulation_end_names.begin(), simulation_end_names.end(), word);
    if (end_named == simulation_end_names.end()) refuse();
    ends.push_back(static_cast<std::uint64_t>(end_named - simulation_end_names.begin()));
    for (auto& column : values) column.push_back(take_number(0.0));
    if (runs.size() == 4096) flush();
  }
  if (!runs.empty()) flush();
}

}  // namespace articula

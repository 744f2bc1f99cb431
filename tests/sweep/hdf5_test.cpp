// SPDX-License-Identifier: Apache-2.0
#include <articula/sweep/jobs/sweep_hdf5.hpp>

#include "catch.hpp"
#include "scratch_file.hpp"

#include <cmath>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

using namespace articula;
using detail::Hdf5Handle;
using support::ScratchFile;

namespace {

const std::vector<SweepParameter> parameters{{"mass", "1", 0, 2}, {"delay", "s", 0, 1}};
const std::vector<SweepMetric> metrics{{"elbow.overshoot", "1"}};

template <class Number>
std::vector<Number> column(const Hdf5Handle& file, const char* name, hid_t type) {
  const Hdf5Handle set(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose, name);
  const Hdf5Handle space(H5Dget_space(set), H5Sclose, name);
  std::vector<Number> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  REQUIRE(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0);
  return values;
}

}  // namespace

TEST_CASE("HDF5 has the rows of the CSV, bit for bit, and units") {
  const ScratchFile csv("rows.csv"), h5("rows.h5");
  constexpr std::uint64_t runs = 5000;  // more than are copied at once
  std::vector<double> masses, overshoots;
  {
    SweepCsv rows(csv.path(), sweep_columns(parameters, metrics));
    for (std::uint64_t k = 0; k < runs; ++k) {
      const double x = std::sin(static_cast<double>(k)) * std::exp2(double(k % 600) - 300);
      masses.push_back(x);
      overshoots.push_back(k % 7 == 0 ? std::nan("") : -x);
      rows.add({k, ~k, {x, 1e-3}, {overshoots.back()}, static_cast<SimulationEnd>(k % 3)});
    }
    rows.flush();
  }
  write_hdf5(h5.path(), csv.path(), parameters, metrics);
  const Hdf5Handle file(H5Fopen(h5.path().c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "file");
  CHECK(column<double>(file, "mass", H5T_NATIVE_DOUBLE) == masses);
  const auto read = column<double>(file, "elbow.overshoot", H5T_NATIVE_DOUBLE);
  REQUIRE(read.size() == runs);
  for (std::size_t k = 0; k < runs; ++k) {
    REQUIRE((read[k] == overshoots[k] || (std::isnan(read[k]) && std::isnan(overshoots[k]))));
  }
  CHECK(column<std::uint64_t>(file, "seed", H5T_NATIVE_UINT64)[9] == ~std::uint64_t{9});
  CHECK(column<std::uint64_t>(file, "end", H5T_NATIVE_UINT64)[8] == 2);
  const Hdf5Handle set(H5Dopen2(file, "delay", H5P_DEFAULT), H5Dclose, "delay");
  const Hdf5Handle unit(H5Aopen(set, "unit", H5P_DEFAULT), H5Aclose, "unit");
  const Hdf5Handle text(H5Aget_type(unit), H5Tclose, "type");
  std::string word(H5Tget_size(text), ' ');
  REQUIRE(H5Aread(unit, text, word.data()) >= 0);
  CHECK(word == "s");
}

TEST_CASE("files that cannot be written or are no rows are refused by name") {
  const ScratchFile csv("other.csv"), h5("other.h5");
  CHECK_THROWS_WITH(write_hdf5("/no/such/folder/a.h5", csv.path(), parameters, metrics),
                    Catch::Contains("/no/such/folder/a.h5"));
  CHECK_THROWS_WITH(write_hdf5(h5.path(), "/no/such.csv", parameters, metrics),
                    Catch::Contains("/no/such.csv"));
  std::ofstream(csv.path()) << "run,seed,end,mass,delay,elbow.overshoot\n0,1,stable,0.5,many,1\n";
  CHECK_THROWS_WITH(write_hdf5(h5.path(), csv.path(), parameters, metrics),
                    Catch::Contains("many"));
  CHECK_THROWS_WITH(SweepCsv("/no/such/folder/a.csv", {"run"}), Catch::Contains("cannot write"));
  CHECK_THROWS_WITH(SweepCsv(csv.path(), {"run"}, 1), Catch::Contains("columns"));
  CHECK_THROWS_WITH(SweepCsv(csv.path(), sweep_columns(parameters, metrics), 2),
                    Catch::Contains("1 whole lines"));
}

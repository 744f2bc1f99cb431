// SPDX-License-Identifier: Apache-2.0
/// @file A sweep's result so far in a file, from which the sweep goes on.
#pragma once

#include "articula/sweep/sweep_options.hpp"
#include "articula/sweep/sweep_result.hpp"

#include <array>
#include <bit>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace articula {

namespace detail {

/// The first word of a checkpoint.
inline constexpr std::string_view checkpoint_format = "articula-sweep-checkpoint-2";

}  // namespace detail

/// Writes a result to a file. The file has the old or the new text at all times.
/// @param identity  of the sweep
/// @throws std::runtime_error naming the file, if it cannot be written
/// Real-time: no (writes a file).
inline void write_checkpoint(const std::filesystem::path& path, const SweepResult& result,
                             std::string_view identity) {
  std::filesystem::path fresh = path;
  fresh += ".new";
  std::ofstream file(fresh, std::ios::trunc);
  const auto put = [&](auto number) { file << ' ' << number; };
  const auto put_bits = [&](double x) { put(std::bit_cast<std::uint64_t>(x)); };
  const auto put_classes = [&](const ClassCounts& classes) {
    put(classes.size());
    classes.for_each([&](std::int32_t place, std::uint64_t count) { put(place), put(count); });
  };
  file << detail::checkpoint_format << ' ' << identity;
  put(result.runs_within());
  for (const std::uint64_t count : result.ends()) put(count);
  for (const MetricSummary& summary : result.summaries()) {
    file << "\nmetric";
    put(summary.undefined);
    put_bits(summary.lowest);
    put_bits(summary.highest);
    for (const std::int64_t digit : summary.sum.digits()) put(digit);
    put(summary.sketch.zeros());
    put_classes(summary.sketch.negative());
    put_classes(summary.sketch.positive());
  }
  file << "\nworst";
  put(result.worst().size());
  for (const SweepRow& row : result.worst()) {
    file << '\n';
    put(row.number);
    put(row.seed);
    put(static_cast<int>(row.end));
    put(row.parameters.size());
    for (const double x : row.parameters) put_bits(x);
    for (const double x : row.metrics) put_bits(x);
  }
  file << "\nend\n";
  file.close();
  std::error_code error;
  if (file) std::filesystem::rename(fresh, path, error);
  if (!file || error) throw std::runtime_error("cannot write " + path.string());
}

namespace detail {

/// Reads the words of a checkpoint.
class CheckpointReader {
 public:
  explicit CheckpointReader(const std::filesystem::path& path) : path_(path), file_(path) {}

  [[noreturn]] void refuse(const std::string& reason) const {
    throw std::runtime_error(path_.string() + ": " + reason);
  }
  [[nodiscard]] std::string word() {
    std::string text;
    if (!(file_ >> text)) refuse("the checkpoint is not complete");
    return text;
  }
  void expect(std::string_view wanted) {
    if (word() != wanted) refuse("this is no checkpoint of a sweep");
  }
  template <class Number>
  [[nodiscard]] Number number() {
    const std::string text = word();
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) refuse("a number is malformed");
    return value;
  }
  [[nodiscard]] std::uint64_t count() { return number<std::uint64_t>(); }
  /// A number of things that are read one by one.
  [[nodiscard]] std::uint64_t count_up_to(std::uint64_t most) {
    const std::uint64_t value = count();
    if (value > most) refuse("a number is too large");
    return value;
  }
  [[nodiscard]] double bits() { return std::bit_cast<double>(count()); }
  [[nodiscard]] ClassCounts classes() {
    ClassCounts classes;
    for (std::uint64_t k = count_up_to(2 * ClassCounts::most + 1); k > 0; --k) {
      const auto place = number<std::int32_t>();
      if (place < -ClassCounts::most || place > ClassCounts::most)
        refuse("a class is out of range");
      classes.add(place, count());
    }
    return classes;
  }

 private:
  std::filesystem::path path_;
  std::ifstream file_;
};

}  // namespace detail

/// Reads what write_checkpoint has written.
/// @param empty     a result of the same sweep without runs
/// @param identity  of the sweep
/// @return          empty if there is no such file
/// @throws std::runtime_error naming the file, if it is damaged or belongs to another sweep
/// Real-time: no (reads a file).
[[nodiscard]] inline std::optional<SweepResult> read_checkpoint(const std::filesystem::path& path,
                                                                SweepResult empty,
                                                                std::string_view identity) {
  if (!std::filesystem::exists(path)) return {};
  detail::CheckpointReader in(path);
  if (in.word() != detail::checkpoint_format) {
    in.refuse("this is no checkpoint of this version of articula; remove it to start again");
  }
  const std::string written = in.word();
  const auto options_of = [](std::string_view word) { return word.substr(0, word.find('-')); };
  if (options_of(written) != options_of(identity)) {
    in.refuse(
        "the checkpoint belongs to another sweep; remove it to start again (articula sweep: "
        "--fresh), or choose another folder");
  }
  if (written != identity) {
    in.refuse(
        "the checkpoint has other rows than this sweep: the robot, the gains, the program (its "
        "option --compile, too) or "
        "the kind of processor has changed; remove it to start again (articula sweep: "
        "--fresh), or choose another folder");
  }
  const std::uint64_t within = in.count();
  std::array<std::uint64_t, simulation_end_names.size()> ends{};
  for (std::uint64_t& count : ends) count = in.count();
  std::vector<MetricSummary> summaries(empty.metrics().size());
  for (MetricSummary& summary : summaries) {
    in.expect("metric");
    summary.undefined = in.count();
    summary.lowest = in.bits();
    summary.highest = in.bits();
    ExactSum::Digits digits;
    for (std::int64_t& digit : digits) digit = in.number<std::int64_t>();
    summary.sum = ExactSum::from_digits(digits);
    const std::uint64_t zeros = in.count();
    auto negative = in.classes();
    summary.sketch = QuantileSketch::from_counts(std::move(negative), zeros, in.classes());
  }
  in.expect("worst");
  std::vector<SweepRow> worst(in.count_up_to(10'000));
  for (SweepRow& row : worst) {
    row.number = in.count();
    row.seed = in.count();
    row.end = static_cast<SimulationEnd>(in.count_up_to(simulation_end_names.size() - 1));
    row.parameters.resize(in.count_up_to(10'000));
    row.metrics.resize(summaries.size());
    for (double& x : row.parameters) x = in.bits();
    for (double& x : row.metrics) x = in.bits();
  }
  in.expect("end");
  empty.restore(within, ends, std::move(summaries), std::move(worst));
  return empty;
}

}  // namespace articula

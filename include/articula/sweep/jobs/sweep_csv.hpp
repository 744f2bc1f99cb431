// SPDX-License-Identifier: Apache-2.0
/// @file The runs of a sweep as CSV.
#pragma once

#include "articula/core/refuse.hpp"
#include "articula/sweep/row_text.hpp"
#include "articula/sweep/sampling/sweep_parameter.hpp"
#include "articula/sweep/sweep_experiment.hpp"
#include "articula/sweep/sweep_result.hpp"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace articula {

/// The names of a table of runs: run, seed, end, the parameters, the metrics.
/// @throws std::invalid_argument naming one that has a comma, a quotation mark or a backslash
[[nodiscard]] inline std::vector<std::string> sweep_columns(
    const std::vector<SweepParameter>& parameters, const std::vector<SweepMetric>& metrics) {
  std::vector<std::string> names{"run", "seed", "end"};
  for (const SweepParameter& parameter : parameters) names.push_back(parameter.name);
  for (const SweepMetric& metric : metrics) names.push_back(metric.name);
  for (const std::string& name : names) {
    if (name.find_first_of(",'\"`\\\n") == std::string::npos) continue;
    detail::refuse(
        {"sweep: the column ", name,
         " has a comma, a quotation mark or a backslash; expected another name in the robot"});
  }
  return names;
}

/// Writes runs to a CSV file: a header, then a line for each run in the order of their numbers.
class SweepCsv {
 public:
  /// Opens a file, or goes on with one.
  /// @param names  of the columns, from sweep_columns
  /// @param runs   that the file keeps, from the first; lines beyond them are removed
  /// @throws std::runtime_error naming the file, if it cannot be written, has another header or
  ///         fewer lines
  SweepCsv(std::filesystem::path path, const std::vector<std::string>& names,
           std::uint64_t runs = 0)
      : path_(std::move(path)) {
    std::string header;
    for (const std::string& name : names) header += (header.empty() ? "" : ",") + name;
    if (runs > 0) keep(header, runs);
    file_.open(path_, runs > 0 ? std::ios::app : std::ios::trunc);
    if (runs == 0) file_ << header << '\n';
    flush();
  }

  /// Adds a run. Real-time: no (writes a file).
  void add(const SweepRow& row) {
    line_.clear();
    append_row(line_, row);
    add_lines(line_);
  }
  /// Adds runs that append_row has written. Real-time: no (writes a file).
  void add_lines(std::string_view lines) {
    file_.write(lines.data(), static_cast<std::streamsize>(lines.size()));
  }
  /// Hands all lines to the system.
  /// @throws std::runtime_error naming the file, if it cannot be written
  void flush() {
    if (!file_.flush()) throw std::runtime_error("cannot write " + path_.string());
  }

 private:
  void keep(const std::string& header, std::uint64_t runs) const {
    std::ifstream file(path_);
    std::string line;
    if (!file) {
      throw std::runtime_error(
          path_.string() + " cannot be read, and the checkpoint has its first " +
          std::to_string(runs) + " runs; remove the checkpoint to start again");
    }
    if (!std::getline(file, line) || line != header) {
      throw std::runtime_error(path_.string() + " does not have the columns of this sweep");
    }
    for (std::uint64_t k = 0; k < runs; ++k) {
      if (std::getline(file, line) && !file.eof()) continue;
      throw std::runtime_error(path_.string() + " has " + std::to_string(k) +
                               " whole lines of runs, and the checkpoint " + std::to_string(runs));
    }
    std::filesystem::resize_file(path_, static_cast<std::uintmax_t>(file.tellg()));
  }

  std::filesystem::path path_;
  std::ofstream file_{};
  std::string line_{};
};

}  // namespace articula

// SPDX-License-Identifier: Apache-2.0
/// @file Reads recorded cycles from a CSV file.
#pragma once

#include "articula/command/command_parts.hpp"
#include "articula/model/robot.hpp"
#include "articula/recording/recording.hpp"

#include <charconv>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace articula {

namespace detail {

/// The rows of a CSV file, whose cells are found by the beginning of their column's name.
class CsvTable {
 public:
  explicit CsvTable(const std::filesystem::path& path)
      : path_(path.string()), file_(path, std::ios::binary) {
    if (!next()) throw std::runtime_error("cannot read " + path_);
    header_ = line_;
    columns_ = cells_of(header_);
  }

  /// Takes the next row that is complete.
  [[nodiscard]] bool next() {
    ++row_;
    if (!std::getline(file_, line_) || file_.eof()) return false;
    cells_ = cells_of(line_);
    if (!columns_.empty() && cells_.size() != columns_.size()) {
      refuse("has " + std::to_string(cells_.size()) + " cells, but the header has " +
             std::to_string(columns_.size()));
    }
    return true;
  }

  /// The index of a column: its name is this text, or begins with it and goes on with " [".
  [[nodiscard]] std::size_t column(const std::string& name) const {
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (columns_[i] == name || columns_[i].starts_with(name + " [")) return i;
    }
    throw std::runtime_error(path_ + " has no column '" + name +
                             "': it was recorded for another robot or kind of command, or by an "
                             "older version");
  }

  [[nodiscard]] std::string_view text(std::size_t column) const { return cells_[column]; }
  template <class T = double>
  [[nodiscard]] T number(std::size_t column) const {
    const std::string_view cell = cells_[column];
    T value{};
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc() || end != cell.data() + cell.size()) {
      refuse("has '" + std::string(cell) + "' where a number is expected");
    }
    return value;
  }
  [[nodiscard]] Status status(std::size_t column) const {
    for (int k = 0; k <= static_cast<int>(Status::inactive); ++k) {
      if (to_string(static_cast<Status>(k)) == cells_[column]) return static_cast<Status>(k);
    }
    refuse("has '" + std::string(cells_[column]) + "' where a status is expected");
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw std::runtime_error(path_ + ": line " + std::to_string(row_) + " " + what);
  }
  [[nodiscard]] static std::vector<std::string_view> cells_of(std::string_view line) {
    std::vector<std::string_view> cells;
    for (std::size_t end = 0; end != line.npos;) {
      end = line.find(',');
      cells.push_back(line.substr(0, end));
      if (end != line.npos) line.remove_prefix(end + 1);
    }
    return cells;
  }

  std::string path_;
  std::ifstream file_;
  std::string header_{}, line_{};
  std::vector<std::string_view> columns_{}, cells_{};
  std::size_t row_ = 0;
};

}  // namespace detail

/// Reads a file of CsvWriter, with the same bits. The file has no changes of the loop: add those to
/// the recording. A last line without its end is left out.
/// @tparam Command  of the recorded loop
/// @param robot     whose loop was recorded
/// @param path      of the file
/// @throws std::runtime_error naming file and line, if the file cannot be read, or a column is
///         missing or has no number
/// Real-time: no (allocates, calls the system, throws).
template <class Command, Robot R>
[[nodiscard]] Recording<joint_count<R>, Command> read_csv_recording(
    const R& robot, const std::filesystem::path& path) {
  constexpr int N = joint_count<R>;
  using Record = CycleRecord<N, Command>;
  detail::CsvTable table(path);

  // Each joint's columns are one after the other, in the order of CsvWriter.
  std::vector<std::size_t> first(static_cast<std::size_t>(N));
  std::string last_column = "command";
  const Command sample;
  const auto parts = parts_of(sample);
  if (parts.size() > 1) (last_column += ' ') += to_string(parts.back().quantity);
  for (int j = 0; j < N; ++j) {
    const std::string name(model_of(robot).joints[static_cast<std::size_t>(j)].name.view());
    first[static_cast<std::size_t>(j)] = table.column(name + " position");
    if (table.column(name + " " + last_column) !=
        table.column(name + " position") + 6 + parts.size()) {
      static_cast<void>(table.column(name + " command of this loop"));  // refuses
    }
  }
  const std::size_t latency = table.column("latency"), input = table.column("read");

  Recording<N, Command> recording;
  while (table.next()) {
    Record record;
    record.cycle = table.number<std::uint64_t>(0);
    record.time = table.number(1);
    record.status = table.status(2);
    for (int j = 0; j < N; ++j) {
      std::size_t column = first[static_cast<std::size_t>(j)];
      for (auto* vector : {&record.state.position, &record.state.velocity, &record.state.effort,
                           &record.reference.position, &record.reference.velocity,
                           &record.reference.acceleration, &record.reference.effort}) {
        (*vector)[j] = table.number(column++);
      }
      for (const auto& part : parts) {
        (*part_of(record.command, part.quantity))[j] = table.number(column++);
      }
    }
    const auto nanoseconds = [&](std::size_t column) {
      return std::chrono::nanoseconds(std::llround(table.number(column) * 1e9));
    };
    record.timing = {nanoseconds(latency), nanoseconds(latency + 1), nanoseconds(latency + 2)};
    record.input = {.read = table.status(input),
                    .write = table.status(input + 1),
                    .request = static_cast<LoopRequest>(table.number<unsigned>(input + 3)),
                    .change = table.status(input + 2),
                    .posted = table.number<unsigned>(input + 4) != 0,
                    .overruns = table.number<std::uint32_t>(input + 5),
                    .missed = table.number<std::uint64_t>(input + 6)};
    recording.cycles.push_back(record);
  }
  return recording;
}

}  // namespace articula

// SPDX-License-Identifier: Apache-2.0
/// @file Writes recorded cycles to an MCAP file. Needs nlohmann-json (target articula::recording).
#pragma once

#include "articula/recording/change_json.hpp"
#include "articula/recording/loop_change.hpp"
#include "articula/recording/mcap_writer.hpp"
#include "articula/recording/record_json.hpp"

#include <chrono>
#include <cmath>
#include <filesystem>
#include <span>

namespace articula {

/// Writes recorded cycles to an MCAP file, as JSON messages of the topic "cycle". Their time stamps
/// are the loop's time, which begins at 0. The destructor completes the file; close() also reports
/// errors.
/// @tparam R            the robot
/// @tparam CommandType  of the loop
template <Robot R, class CommandType>
class McapRecordWriter {
 public:
  using Record = CycleRecord<joint_count<R>, CommandType>;

  /// @param robot     whose loop is recorded
  /// @param path      of the file
  /// @param contents  what is written in addition to the commanded joints
  /// @throws std::runtime_error naming the file and the reason, if it cannot be written
  /// @throws std::invalid_argument if the robot has no link of a name
  /// Real-time: no (allocates, calls the system); likewise all functions of this class.
  McapRecordWriter(const R& robot, const std::filesystem::path& path,
                   const RecordContents& contents = {})
      : robot_(robot),
        extras_(robot, contents),
        writer_(path, "cycle", "articula.Cycle",
                schema_of(record_json(robot, Record(), extras_)).dump()) {}
  explicit McapRecordWriter(const std::filesystem::path& path, const RecordContents& contents = {})
    requires DescribedRobot<R>
      : McapRecordWriter(R(), path, contents) {}

  /// Writes one record, with the changes of the loop that were made before this cycle, if any, as
  /// its member "changes".
  /// @throws std::runtime_error if it cannot be written
  void write(const Record& record, std::span<const LoopChange> changes = {}) {
    Json json = record_json(robot_, record, extras_);
    for (const LoopChange& change : changes) json["changes"].push_back(change_json(change));
    writer_.write(std::chrono::nanoseconds(std::llround(record.time * 1e9)), json.dump());
  }

  /// Completes the file. Does nothing if it is closed already.
  /// @throws std::runtime_error if not all could be written
  void close() { writer_.close(); }

 private:
  [[no_unique_address]] R robot_;
  RecordExtras<R> extras_;
  McapWriter writer_;
};

}  // namespace articula

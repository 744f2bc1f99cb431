// SPDX-License-Identifier: Apache-2.0
/// @file Reads a recording from an MCAP file. Needs nlohmann-json (target articula::recording).
#pragma once

#include "articula/recording/change_json.hpp"
#include "articula/recording/mcap_reader.hpp"
#include "articula/recording/record_from_json.hpp"
#include "articula/recording/recording.hpp"

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace articula {

/// Reads a file of McapRecordWriter, with the same bits:
///
///     const auto recording = read_mcap_recording<EffortCommand<2>>(Q2d(), "motion.mcap");
///
/// Infinite numbers come back as NaN, since JSON has neither.
/// @tparam Command  of the recorded loop
/// @param robot     whose loop was recorded
/// @param path      of the file
/// @throws std::runtime_error naming the file and the record, if the file cannot be read or was
///         written by another program
/// @throws std::runtime_error likewise, if it was written for another robot or kind of command
/// Real-time: no (allocates, calls the system, throws).
template <class Command, Robot R>
[[nodiscard]] Recording<joint_count<R>, Command> read_mcap_recording(
    const R& robot, const std::filesystem::path& path) {
  Recording<joint_count<R>, Command> recording;
  McapReader(path).read([&](std::uint64_t, std::string_view message) {
    try {
      const Json json = Json::parse(message, nullptr, false);
      if (json.is_discarded()) {
        throw std::runtime_error("it is not JSON: a file of 'record --ros' cannot be replayed");
      }
      recording.cycles.push_back(record_from_json<Command>(robot, json));
      if (!json.contains("changes")) return;
      for (const Json& change : json.at("changes")) {
        recording.changes.push_back(change_of_json(recording.cycles.back().cycle, change));
      }
    } catch (const std::exception& error) {
      throw std::runtime_error(path.string() + ", record " +
                               std::to_string(recording.cycles.size() + 1) + ": " + error.what());
    }
  });
  return recording;
}

}  // namespace articula

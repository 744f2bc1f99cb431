// SPDX-License-Identifier: Apache-2.0
/// @file The last message of each topic of a view, for clients that subscribe later.
#pragma once

#include "articula/remote/port.hpp"
#include "articula/view/protocol/messages/frame.hpp"
#include "articula/view/view_options.hpp"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

namespace articula::view {

/// The texts that every new client gets, and the last messages of topics that change seldom.
struct Latest {
  static constexpr std::size_t log_length = 100;

  /// Writes the texts that do not change.
  /// @param session_id  differs between runs of the program
  Latest(const remote::RobotSheet& robot, const std::string& session_id);

  SharedText server_info{};
  SharedText advertise{};
  SharedText advertise_services{};
  SharedText robot_description{};  ///< message of the topic

  remote::Situation situation{};
  std::uint64_t situation_version = 0;  ///< grows with each change
  SharedText statistics{};              ///< message of the topic; null before the first
  std::deque<SharedText> log{};         ///< messages of the topic, the oldest first
  WallTime now = 0;
};

}  // namespace articula::view

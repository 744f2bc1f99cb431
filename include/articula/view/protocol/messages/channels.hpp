// SPDX-License-Identifier: Apache-2.0
/// @file The topics that a view publishes.
#pragma once

#include "articula/view/protocol/json/json.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace articula::view {

/// The topics. The number of a channel in the protocol is that of its topic plus 1.
enum class Topic : unsigned char {
  joint_states,       ///< the newest state
  transforms,         ///< the newest placements of the links
  robot_description,  ///< the URDF
  cycles,             ///< every cycle
  situation,          ///< mode, operator, controllers
  statistics,         ///< of the run
  log,                ///< events
  ros_joint_states,   ///< the newest state, as a message of ROS 2
  ros_reference,      ///< the newest reference, likewise
  ros_command,        ///< the newest command, likewise
};

inline constexpr std::size_t topic_count = 10;

/// What is published under a topic.
struct Channel {
  std::string_view topic{};
  std::string_view schema_name{};
  std::string_view schema{};  ///< of its messages
  std::string_view encoding = "json";
  std::string_view schema_encoding = "jsonschema";
};

/// The channel of a topic.
[[nodiscard]] const Channel& channel_of(Topic topic);

/// The entry of a topic in the protocol's "advertise".
[[nodiscard]] Json advertisement_of(Topic topic);

}  // namespace articula::view

// SPDX-License-Identifier: Apache-2.0
/// @file The topics that a view publishes.
#pragma once

#include "articula/view/protocol/json.hpp"

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
};

inline constexpr std::size_t topic_count = 7;

/// What is published under a topic.
struct Channel {
  std::string_view topic{};
  std::string_view schema_name{};
  std::string_view schema{};  ///< JSON schema of its messages
};

/// The channel of a topic.
[[nodiscard]] const Channel& channel_of(Topic topic);

/// The entry of a topic in the protocol's "advertise".
[[nodiscard]] Json advertisement_of(Topic topic);

}  // namespace articula::view

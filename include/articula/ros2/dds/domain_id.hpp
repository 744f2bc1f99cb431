// SPDX-License-Identifier: Apache-2.0
/// @file The domain that the environment names, as ROS programs read it.
#pragma once

#include "articula/core/refuse.hpp"

#include <charconv>
#include <cstdlib>
#include <string_view>
#include <system_error>

namespace articula::ros2 {

/// The domain that a text names. ROS takes an empty text for 0.
/// @throws std::invalid_argument if the text is not a whole number within 0 .. 232
/// Real-time: no (throws).
[[nodiscard]] inline unsigned domain_id(std::string_view text) {
  unsigned domain = 0;
  if (text.empty()) return domain;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), domain);
  if (error != std::errc() || end != text.data() + text.size() || domain > 232) {
    articula::detail::refuse(
        {"ROS_DOMAIN_ID '", text, "' is not a whole number within 0 .. 232: set another one"});
  }
  return domain;
}

/// The domain of the environment variable ROS_DOMAIN_ID; 0 without it.
/// @throws std::invalid_argument as domain_id(text)
/// Real-time: no (throws).
[[nodiscard]] inline unsigned domain_id() {
  const char* const text = std::getenv("ROS_DOMAIN_ID");
  return domain_id(text == nullptr ? std::string_view() : text);
}

}  // namespace articula::ros2

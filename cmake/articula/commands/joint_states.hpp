// SPDX-License-Identifier: Apache-2.0
/// @file The states of the joints as a running loop sends them.
#pragma once

#include "connection.hpp"
#include "program.hpp"

#include <optional>

namespace terminal {

/// The newest states of the joints, again and again.
class JointStates {
 public:
  explicit JointStates(Connection& connection) : connection_(connection) {
    connection_.subscribe("/joint_states");
    connection_.subscribe("/ros/reference");
  }

  /// The message of /joint_states with a member "reference_position"; nothing as Connection::next.
  std::optional<Json> next(double seconds) {
    while (const auto message = connection_.next(seconds)) {
      if (message->topic == "/joint_states") {
        states_ = message->content;
      } else if (states_.is_object()) {  // of the same cycle: the reference is sent after the state
        states_["reference_position"] = message->content.at("position");
        return states_;
      }
    }
    return std::nullopt;
  }

 private:
  Connection& connection_;
  Json states_{};
};

}  // namespace terminal

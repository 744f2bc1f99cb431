// SPDX-License-Identifier: Apache-2.0
/// @file The messages that a view sends seldom, as JSON documents.
#pragma once

#include "articula/remote/port.hpp"
#include "articula/view/protocol/json/json.hpp"
#include "articula/view/protocol/messages/stream_messages.hpp"

#include <string>
#include <vector>

namespace articula::view {

/// A robot and the properties of its loop. Infinite limits are null.
[[nodiscard]] Json robot_json(const remote::RobotSheet& robot);

/// articula.Situation, for a client that has the controls or not.
/// @param operates  whether the view lets clients operate
[[nodiscard]] Json situation_json(const remote::Situation& situation, bool operates,
                                  bool you_operate);

/// articula.Statistics.
[[nodiscard]] Json statistics_json(const remote::Statistics& statistics);

/// foxglove.Log.
[[nodiscard]] Json log_json(const remote::Event& event, WallTime stamp);

/// The answer of the service /describe_parameters. Infinite bounds are null.
[[nodiscard]] Json parameters_json(const std::vector<remote::Parameter>& parameters);

}  // namespace articula::view

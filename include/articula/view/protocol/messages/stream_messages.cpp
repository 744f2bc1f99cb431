// SPDX-License-Identifier: Apache-2.0
#include "articula/view/protocol/messages/stream_messages.hpp"

#include "articula/recording/change_json.hpp"
#include "articula/ros2/message_buffer.hpp"
#include "articula/ros2/messages/sensor_msgs.hpp"
#include "articula/view/protocol/json/json.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string_view>

namespace articula::view {

namespace {

void append_integer(std::string& text, std::uint64_t x) { text += std::to_string(x); }

void append_stamp(std::string& text, WallTime stamp) {
  text += "{\"sec\":";
  append_integer(text, stamp / 1'000'000'000);
  text += ",\"nsec\":";
  append_integer(text, stamp % 1'000'000'000);
  text += '}';
}

/// Appends `name":[..]` with what `append(i)` appends for each of `count` elements.
template <class Append>
void append_array(std::string& text, std::string_view name, std::size_t count, Append&& append) {
  text += ",\"";
  text += name;
  text += "\":[";
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) text += ',';
    append(i);
  }
  text += ']';
}

/// A number of a joint; null if the cycle lacks it.
void append_element(std::string& text, const std::vector<double>& values, std::size_t joint) {
  if (joint < values.size()) {
    append_number(text, values[joint]);
  } else {
    text += "null";
  }
}

/// Appends an array for each joint, with a number of each cycle.
template <class Values>
void append_columns(std::string& text, std::string_view name, std::size_t joints,
                    std::span<const remote::Cycle> cycles, Values&& values) {
  append_array(text, name, joints, [&](std::size_t joint) {
    text += '[';
    for (std::size_t k = 0; k < cycles.size(); ++k) {
      if (k > 0) text += ',';
      append_element(text, values(cycles[k]), joint);
    }
    text += ']';
  });
}

/// Appends what else came into the cycles, in columns with the numbers of CycleInput.
void append_inputs(std::string& text, std::span<const remote::Cycle> cycles) {
  std::string columns;
  const auto append = [&](std::string_view name, auto&& value) {
    append_array(columns, name, cycles.size(), [&](std::size_t k) {
      append_integer(columns, static_cast<std::uint64_t>(value(cycles[k].input)));
    });
  };
  append("read", [](const CycleInput& input) { return input.read; });
  append("write", [](const CycleInput& input) { return input.write; });
  append("request", [](const CycleInput& input) { return input.request; });
  append("change", [](const CycleInput& input) { return input.change; });
  append("posted", [](const CycleInput& input) { return input.posted; });
  append("overruns", [](const CycleInput& input) { return input.overruns; });
  append("missed", [](const CycleInput& input) { return input.missed; });
  text += ",\"input\":{";
  text += std::string_view(columns).substr(1);
  text += '}';
}

/// Appends the changes of the controller, each with the number of its cycle.
void append_changes(std::string& text, std::span<const remote::Cycle> cycles) {
  Json all = Json::array();
  for (const remote::Cycle& cycle : cycles) {
    for (const LoopChange& change : cycle.changes) {
      all.push_back({{"cycle", cycle.number}, {"change", change_json(change)}});
    }
  }
  text += ",\"changes\":";
  text += to_text(all);
}

void append_member(std::string& text, std::string_view before, double x) {
  text += before;
  append_number(text, x);
}

using RosStates = ros2::sensor_msgs::msg::JointState<ros2::Jazzy>;

/// A message with the names of the joints that take commands.
RosStates ros_states(const remote::RobotSheet& robot, WallTime stamp) {
  RosStates message;
  message.header.stamp = {static_cast<std::int32_t>(stamp / 1'000'000'000),
                          static_cast<std::uint32_t>(stamp % 1'000'000'000)};
  for (const remote::SheetJoint& joint : robot.joints) message.name.push_back(joint.name);
  return message;
}

std::string ros_bytes(const RosStates& message) {
  ros2::MessageBuffer buffer;
  const ros2::Sample bytes = buffer.encode(message);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};  // NOLINT: bytes
}

}  // namespace

std::string ros_states_message(const remote::RobotSheet& robot, const remote::Cycle& cycle,
                               WallTime stamp) {
  RosStates message = ros_states(robot, stamp);
  // Readers want a number for each name. A number that the cycle lacks is NaN.
  const auto of_all = [&](std::vector<double> values, auto&& of_mimic) {
    values.resize(robot.joints.size(), std::numeric_limits<double>::quiet_NaN());
    for (const remote::SheetMimic& mimic : robot.mimics) {
      values.push_back(of_mimic(mimic, values[static_cast<std::size_t>(mimic.joint)]));
    }
    return values;
  };
  using Mimic = const remote::SheetMimic&;
  for (Mimic mimic : robot.mimics) message.name.push_back(mimic.name);
  message.position = of_all(
      cycle.position, [](Mimic mimic, double q) { return mimic.multiplier * q + mimic.offset; });
  message.velocity =
      of_all(cycle.velocity, [](Mimic mimic, double v) { return mimic.multiplier * v; });
  message.effort = of_all(cycle.effort, [](Mimic, double) { return 0.0; });
  return ros_bytes(message);
}

std::string ros_reference_message(const remote::RobotSheet& robot, const remote::Cycle& cycle,
                                  WallTime stamp) {
  RosStates message = ros_states(robot, stamp);
  message.position = cycle.reference_position;
  message.velocity = cycle.reference_velocity;
  message.effort = cycle.reference_effort;
  return ros_bytes(message);
}

std::string ros_command_message(const remote::RobotSheet& robot, const remote::Cycle& cycle,
                                WallTime stamp) {
  RosStates message = ros_states(robot, stamp);
  for (std::size_t i = 0; i < std::min(robot.commands.size(), cycle.command.size()); ++i) {
    const std::string& quantity = robot.commands[i];
    if (quantity == "position") message.position = cycle.command[i];
    if (quantity == "velocity") message.velocity = cycle.command[i];
    if (quantity == "effort") message.effort = cycle.command[i];
  }
  return ros_bytes(message);
}

std::string joint_states_message(const remote::RobotSheet& robot, const remote::Cycle& cycle,
                                 WallTime stamp) {
  std::string text = "{\"header\":{\"stamp\":";
  append_stamp(text, stamp);
  text += ",\"frame_id\":\"\"}";
  const std::size_t joints = robot.joints.size(), count = joints + robot.mimics.size();
  append_array(text, "name", count, [&](std::size_t i) {
    append_string(text, i < joints ? robot.joints[i].name : robot.mimics[i - joints].name);
  });
  // A mimic joint moves with the mimicked one. The effort of both is measured at that one.
  const auto append_all = [&](std::string_view name, const std::vector<double>& values,
                              auto&& of_mimic) {
    append_array(text, name, count, [&](std::size_t i) {
      if (i < joints) return append_element(text, values, i);
      const remote::SheetMimic& mimic = robot.mimics[i - joints];
      const auto mimicked = static_cast<std::size_t>(mimic.joint);
      append_number(text, of_mimic(mimic, mimicked < values.size() ? values[mimicked] : 0));
    });
  };
  using Mimic = const remote::SheetMimic&;
  append_all("position", cycle.position,
             [](Mimic mimic, double q) { return mimic.multiplier * q + mimic.offset; });
  append_all("velocity", cycle.velocity,
             [](Mimic mimic, double v) { return mimic.multiplier * v; });
  append_all("effort", cycle.effort, [](Mimic, double) { return 0.0; });
  text += '}';
  return text;
}

std::string transforms_message(const std::vector<remote::LinkPose>& poses, const std::string& root,
                               WallTime stamp) {
  std::string text = "{\"transforms\":[";
  bool first = true;
  for (const remote::LinkPose& pose : poses) {
    if (pose.link == root) continue;
    text += first ? "{\"timestamp\":" : ",{\"timestamp\":";
    first = false;
    append_stamp(text, stamp);
    text += ",\"parent_frame_id\":";
    append_string(text, root);
    text += ",\"child_frame_id\":";
    append_string(text, pose.link);
    append_member(text, ",\"translation\":{\"x\":", pose.translation[0]);
    append_member(text, ",\"y\":", pose.translation[1]);
    append_member(text, ",\"z\":", pose.translation[2]);
    append_member(text, "},\"rotation\":{\"x\":", pose.rotation[0]);
    append_member(text, ",\"y\":", pose.rotation[1]);
    append_member(text, ",\"z\":", pose.rotation[2]);
    append_member(text, ",\"w\":", pose.rotation[3]);
    text += "}}";
  }
  text += "]}";
  return text;
}

std::string cycles_message(const remote::RobotSheet& robot, std::span<const remote::Cycle> cycles,
                           std::uint64_t dropped) {
  using remote::Cycle;
  const std::size_t joints = robot.joints.size();
  std::string text = "{\"dropped\":";
  append_integer(text, dropped);
  const auto append_scalars = [&](std::string_view name, auto&& append) {
    append_array(text, name, cycles.size(), [&](std::size_t k) { append(cycles[k]); });
  };
  append_scalars("number", [&](const Cycle& cycle) { append_integer(text, cycle.number); });
  append_scalars("time", [&](const Cycle& cycle) { append_number(text, cycle.time); });
  append_scalars("status", [&](const Cycle& cycle) {
    append_integer(text, static_cast<std::uint64_t>(cycle.status));
  });
  append_scalars("latency", [&](const Cycle& cycle) { append_number(text, cycle.latency); });
  append_scalars("period", [&](const Cycle& cycle) { append_number(text, cycle.period); });
  append_scalars("update", [&](const Cycle& cycle) { append_number(text, cycle.update); });
  const auto append_joints = [&](std::string_view name, std::vector<double> Cycle::* values) {
    append_columns(text, name, joints, cycles,
                   [values](const Cycle& cycle) -> const auto& { return cycle.*values; });
  };
  append_joints("position", &Cycle::position);
  append_joints("velocity", &Cycle::velocity);
  append_joints("effort", &Cycle::effort);
  append_joints("reference_position", &Cycle::reference_position);
  append_joints("reference_velocity", &Cycle::reference_velocity);
  append_joints("reference_acceleration", &Cycle::reference_acceleration);
  append_joints("reference_effort", &Cycle::reference_effort);
  std::string commands;
  text += ",\"command\":{";
  for (std::size_t c = 0; c < robot.commands.size(); ++c) {
    static const std::vector<double> nothing;
    commands.clear();
    append_columns(commands, robot.commands[c], joints, cycles,
                   [c](const Cycle& cycle) -> const auto& {
                     return c < cycle.command.size() ? cycle.command[c] : nothing;
                   });
    text += std::string_view(commands).substr(c == 0 ? 1 : 0);  // no comma before the first
  }
  text += '}';
  append_inputs(text, cycles);
  append_changes(text, cycles);
  text += '}';
  return text;
}

}  // namespace articula::view

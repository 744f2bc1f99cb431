// SPDX-License-Identifier: Apache-2.0
#include "articula/view/protocol/messages/channels.hpp"

#include "articula/ros2/message_text.hpp"
#include "articula/ros2/messages/sensor_msgs.hpp"

#include <string>

namespace articula::view {

namespace {

// Foxglove and PlotJuggler offer for plots what a schema names.
constexpr std::string_view joint_state_schema = R"({"type":"object","properties":{
"header":{"type":"object","properties":{"stamp":{"type":"object","properties":{"sec":{"type":"integer"},"nsec":{"type":"integer"}}},"frame_id":{"type":"string"}}},
"name":{"type":"array","items":{"type":"string"}},"position":{"type":"array","items":{"type":"number"}},
"velocity":{"type":"array","items":{"type":"number"}},"effort":{"type":"array","items":{"type":"number"}}}})";

constexpr std::string_view transforms_schema = R"({"type":"object","properties":{
"transforms":{"type":"array","items":{"type":"object","properties":{
"timestamp":{"type":"object","properties":{"sec":{"type":"integer"},"nsec":{"type":"integer"}}},
"parent_frame_id":{"type":"string"},"child_frame_id":{"type":"string"},
"translation":{"type":"object","properties":{"x":{"type":"number"},"y":{"type":"number"},"z":{"type":"number"}}},
"rotation":{"type":"object","properties":{"x":{"type":"number"},"y":{"type":"number"},"z":{"type":"number"},"w":{"type":"number"}}}}}}}})";

constexpr std::string_view text_schema =
    R"({"type":"object","properties":{"data":{"type":"string"}}})";

constexpr std::string_view cycles_schema = R"({"type":"object","properties":{
"number":{"type":"array","items":{"type":"integer"}},"time":{"type":"array","items":{"type":"number"}},
"status":{"type":"array","items":{"type":"integer"}},"latency":{"type":"array","items":{"type":"number"}},
"period":{"type":"array","items":{"type":"number"}},"update":{"type":"array","items":{"type":"number"}},
"position":{"type":"array","items":{"type":"array","items":{"type":"number"}}},
"velocity":{"type":"array","items":{"type":"array","items":{"type":"number"}}},
"effort":{"type":"array","items":{"type":"array","items":{"type":"number"}}},
"reference_position":{"type":"array","items":{"type":"array","items":{"type":"number"}}},
"reference_velocity":{"type":"array","items":{"type":"array","items":{"type":"number"}}},
"reference_acceleration":{"type":"array","items":{"type":"array","items":{"type":"number"}}},
"reference_effort":{"type":"array","items":{"type":"array","items":{"type":"number"}}},
"command":{"type":"object"},
"input":{"type":"object","properties":{"read":{"type":"array","items":{"type":"integer"}},
"write":{"type":"array","items":{"type":"integer"}},"request":{"type":"array","items":{"type":"integer"}},
"change":{"type":"array","items":{"type":"integer"}},"posted":{"type":"array","items":{"type":"integer"}},
"overruns":{"type":"array","items":{"type":"integer"}},"missed":{"type":"array","items":{"type":"integer"}}}},
"changes":{"type":"array","items":{"type":"object"}},"dropped":{"type":"integer"}}})";

constexpr std::string_view situation_schema = R"({"type":"object","properties":{
"mode":{"type":"string"},"fault":{"type":"string"},"advice":{"type":"string"},"motion":{"type":"string"},
"operator":{"type":"string"},"you_operate":{"type":"boolean"},
"controllers":{"type":"array","items":{"type":"object","properties":{"name":{"type":"string"},"status":{"type":"string"}}}},
"paused":{"type":"boolean"},"speed":{"type":"number"},"operates":{"type":"boolean"}}})";

constexpr std::string_view statistics_schema = R"({"type":"object","properties":{
"cycles":{"type":"integer"},"overruns":{"type":"integer"},"dropped":{"type":"integer"},
"latency_median":{"type":"number"},"latency_99":{"type":"number"},"latency_max":{"type":"number"},
"execution_median":{"type":"number"},"execution_99":{"type":"number"},"execution_max":{"type":"number"}}})";

constexpr std::string_view log_schema = R"({"type":"object","properties":{
"timestamp":{"type":"object","properties":{"sec":{"type":"integer"},"nsec":{"type":"integer"}}},
"level":{"type":"integer"},"message":{"type":"string"},"name":{"type":"string"},
"file":{"type":"string"},"line":{"type":"integer"}}})";

// For clients that read nothing but messages of ROS 2, as PlotJuggler.
Channel ros_channel(std::string_view topic) {
  using Message = ros2::sensor_msgs::msg::JointState<ros2::Jazzy>;
  static const std::string schema = ros2::message_text<Message>();
  return {topic, Message::ros_type.view(), schema, "cdr", "ros2msg"};
}

std::array<Channel, topic_count> make_channels() {
  return {{
      {"/joint_states", "sensor_msgs/JointState", joint_state_schema},
      {"/tf", "foxglove.FrameTransforms", transforms_schema},
      {"/robot_description", "std_msgs/String", text_schema},
      {"/cycles", "articula.Cycles", cycles_schema},
      {"/situation", "articula.Situation", situation_schema},
      {"/statistics", "articula.Statistics", statistics_schema},
      {"/log", "foxglove.Log", log_schema},
      ros_channel("/ros/joint_states"),
      ros_channel("/ros/reference"),
      ros_channel("/ros/command"),
  }};
}

}  // namespace

const Channel& channel_of(Topic topic) {
  static const std::array<Channel, topic_count> channels = make_channels();
  return channels[static_cast<std::size_t>(topic)];
}

Json advertisement_of(Topic topic) {
  const Channel& channel = channel_of(topic);
  return {{"id", static_cast<int>(topic) + 1},
          {"topic", channel.topic},
          {"encoding", channel.encoding},
          {"schemaName", channel.schema_name},
          {"schemaEncoding", channel.schema_encoding},
          {"schema", channel.schema}};
}

}  // namespace articula::view

// SPDX-License-Identifier: Apache-2.0
// Bytes that a fuzzer makes up, for the decoders of the ROS 2 messages that come in, and for the
// check of the packets that carry them.
#include <articula/ros2/cdr_decoder.hpp>
#include <articula/ros2/cdr_encoder.hpp>
#include <articula/ros2/dds/packets/packet_check.hpp>
#include <articula/ros2/messages/controller_manager_msgs.hpp>
#include <articula/ros2/messages/rcl_interfaces.hpp>
#include <articula/ros2/messages/rmw_dds_common.hpp>
#include <articula/ros2/messages/sensor_msgs.hpp>
#include <articula/ros2/messages/trajectory_msgs.hpp>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

namespace {

using namespace articula::ros2;

/// What is decoded is encoded to bytes that are decoded to the same: to the same bytes once more.
template <class M>
void check(std::span<const std::byte> bytes) {
  M message{};
  if (decode(bytes, message) != CdrError::none) return;
  // A message of many empty items has more padding than the bytes, but at most as much again.
  std::vector<std::byte> first(2 * bytes.size() + 64), second(first.size());
  const Encoded encoded = encode(message, first);
  if (encoded.error != CdrError::none) std::abort();
  first.resize(encoded.size);
  M again{};
  if (decode(first, again) != CdrError::none) std::abort();
  second.resize(encode(again, second).size);
  if (first != second) std::abort();
}

}  // namespace

// libFuzzer wants this name.
// NOLINTNEXTLINE(readability-identifier-naming)
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span bytes = std::as_bytes(std::span(data, size));
  check<sensor_msgs::msg::JointState<Jazzy>>(bytes);
  check<sensor_msgs::msg::JointState<InlineLayout<Jazzy, 7>>>(bytes);
  check<std_msgs::msg::Float64MultiArray<Jazzy>>(bytes);
  check<trajectory_msgs::msg::JointTrajectory<Jazzy>>(bytes);
  check<controller_manager_msgs::srv::SwitchController<Humble>::Request>(bytes);
  check<controller_manager_msgs::srv::SwitchController<Jazzy>::Request>(bytes);
  check<rcl_interfaces::srv::SetParameters<Jazzy>::Request>(bytes);
  check<rmw_dds_common::msg::ParticipantEntitiesInfo<Jazzy>>(bytes);
  static_cast<void>(dds::is_well_formed(bytes));
  return 0;
}

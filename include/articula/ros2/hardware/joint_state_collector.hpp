// SPDX-License-Identifier: Apache-2.0
/// @file Messages with joint states to the state of a robot.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/joint_state.hpp"
#include "articula/core/name.hpp"
#include "articula/ros2/hardware/topic_time.hpp"
#include "articula/ros2/messages/sensor_msgs.hpp"
#include "articula/ros2/node/ros_time.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace articula::ros2 {

/// The last figures of a robot's joints, and when they came.
template <int N>
struct TopicStates {
  /// The arrival of figures that have not come.
  static constexpr TopicTime never{std::chrono::nanoseconds::min() / 2,
                                   std::chrono::nanoseconds::min() / 2};

  /// No joint's figures have come.
  TopicStates() { arrival.fill(never); }
  /// The joint whose figures are oldest. Real-time: yes.
  [[nodiscard]] std::size_t oldest() const noexcept {
    return static_cast<std::size_t>(std::ranges::min_element(arrival) - arrival.begin());
  }

  JointState<N> state{};
  std::array<TopicTime, static_cast<std::size_t>(N)> arrival;
};

/// What became of a message.
enum class StatesMessage : unsigned char {
  accepted,
  foreign,    ///< It has no joint of the robot.
  malformed,  ///< Sizes differ, a joint occurs twice, or a number of the robot is no figure.
};

/// Collects the states of a robot's joints from messages with any joints in any order.
///
/// - A message of which a part is wrong is refused as a whole. NaN and infinity are wrong in
///   positions, and infinity in velocities and efforts.
/// - A velocity that is missing or NaN is the difference of two positions over that of their
///   stamps. Without stamps, arrivals are used.
/// - An effort that is missing or NaN is 0.
/// @tparam N  number of joints
template <int N>
class JointStateCollector {
 public:
  using Message = sensor_msgs::msg::JointState<Jazzy>;
  using Time = std::chrono::nanoseconds;

  /// @param names    of the joints
  /// @param wrapped  positions wrap from 2 pi to -2 pi
  JointStateCollector(const std::array<Name, static_cast<std::size_t>(N)>& names, bool wrapped)
      : names_(names), wrapped_(wrapped) {}

  /// Takes a message over.
  /// @param arrival  the present time
  /// Real-time: yes.
  StatesMessage take(const Message& message, const TopicTime& arrival) noexcept {
    const std::size_t size = message.name.size();
    if (message.position.size() != size || !fits(message.velocity, size) ||
        !fits(message.effort, size)) {
      return StatesMessage::malformed;
    }
    std::array<const double*, static_cast<std::size_t>(N)> found{};  // the joints' positions
    bool any = false;
    for (std::size_t i = 0; i < size; ++i) {
      for (std::size_t j = 0; j < found.size(); ++j) {
        if (names_[j].view() != message.name[i]) continue;
        if (found[j] != nullptr || !is_usable(message, i)) return StatesMessage::malformed;
        found[j] = &message.position[i];
        any = true;
      }
    }
    if (!any) return StatesMessage::foreign;
    const Time stamp = from_message(message.header.stamp);
    for (std::size_t j = 0; j < found.size(); ++j) {
      if (found[j] == nullptr) continue;
      const auto i = static_cast<std::size_t>(found[j] - message.position.data());
      take_joint(j, message, i, arrival, stamp.count() == 0 ? arrival.simulated : stamp);
    }
    return StatesMessage::accepted;
  }

  [[nodiscard]] const TopicStates<N>& states() const noexcept { return states_; }

 private:
  static bool fits(const std::vector<double>& values, std::size_t size) noexcept {
    return values.empty() || values.size() == size;
  }
  static bool is_usable(const Message& message, std::size_t i) noexcept {
    return is_finite(message.position[i]) &&
           (message.velocity.empty() || !std::isinf(message.velocity[i])) &&
           (message.effort.empty() || !std::isinf(message.effort[i]));
  }

  void take_joint(std::size_t j, const Message& message, std::size_t i, const TopicTime& arrival,
                  Time stamp) noexcept {
    const auto at = static_cast<Eigen::Index>(j);
    JointState<N>& state = states_.state;
    const bool is_first = states_.arrival[j] == TopicStates<N>::never;
    double position = message.position[i];
    if (wrapped_ && !is_first) {
      position =
          state.position[at] + std::remainder(position - state.position[at], 4 * std::numbers::pi);
    }
    if (!message.velocity.empty() && !std::isnan(message.velocity[i])) {
      state.velocity[at] = message.velocity[i];
    } else if (is_first) {
      state.velocity[at] = 0;
    } else if (const auto time = std::chrono::duration<double>(stamp - stamps_[j]).count();
               time > 0) {
      state.velocity[at] = (position - state.position[at]) / time;
    }
    const bool has_effort = !message.effort.empty() && !std::isnan(message.effort[i]);
    state.effort[at] = has_effort ? message.effort[i] : 0;
    state.position[at] = position;
    states_.arrival[j] = arrival;
    stamps_[j] = stamp;
  }

  std::array<Name, static_cast<std::size_t>(N)> names_;
  bool wrapped_;
  TopicStates<N> states_{};
  std::array<Time, static_cast<std::size_t>(N)> stamps_{};
};

}  // namespace articula::ros2

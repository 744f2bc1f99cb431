// SPDX-License-Identifier: Apache-2.0
/// @file A loop's last cycle, situation and references, as the bridge read them.
#pragma once

#include "articula/remote/port.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string_view>
#include <vector>

namespace articula::ros2 {

/// The reference of a cycle and its time in ROS.
struct PastReference {
  std::chrono::nanoseconds time{0};
  std::vector<double> position{};      ///< [rad or m]
  std::vector<double> velocity{};      ///< [rad/s or m/s]
  std::vector<double> acceleration{};  ///< [rad/s^2 or m/s^2]
};

/// Reads the cycles of a loop. In the thread that polls the transport. Real-time: no (allocates).
class LoopWatch {
 public:
  static constexpr std::size_t kept_references = 2000;

  /// @param port     outlives this
  /// @param session  likewise
  LoopWatch(remote::Port& port, remote::Session& session) : port_(port), session_(session) {}

  /// Reads what is new.
  /// @param now             of ROS
  /// @param has_loops_time  ROS has the loop's time
  void update(std::chrono::nanoseconds now, bool has_loops_time) {
    situation = port_.situation();
    has_loops_time_ = has_loops_time;
    const std::size_t known = references.size();
    while (session_.next(cycle)) {
      has_cycle = true;
      references.push_back({std::chrono::nanoseconds(static_cast<std::int64_t>(cycle.time * 1e9)),
                            cycle.reference_position, cycle.reference_velocity,
                            cycle.reference_acceleration});
    }
    if (!has_loops_time && references.size() > known) {
      const auto shift = now - references.back().time;
      for (std::size_t i = known; i < references.size(); ++i) references[i].time += shift;
    }
    while (references.size() > kept_references) references.pop_front();
  }

  /// The seconds of the loop in one of ROS, while a simulation is not paused.
  [[nodiscard]] double speed() const { return has_loops_time_ ? 1 : situation.speed; }
  /// The loop's time at a time of ROS that is not before the last cycle [s]. The time of a paused
  /// simulation stands still.
  [[nodiscard]] double loop_time(std::chrono::nanoseconds time) const {
    const auto since = std::chrono::duration<double>(time - references.back().time).count();
    return cycle.time + (situation.paused && !has_loops_time_ ? 0 : since * speed());
  }

  /// How long after the last cycle the present of ROS may be: two periods of the loop, and some
  /// milliseconds of messages on their way; in a paused simulation without end.
  /// @param period  of the loop [s]
  [[nodiscard]] std::chrono::nanoseconds present(double period) const {
    if (situation.paused && !has_loops_time_) return std::chrono::hours(24 * 365);
    return std::chrono::milliseconds(10) +
           std::chrono::duration_cast<std::chrono::nanoseconds>(
               std::chrono::duration<double>(2 * period / std::max(speed(), 0.01)));
  }

  /// Whether there was a cycle since the one of a number. A loop that stands still says nothing.
  [[nodiscard]] bool has_new_cycle(std::optional<std::uint64_t> known) const {
    return has_cycle && known != cycle.number;
  }

  /// Whether a controller makes commands.
  [[nodiscard]] bool is_active(std::string_view controller) const {
    return situation.mode == LoopMode::active && status_of(controller) == ControllerStatus::active;
  }
  /// The source of a joint's reference, see remote::Situation::motion.
  [[nodiscard]] std::string_view motion_of(std::size_t joint) const {
    const auto& motions = situation.joint_motions;
    return joint < motions.size() ? motions[joint] : situation.motion;
  }
  /// Whether an active controller moves a joint to the position of the reference.
  [[nodiscard]] bool follows(std::size_t joint) const {
    return joint < situation.following.size() && situation.following[joint];
  }
  /// Whether a controller has been started, even if it fails.
  [[nodiscard]] bool runs(std::string_view controller) const {
    return status_of(controller) != ControllerStatus::inactive;
  }

  remote::Situation situation{};
  remote::Cycle cycle{};  ///< the last one
  bool has_cycle = false;
  std::deque<PastReference> references{};  ///< the last ones, oldest first

 private:
  [[nodiscard]] ControllerStatus status_of(std::string_view controller) const {
    for (const ControllerInfo& info : situation.controllers) {
      if (info.name.view() == controller) return info.status;
    }
    return ControllerStatus::inactive;
  }

  remote::Port& port_;
  remote::Session& session_;
  bool has_loops_time_ = false;
};

}  // namespace articula::ros2

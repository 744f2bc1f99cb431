// SPDX-License-Identifier: Apache-2.0
/// @file A simulator of several robots that differ, one in each lane of a pack.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/hardware.hpp"
#include "articula/core/scalar.hpp"
#include "articula/dynamics/robot_lanes.hpp"
#include "articula/lanes/filled_setups.hpp"
#include "articula/lanes/lane_pack.hpp"
#include "articula/lanes/lane_setup.hpp"
#include "articula/sim/joint_dynamics.hpp"
#include "articula/sim/joint_sensors.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace articula {

/// Simulates a robot of its own in each lane: other masses, friction, stops, start, sensors, delay
/// and lost commands. Each moves as `Simulator<VariedRobot<R>>` moves it alone, up to rounding. It
/// is hardware of the described robot, which is what a controller knows. Drives take efforts.
///
/// A step is computed for all lanes together. It is computed once more alone for each lane that has
/// an event in it (a stop, friction that brings a joint to rest). No lane changes a bit of another
/// one.
/// @tparam R  the kind of robot
/// @tparam S  a pack, which has one number for each lane
template <DescribedRobot R, PackedScalar S = LanePack<R>>
class LaneSimulator {
  static_assert(detail::has_masses<R, LaneSimulator>);

 public:
  using RobotType = R;
  using Scalar = S;
  using Mask = MaskOf<S>;
  static constexpr int joint_count = articula::joint_count<R>;
  static constexpr int lane_count = lanes<S>;
  using Vector = JointVector<joint_count, S>;
  using State = JointState<joint_count, S>;
  using Command = EffortCommand<joint_count, S>;

  /// @param setups  of the first lanes, at least one; lanes without one stand still
  /// @throws std::invalid_argument naming lane, option, value and limit, if a lane cannot be
  ///         simulated, if there are too many, or if their periods or substeps differ
  explicit LaneSimulator(std::span<const LaneSetup<R>> setups)
      : LaneSimulator(setups, detail::filled_setups<R>(setups, lane_count)) {}

  /// Real-time: yes.
  [[nodiscard]] Status activate() noexcept { return active_ = true, Status::ok; }
  /// Real-time: yes.
  [[nodiscard]] Status deactivate() noexcept { return active_ = false, Status::ok; }

  /// The measurements at this moment. Real-time: yes.
  /// @param state  receives them
  /// @return       as Simulator::read, non_finite_state if that of any lane is not finite
  [[nodiscard]] Status read(State& state) noexcept {
    state = measured_;
    if (!all_of(is_finite(state))) return Status::non_finite_state;
    return active_ ? Status::ok : Status::inactive;
  }

  /// Holds efforts for one period in the lanes that move.
  /// @param command  [N m or N], clamped to the limits of each lane's drives. A lane whose command
  ///                 is not finite gets no effort.
  /// @return         Status::ok; Status::inactive after `deactivate`; Status::non_finite_command if
  ///                 that of any lane is not finite
  /// Real-time: yes. Costs `substeps` Runge-Kutta steps, and more for each lane with an event.
  [[nodiscard]] Status write(const Command& command) noexcept {
    const Mask finite = is_finite(command);
    Vector effort = within_limits(command).effort;
    for (int j = 0; j < joint_count; ++j) {
      effort[j] = active_ ? select(finite, effort[j], S(0)) : S(0);
    }
    advance(all_arrive_at_once_ ? effort : arrived(effort));
    if (!all_of(finite)) return Status::non_finite_command;
    return active_ ? Status::ok : Status::inactive;
  }

  /// The command within the effort limits of each lane's drives. Real-time: yes.
  [[nodiscard]] Command within_limits(Command command) const noexcept {
    for (int j = 0; j < joint_count; ++j) {
      const S& most = robots_.joints[j].limits.effort;
      command.effort[j] = clamp(command.effort[j], -most, most);
    }
    return command;
  }
  /// The effort limits of each lane's drives [N m or N], N x 1. Real-time: yes.
  [[nodiscard]] Vector effort_limits() const noexcept {
    return for_each_joint<joint_count, S>(
        [&](int j) noexcept { return robots_.joints[j].limits.effort; });
  }

  /// Lets a lane stand still from now on: its state is that of its start, its efforts are 0.
  /// Real-time: yes.
  void stop(int lane) noexcept {
    const Vector zero = Vector::Zero();
    set_truth(moving_, lane, false);
    set_lane(truth_.position, lane, lane_of(start_, lane));
    set_lane(truth_.velocity, lane, lane_of(zero, lane));
    set_lane(truth_.effort, lane, lane_of(zero, lane));
    set_lane(external_, lane, lane_of(zero, lane));
    measured_ = choose(measured_, truth_);
  }
  /// The same of some lanes. Real-time: yes.
  void stop(const Mask& some) noexcept {
    for (int k = 0; k < lane_count; ++k) {
      if (is_true(some, k)) stop(k);
    }
  }
  /// The lanes that move. Real-time: yes.
  [[nodiscard]] const Mask& moving() const noexcept { return moving_; }

  /// Efforts that act on the joints beside the drives', from now on. Real-time: yes.
  /// @param effort  finite [N m or N], N x 1
  void set_external_effort(int lane, const JointVector<joint_count>& effort) noexcept {
    set_lane(external_, lane, effort);
  }
  /// The same in all lanes that move. Real-time: yes.
  void set_external_effort(const JointVector<joint_count, S>& effort) noexcept {
    for (int j = 0; j < joint_count; ++j) external_[j] = select(moving_, effort[j], S(0));
  }

  /// The exact state at this moment, without sensors. Real-time: yes.
  [[nodiscard]] const State& true_state() const noexcept { return truth_; }
  /// Where the lanes started [rad or m], N x 1. Real-time: yes.
  [[nodiscard]] const JointVector<joint_count, S>& start() const noexcept { return start_; }
  /// Time from one command to the next [s]. Real-time: yes.
  [[nodiscard]] double period() const noexcept { return period_; }
  /// The described robot. Real-time: yes.
  [[nodiscard]] R robot() const noexcept { return {}; }

 private:
  using Setups = std::vector<LaneSetup<R>>;
  using Alone = JointDynamics<VariedRobot<R>>;

  LaneSimulator(std::span<const LaneSetup<R>> given, const Setups& setups)
      : robots_(robots_of(setups)),
        dynamics_(robots_),
        period_(setups[0].simulation.period),
        substeps_(setups[0].simulation.substeps),
        sensors_(options_of(setups)) {
    alone_.reserve(setups.size());
    std::size_t longest_delay = 0;
    for (int k = 0; k < lane_count; ++k) {
      const LaneSetup<R>& own = setups[static_cast<std::size_t>(k)];
      alone_.emplace_back(own.robot);
      set_lane(truth_.position, k, initial_position(own.robot, own.simulation));
      set_lane(truth_.velocity, k, own.simulation.initial_velocity);
      set_truth(moving_, k, k < static_cast<int>(given.size()));
      delays_[k] = static_cast<std::size_t>(own.delay);
      lost_[k] = own.lost;
      longest_delay = std::max(longest_delay, delays_[k]);
      all_arrive_at_once_ = longest_delay == 0 && all_arrive_at_once_ && !(own.lost.share > 0);
    }
    sent_.assign(longest_delay + 1, Vector::Zero());
    start_ = truth_.position;
    measured_ = choose(sensors_.measure(truth_), truth_);
  }

  [[nodiscard]] static RobotLanes<R, S> robots_of(const Setups& setups) {
    RobotLanes<R, S> robots;
    for (int k = 0; k < lane_count; ++k) robots.set(k, setups[static_cast<std::size_t>(k)].robot);
    return robots;
  }
  [[nodiscard]] static auto options_of(const Setups& setups) {
    JointArray<SimulatorOptions<joint_count>, lane_count> options;
    for (int k = 0; k < lane_count; ++k) {
      options[k] = setups[static_cast<std::size_t>(k)].simulation;
    }
    return options;
  }

  /// One state in the lanes that move, another in the others.
  [[nodiscard]] State choose(const State& moving, const State& resting) const noexcept {
    const auto chosen = [&](const Vector& a, const Vector& b) noexcept {
      return for_each_joint<joint_count, S>(
          [&](int j) noexcept { return select(moving_, a[j], b[j]); });
    };
    return {chosen(moving.position, resting.position), chosen(moving.velocity, resting.velocity),
            chosen(moving.effort, resting.effort)};
  }

  /// The efforts that reach the drives now.
  [[nodiscard]] Vector arrived(const Vector& effort) noexcept {
    const Vector before = sent_[(newest_ + sent_.size() - 1) % sent_.size()];
    sent_[newest_] = effort;
    for (int k = 0; k < lane_count; ++k) {
      if (lost_[k].contain(cycle_)) set_lane(sent_[newest_], k, lane_of(before, k));
    }
    ++cycle_;
    Vector arrived;
    for (int k = 0; k < lane_count; ++k) {
      const std::size_t at = (newest_ + sent_.size() - delays_[k]) % sent_.size();
      set_lane(arrived, k, lane_of(sent_[at], k));
    }
    newest_ = (newest_ + 1) % sent_.size();
    return arrived;
  }

  /// Advances by one period.
  void advance(const Vector& drives) noexcept {
    const Vector total = drives + external_;
    const auto effort = [&](const auto&, const auto&) noexcept -> const Vector& { return total; };
    const double step = period_ / substeps_;
    for (int i = 0; i < substeps_; ++i) {
      const auto [next, event] = dynamics_.advance_smoothly(truth_, effort, step);
      const State before = truth_;
      truth_ = all_of(moving_) ? next : choose(next, before);
      const Mask parts = event & moving_;
      if (any_of(parts)) advance_alone(before, total, parts, step);
    }
    truth_.effort = drives;
    measured_ = sensors_.measure(truth_);
    if (!all_of(moving_)) measured_ = choose(measured_, truth_);
  }

  /// Advances each lane with an event alone.
  [[gnu::noinline]] void advance_alone(const State& before, const Vector& total, const Mask& parts,
                                       double step) noexcept {
    for (int k = 0; k < lane_count; ++k) {
      if (!is_true(parts, k)) continue;
      const JointVector<joint_count> effort = lane_of(total, k);
      const JointState<joint_count> own = alone_[static_cast<std::size_t>(k)].advance(
          lane_of(before, k),
          [&](const auto&, const auto&) noexcept -> const auto& { return effort; }, step);
      set_lane(truth_.position, k, own.position);
      set_lane(truth_.velocity, k, own.velocity);
    }
  }

  RobotLanes<R, S> robots_;
  JointDynamics<RobotLanes<R, S>> dynamics_;
  std::vector<Alone> alone_{};
  double period_;
  int substeps_;
  JointSensors<joint_count, S> sensors_;
  JointArray<std::size_t, lane_count> delays_{};
  JointArray<LostCommands, lane_count> lost_{};
  bool all_arrive_at_once_ = true;  ///< without delay or loss in any lane
  std::vector<Vector> sent_{};      ///< the last efforts, in turn
  std::size_t newest_ = 0;
  std::uint64_t cycle_ = 0;
  Mask moving_{};
  Vector start_ = Vector::Zero();
  Vector external_ = Vector::Zero();
  State truth_{};
  State measured_{};
  bool active_ = true;
};

}  // namespace articula

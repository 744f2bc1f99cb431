// SPDX-License-Identifier: Apache-2.0
/// @file Control loops of several robots that differ, one in each lane of a pack.
#pragma once

#include "articula/core/controller.hpp"
#include "articula/core/finite.hpp"
#include "articula/core/scalar.hpp"
#include "articula/lanes/lane_pack.hpp"
#include "articula/lanes/lane_simulator.hpp"
#include "articula/loop/command_history.hpp"
#include "articula/loop/loop_parts.hpp"

#include <cstdint>
#include <span>
#include <utility>

namespace articula {

/// How a lane's run has ended, or that it has not.
template <int N>
struct LaneVerdict {
  /// Status::ok while it runs; Status::inactive for a lane without a setup; else what went wrong
  Status status = Status::ok;
  double time = 0;        ///< of the cycle in which it ended [s]
  JointState<N> state{};  ///< measured in that cycle
};

/// Closed loops of one controller and several robots of a kind that differ from it:
///
///     std::vector<LaneSetup<Q2d>> setups(LaneLoop<Q2d, PidPlusGravity>::lane_count);
///     setups[1].robot = VariedRobot<Q2d>(heavier);
///     LaneLoop<Q2d, PidPlusGravity> loop(setups);
///     loop.set_reference(1, {.position = {-1, 1}});
///     for (int k = 0; k < 2000; ++k) loop.update();
///
/// The controller knows the described robot only. Each lane gives what
/// `ControlLoop<Simulator<VariedRobot<R>>, C>` gives, up to rounding, as long as it runs. A lane
/// whose state, reference or command is not finite ends. Its verdict states the cause. Its robot
/// stands still from then on, and no other lane changes by a bit. Lanes have the gains of the
/// controller, which may differ: `PidPlusGravity<Q2d, S>` takes a `JointPidGains<2, S>`.
/// @tparam R  the kind of robot
/// @tparam C  a controller over S that commands efforts
/// @tparam S  a pack, which has one number for each lane
template <DescribedRobot R, class C, PackedScalar S = LanePack<R>>
class LaneControlLoop {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  static constexpr int lane_count = lanes<S>;
  using Scalar = S;
  using Simulator = LaneSimulator<R, S>;
  using State = JointState<joint_count, S>;
  using Reference = JointReference<joint_count, S>;
  using Command = typename detail::CheckedController<C, joint_count, S>::Command;
  static_assert(std::same_as<Command, EffortCommand<joint_count, S>>,
                "the drives in lanes take efforts: choose a controller that commands efforts");

  /// The controller with the gains that the robot brings along.
  /// @throws std::invalid_argument as LaneSimulator
  explicit LaneControlLoop(std::span<const LaneSetup<R>> setups)
      : LaneControlLoop(setups, detail::default_controller<C>()) {}

  /// @param setups      of the first lanes, at least one; the others are inactive
  /// @param controller  of all lanes
  /// @throws std::invalid_argument as LaneSimulator
  LaneControlLoop(std::span<const LaneSetup<R>> setups, C controller)
      : simulator_(setups), controller_(std::move(controller)) {
    reference_.position = simulator_.start();
    static_cast<void>(simulator_.read(state_));
    for (int k = 0; k < lane_count; ++k) {
      if (!is_true(simulator_.moving(), k)) verdicts_[k].status = Status::inactive;
    }
  }

  /// One cycle of the lanes that run: read, control, limit, write. The first starts the controller.
  /// Real-time: yes, if the controller's update is.
  void update() noexcept {
    const bool starts = cycles_ == 0;
    time_ = static_cast<double>(cycles_++) * simulator_.period();
    static_cast<void>(simulator_.read(state_));
    end_lanes(is_finite(state_), Status::non_finite_state);
    end_lanes(is_finite(reference_), Status::non_finite_reference);
    if (starts) {
      history_.start_with(command_, state_, Held::nothing);
      start_controller(controller_, history_.input(state_, reference_, simulator_.period()));
      history_.begin();
    }
    const auto in = history_.input(state_, reference_, simulator_.period());
    auto outcome = update_controller(controller_, in);
    const auto finite = is_finite(outcome.command);
    const bool failed = outcome.verdict == Verdict::failed && all_of(finite);
    end_lanes(failed ? mask_of<S>(false) : finite, Status::non_finite_command);
    if (!all_of(simulator_.moving())) outcome = Outcome<Command>(of_moving(outcome.command));
    command_ = simulator_.within_limits(outcome.command);
    static_cast<void>(simulator_.write(command_));
    history_.note_command(outcome, command_, state_);
    history_.note_cycle(true, true, Status::ok, Status::ok);
  }

  /// Up to this number of cycles, fewer if no lane runs any more. Real-time: as update.
  void run(int cycles) noexcept {
    for (int k = 0; k < cycles && any_of(simulator_.moving()); ++k) update();
  }

  /// What the joints of a lane shall do; its position is that of the start until then. Real-time:
  /// yes.
  void set_reference(int lane, const JointReference<joint_count>& reference) noexcept {
    set_lane(reference_.position, lane, reference.position);
    set_lane(reference_.velocity, lane, reference.velocity);
    set_lane(reference_.acceleration, lane, reference.acceleration);
    set_lane(reference_.effort, lane, reference.effort);
  }
  /// The same of all lanes. A lane that has ended has its start here. Real-time: yes.
  [[nodiscard]] Reference& reference() noexcept { return reference_; }
  [[nodiscard]] const Reference& reference() const noexcept { return reference_; }
  /// Measured at the beginning of the last update. A lane that has ended is at its start.
  /// Real-time: yes.
  [[nodiscard]] const State& state() const noexcept { return state_; }
  /// Written at the end of the last update; 0 for a lane that has ended. Real-time: yes.
  [[nodiscard]] const Command& command() const noexcept { return command_; }
  /// The lanes that run. Real-time: yes.
  [[nodiscard]] const MaskOf<S>& running() const noexcept { return simulator_.moving(); }
  /// Real-time: yes.
  [[nodiscard]] const LaneVerdict<joint_count>& verdict(int lane) const noexcept {
    return verdicts_[lane];
  }
  /// The time to which state() and command() belong: 0 at the first update, then one period more
  /// each [s]. Real-time: yes.
  [[nodiscard]] double time() const noexcept { return time_; }
  /// Time between two updates [s]. Real-time: yes.
  [[nodiscard]] double period() const noexcept { return simulator_.period(); }
  [[nodiscard]] const C& controller() const noexcept { return controller_; }
  [[nodiscard]] C& controller() noexcept { return controller_; }
  [[nodiscard]] const Simulator& simulator() const noexcept { return simulator_; }
  [[nodiscard]] Simulator& simulator() noexcept { return simulator_; }

 private:
  /// Ends the lanes that run and in which `good` is false.
  void end_lanes(const MaskOf<S>& good, Status status) noexcept {
    const MaskOf<S> bad = ~good & simulator_.moving();
    if (any_of(bad)) end_bad_lanes(bad, status);
    if (!all_of(simulator_.moving())) {  // numbers that the controller can take
      reference_.position = where_moving(reference_.position, simulator_.start());
      const JointVector<joint_count, S> zero = JointVector<joint_count, S>::Zero();
      reference_.velocity = where_moving(reference_.velocity, zero);
      reference_.acceleration = where_moving(reference_.acceleration, zero);
      reference_.effort = where_moving(reference_.effort, zero);
    }
  }
  [[gnu::cold, gnu::noinline]] void end_bad_lanes(const MaskOf<S>& bad, Status status) noexcept {
    for (int k = 0; k < lane_count; ++k) {
      if (!is_true(bad, k)) continue;
      verdicts_[k] = {status, time_, lane_of(state_, k)};
      simulator_.stop(k);
    }
    static_cast<void>(simulator_.read(state_));
  }
  [[nodiscard]] JointVector<joint_count, S> where_moving(
      const JointVector<joint_count, S>& x,
      const JointVector<joint_count, S>& other) const noexcept {
    return for_each_joint<joint_count, S>(
        [&](int j) noexcept { return select(simulator_.moving(), x[j], other[j]); });
  }
  [[nodiscard]] Command of_moving(const Command& command) const noexcept {
    return {where_moving(command.effort, JointVector<joint_count, S>::Zero())};
  }

  Simulator simulator_;
  C controller_;
  CommandHistory<Command> history_;
  std::uint64_t cycles_ = 0;
  double time_ = 0;
  State state_{};
  Reference reference_{};
  Command command_{};
  JointArray<LaneVerdict<joint_count>, lane_count> verdicts_{};
};

/// LaneControlLoop of a controller template, as Loop is ControlLoop of one.
/// @tparam ControllerTemplate  a template over the robot and the scalar, such as PidPlusGravity
template <DescribedRobot R, template <class...> class ControllerTemplate,
          PackedScalar S = LanePack<R>>
using LaneLoop = LaneControlLoop<R, ControllerTemplate<R, S>, S>;

}  // namespace articula

// SPDX-License-Identifier: Apache-2.0
/// @file Runs of a sweep in the lanes of a simulator, with a control loop of its own for each run.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/hardware.hpp"
#include "articula/core/scalar.hpp"
#include "articula/lanes/lane_simulator.hpp"
#include "articula/loop/control_loop.hpp"
#include "articula/sweep/variation/varied_loop.hpp"

#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

namespace articula::detail {

/// What all lanes have measured, and their commands.
template <int N, class S>
struct LaneExchange {
  JointState<N, S> measured{};
  EffortCommand<N, S> command{};
};

/// One lane as the hardware of a loop. The simulator moves when all loops have written.
template <DescribedRobot R, class S>
class LanePort {
 public:
  using RobotType = VariedRobot<R>;
  static constexpr int joint_count = articula::joint_count<R>;
  using Exchange = LaneExchange<joint_count, S>;

  /// The arguments must outlive the port.
  LanePort(const VariedRobot<R>& robot, double period, Exchange& exchange, int lane) noexcept
      : robot_(&robot), period_(period), exchange_(&exchange), lane_(lane) {}

  [[nodiscard]] Status activate() noexcept { return Status::ok; }
  [[nodiscard]] Status deactivate() noexcept { return Status::ok; }
  /// Real-time: yes.
  [[nodiscard]] Status read(JointState<joint_count>& state) noexcept {
    state = lane_of(exchange_->measured, lane_);
    return is_finite(state) ? Status::ok : Status::non_finite_state;
  }
  /// Real-time: yes.
  [[nodiscard]] Status write(const EffortCommand<joint_count>& command) noexcept {
    const bool finite = is_finite(command);
    set_lane(exchange_->command.effort, lane_,
             finite ? command.effort : JointVector<joint_count>(JointVector<joint_count>::Zero()));
    return finite ? Status::ok : Status::non_finite_command;
  }
  [[nodiscard]] const VariedRobot<R>& robot() const noexcept { return *robot_; }
  [[nodiscard]] double period() const noexcept { return period_; }

 private:
  const VariedRobot<R>* robot_;
  double period_;
  Exchange* exchange_;
  int lane_;
};

/// The robots of some loops for a simulator in lanes.
template <DescribedRobot R>
[[nodiscard]] std::vector<LaneSetup<R>> setups_of(std::span<const VariedLoop<R>* const> loops) {
  std::vector<LaneSetup<R>> setups;
  for (const VariedLoop<R>* each : loops) {
    setups.push_back({.robot = *each->robot,
                      .simulation = each->simulation,
                      .delay = each->delay,
                      .lost = each->lost});
  }
  return setups;
}

/// Robots in lanes, each under a ControlLoop of its own.
template <DescribedRobot R, class Make, class S>
class LanesOfOwnLoops {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using Loops = std::span<const VariedLoop<R>* const>;

  LanesOfOwnLoops(const Loops& loops, const Make& make, double period)
      : simulator_(setups_of<R>(loops)),
        exchange_(std::make_unique<LaneExchange<joint_count, S>>()) {
    exchange_->command.effort.setConstant(S(0));
    static_cast<void>(simulator_.read(exchange_->measured));
    arms_.reserve(loops.size());
    for (const VariedLoop<R>* own : loops) {
      const Port port(*own->robot, period, *exchange_, static_cast<int>(arms_.size()));
      arms_.emplace_back(port, make(own->gains));
    }
  }

  void set_reference(const JointReference<joint_count>& reference) noexcept {
    for (auto& arm : arms_) arm.reference() = reference;
  }
  /// One cycle of the lanes that move. A lane whose cycle is not good stops.
  void update() noexcept {
    for (std::size_t k = 0; k < arms_.size(); ++k) {
      const int lane = static_cast<int>(k);
      if (!is_true(simulator_.moving(), lane)) continue;
      if (arms_[k].update() != Status::ok) simulator_.stop(lane);
    }
    static_cast<void>(simulator_.write(exchange_->command));
    static_cast<void>(simulator_.read(exchange_->measured));
  }
  [[nodiscard]] LaneSimulator<R, S>& simulator() noexcept { return simulator_; }

 private:
  using Port = LanePort<R, S>;
  using Controller =
      std::remove_cvref_t<std::invoke_result_t<const Make&, const JointPidGains<joint_count>&>>;

  LaneSimulator<R, S> simulator_;
  std::unique_ptr<LaneExchange<joint_count, S>> exchange_;  ///< to which the ports refer
  std::vector<ControlLoop<Port, Controller>> arms_{};
};

}  // namespace articula::detail

// SPDX-License-Identifier: Apache-2.0
/// @file The other end of the bus: joint modules of the Quanser protocol on a simulated arm.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/refuse.hpp"
#include "articula/hardware/can/can_batch.hpp"
#include "articula/hardware/quanser/quanser_module.hpp"
#include "articula/hardware/quanser/quanser_protocol.hpp"
#include "articula/hardware/quanser/simulated_quanser_module.hpp"
#include "articula/sim/simulator.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace articula {

/// An arm's joint modules as docs/quanser_protocol.md describes them, with a simulated arm behind
/// them. Frames go in and out; there is no bus in it. Its time is the host's: each SYNC lets one
/// period pass, and the feedback shows the arm at the end of that period.
/// @tparam R  the robot
template <Robot R>
class SimulatedQuanserDrives {
 public:
  static constexpr int joint_count = articula::joint_count<R>;

  /// @param robot   whose joints these are
  /// @param modules  in the order of the joints
  /// @param options  of the simulated arm
  /// @throws std::invalid_argument if either makes no sense, or the period is above the longest
  SimulatedQuanserDrives(const R& robot, const QuanserModules<joint_count>& modules,
                         const SimulatorOptions<joint_count>& options = {})
      : modules_(modules), simulator_(robot, options) {
    validate(robot, modules);
    if (options.period > longest_period) {
      detail::refuse({"joint modules: the simulator's period ", options.period, " s is above ",
                      longest_period, " s, the longest of the protocol"});
    }
    static_cast<void>(simulator_.read(state_));
    const double rounding = 1e-9;  // of the quotient: 10 ms are 10 periods of 1 ms, not 11
    const int watchdog_periods = static_cast<int>(std::ceil(watchdog / options.period - rounding));
    const int heartbeat_periods =
        static_cast<int>(std::lround(heartbeat_interval / options.period));
    const JointVector<joint_count> limits = effort_limits(robot);
    for (std::size_t j = 0; j < units_.size(); ++j) {
      units_[j] = {limits[static_cast<int>(j)], watchdog_periods, heartbeat_periods};
    }
  }
  /// For a robot known at compile time.
  explicit SimulatedQuanserDrives(const QuanserModules<joint_count>& modules,
                                  const SimulatorOptions<joint_count>& options = {})
    requires DescribedRobot<R>
      : SimulatedQuanserDrives(R(), modules, options) {}

  static constexpr double watchdog = 10e-3;             ///< longest time without efforts [s]
  static constexpr double heartbeat_interval = 100e-3;  ///< [s]
  static constexpr double longest_period = 5e-3;        ///< between two SYNC [s]

  /// Takes a frame from the bus. SYNC lets a period pass and is answered.
  /// @param frame    any frame
  /// @param answers  receives the modules' frames
  /// Real-time: yes.
  void receive(const CanFrame& frame, CanBatch& answers) noexcept {
    if (const auto counter = quanser::decode_sync(frame)) {
      for (SimulatedQuanserModule& unit : units_) unit.synchronize(*counter);
      pass_period(answers);
      for (std::size_t j = 0; j < modules_.size(); ++j) report(j, *counter, answers);
      return;
    }
    const std::uint8_t node = quanser::node_of(frame);
    for (std::size_t j = 0; j < modules_.size(); ++j) {
      if (node == 0 || modules_[j].node != node) continue;
      if (const auto control = quanser::decode_control(frame)) units_[j].receive(*control);
      if (const auto effort = quanser::decode_effort(frame)) units_[j].receive(*effort);
    }
  }

  /// Lets a period pass in which there was no SYNC.
  /// @param answers  receives heartbeats that are due
  /// Real-time: yes.
  void pass_silent_period(CanBatch& answers) noexcept { pass_period(answers); }

  /// Latches faults of one module whose cause is gone at once. Real-time: yes.
  void raise_fault(int joint, std::uint8_t fault_bits) noexcept { unit(joint).latch(fault_bits); }
  /// Latches faults of one module whose cause lasts until the next call: CONTROL 3 does not clear
  /// them before. Real-time: yes.
  void hold_fault(int joint, std::uint8_t fault_bits) noexcept { unit(joint).hold(fault_bits); }
  /// Resets one module, as a loss of its supply would. What causes a fault lasts. Real-time: yes.
  void restart(int joint) noexcept { unit(joint).restart(); }

  /// The effort that the modules exert [N m], N x 1. Real-time: yes.
  [[nodiscard]] JointVector<joint_count> effort() const noexcept {
    JointVector<joint_count> efforts;
    for (int j = 0; j < joint_count; ++j) efforts[j] = units_[static_cast<std::size_t>(j)].effort();
    return efforts;
  }
  [[nodiscard]] bool enabled(int joint) const noexcept {
    return units_[static_cast<std::size_t>(joint)].enabled();
  }
  [[nodiscard]] const Simulator<R>& simulator() const noexcept { return simulator_; }

 private:
  [[nodiscard]] SimulatedQuanserModule& unit(int joint) noexcept {
    return units_[static_cast<std::size_t>(joint)];
  }

  void pass_period(CanBatch& answers) noexcept {
    for (SimulatedQuanserModule& unit : units_) unit.begin_period();
    static_cast<void>(simulator_.write({effort()}));
    static_cast<void>(simulator_.read(state_));
    const double most = quanser::detail::largest_count;
    for (std::size_t j = 0; j < modules_.size(); ++j) {
      const bool counts_fit = std::abs(motor_counts(j)) <= most && std::abs(load_counts(j)) <= most;
      if (const auto heartbeat = units_[j].end_period(counts_fit)) {
        answers.push_back(quanser::encode(*heartbeat, modules_[j].node));
      }
    }
  }

  /// Rounds to the wire's unit, within its range.
  template <class T>
  [[nodiscard]] static T rounded(double value, double most) noexcept {
    return static_cast<T>(std::lround(std::clamp(value, -most, most)));
  }

  /// What encoders without a limited range would count.
  [[nodiscard]] double motor_counts(std::size_t j) const noexcept {
    return angle(j) * modules_[j].motor_scale();
  }
  [[nodiscard]] double load_counts(std::size_t j) const noexcept {
    return angle(j) * modules_[j].load_scale();
  }
  [[nodiscard]] double angle(std::size_t j) const noexcept {
    return state_.position[static_cast<int>(j)] - modules_[j].position_at_zero;
  }

  void report(std::size_t j, std::uint8_t counter, CanBatch& answers) noexcept {
    if (!is_finite(state_)) return;
    const int i = static_cast<int>(j);
    const QuanserModule& module = modules_[j];
    const double most_counts = quanser::detail::largest_count, most = 32767;
    answers.push_back(
        quanser::encode(quanser::Position{rounded<std::int32_t>(motor_counts(j), most_counts),
                                          rounded<std::int32_t>(load_counts(j), most_counts),
                                          counter, units_[j].status()},
                        module.node));
    answers.push_back(
        quanser::encode(quanser::Motion{rounded<std::int16_t>(state_.velocity[i] * 1e3, most),
                                        rounded<std::int16_t>(state_.effort[i] * 1e3, most),
                                        counter, units_[j].faults()},
                        module.node));
  }

  QuanserModules<joint_count> modules_;
  Simulator<R> simulator_;
  std::array<SimulatedQuanserModule, static_cast<std::size_t>(joint_count)> units_{};
  JointState<joint_count> state_{};  ///< the last sample
};

}  // namespace articula

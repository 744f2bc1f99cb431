// SPDX-License-Identifier: Apache-2.0
/// @file Simulated Quanser joint modules of a simulated arm: the other end of the bus.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/joint_array.hpp"
#include "articula/core/refuse.hpp"
#include "articula/hardware/can/can_batch.hpp"
#include "articula/hardware/can/nearest_units.hpp"
#include "articula/hardware/quanser/quanser_module.hpp"
#include "articula/hardware/quanser/quanser_protocol.hpp"
#include "articula/hardware/quanser/simulated_quanser_module.hpp"
#include "articula/sim/simulator.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace articula {

/// An arm's joint modules after docs/quanser_protocol.md, on a simulated arm. Frames go in and out;
/// there is no bus. Each SYNC of the host simulates one period, and the feedback shows the arm at
/// the end of that period.
template <Robot R>
class SimulatedQuanserDrives {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  static constexpr double watchdog = 10e-3;             ///< longest time without efforts [s]
  static constexpr double heartbeat_interval = 100e-3;  ///< [s]
  static constexpr double longest_period = 5e-3;        ///< between two SYNC [s]

  /// @param robot    whose joints these are
  /// @param modules  in the order of the joints
  /// @param options  of the simulated arm
  /// @throws std::invalid_argument as validate(robot, modules) and the simulator, or if the period
  ///         is above the longest
  SimulatedQuanserDrives(const R& robot, const QuanserModules<joint_count>& modules,
                         const SimulatorOptions<joint_count>& options = {})
      : modules_{modules}, simulator_(robot, options) {
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
    for (int j = 0; j < joint_count; ++j) {
      units_[j] = {limits[j], watchdog_periods, heartbeat_periods};
    }
  }
  /// For a robot known at compile time.
  explicit SimulatedQuanserDrives(const QuanserModules<joint_count>& modules,
                                  const SimulatorOptions<joint_count>& options = {})
    requires DescribedRobot<R>
      : SimulatedQuanserDrives(R(), modules, options) {}

  /// Processes a frame from the bus. SYNC simulates a period, and the modules answer it.
  /// @param frame    any frame
  /// @param answers  receives the modules' frames
  /// Real-time: yes.
  void receive(const CanFrame& frame, CanBatch& answers) noexcept {
    if (const auto counter = quanser::decode_sync(frame)) {
      for (SimulatedQuanserModule& unit : units_) unit.synchronize(*counter);
      pass_silent_period(answers);
      if (!is_finite(state_)) return;
      for (int j = 0; j < joint_count; ++j) report(j, *counter, answers);
      return;
    }
    const std::uint8_t node = quanser::node_of(frame);
    for (int j = 0; j < joint_count; ++j) {
      if (node == 0 || modules_[j].node != node) continue;
      if (const auto control = quanser::decode_control(frame)) units_[j].receive(*control);
      if (const auto effort = quanser::decode_effort(frame)) units_[j].receive(*effort);
    }
  }

  /// Simulates a period without SYNC.
  /// @param answers  receives heartbeats that are due
  /// Real-time: yes.
  void pass_silent_period(CanBatch& answers) noexcept {
    for (SimulatedQuanserModule& unit : units_) unit.begin_period();
    static_cast<void>(simulator_.write({effort()}));
    static_cast<void>(simulator_.read(state_));
    const double most = quanser::detail::largest_count;
    for (int j = 0; j < joint_count; ++j) {
      const bool counts_fit = std::abs(motor_counts(j)) <= most && std::abs(load_counts(j)) <= most;
      if (const auto heartbeat = units_[j].end_period(counts_fit)) {
        answers.push_back(quanser::encode(*heartbeat, modules_[j].node));
      }
    }
  }

  /// Latches faults of one module whose cause ends at once. Real-time: yes.
  void raise_fault(int joint, std::uint8_t fault_bits) noexcept { units_[joint].latch(fault_bits); }
  /// Latches faults of one module whose cause lasts until the next call. CONTROL 3 does not clear
  /// them before. Real-time: yes.
  void hold_fault(int joint, std::uint8_t fault_bits) noexcept { units_[joint].hold(fault_bits); }
  /// Resets one module, as a loss of its supply would. The causes of faults last. Real-time: yes.
  void restart(int joint) noexcept { units_[joint].restart(); }

  /// The effort that the modules exert [N m], N x 1. Real-time: yes.
  [[nodiscard]] JointVector<joint_count> effort() const noexcept {
    JointVector<joint_count> efforts;
    for (int j = 0; j < joint_count; ++j) efforts[j] = units_[j].effort();
    return efforts;
  }
  [[nodiscard]] bool enabled(int joint) const noexcept { return units_[joint].enabled(); }
  [[nodiscard]] const Simulator<R>& simulator() const noexcept { return simulator_; }

 private:
  // Counts of encoders without a limited range.
  [[nodiscard]] double motor_counts(int j) const noexcept {
    return (state_.position[j] - modules_[j].position_at_zero) * modules_[j].motor_scale();
  }
  [[nodiscard]] double load_counts(int j) const noexcept {
    return (state_.position[j] - modules_[j].position_at_zero) * modules_[j].load_scale();
  }

  void report(int j, std::uint8_t counter, CanBatch& answers) const noexcept {
    constexpr double most = quanser::detail::largest_count;
    const auto milli = [](double value) {
      return static_cast<std::int16_t>(nearest_units(value * 1e3, 32767));
    };
    const quanser::Position position{nearest_units(motor_counts(j), most),
                                     nearest_units(load_counts(j), most), counter,
                                     units_[j].status()};
    const quanser::Motion motion{milli(state_.velocity[j]), milli(state_.effort[j]), counter,
                                 units_[j].faults()};
    answers.push_back(quanser::encode(position, modules_[j].node));
    answers.push_back(quanser::encode(motion, modules_[j].node));
  }

  JointArray<QuanserModule, joint_count> modules_;
  Simulator<R> simulator_;
  JointArray<SimulatedQuanserModule, joint_count> units_{};
  JointState<joint_count> state_{};  ///< the last sample
};

}  // namespace articula

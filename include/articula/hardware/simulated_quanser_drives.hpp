// SPDX-License-Identifier: Apache-2.0
/// @file The other end of the bus: joint modules of the Quanser protocol on a simulated arm.
#pragma once

#include "articula/hardware/can_batch.hpp"
#include "articula/hardware/quanser_module.hpp"
#include "articula/hardware/quanser_protocol.hpp"
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
  /// @throws std::invalid_argument if either makes no sense
  SimulatedQuanserDrives(const R& robot, const QuanserModules<joint_count>& modules,
                         const SimulatorOptions<joint_count>& options = {})
      : modules_(modules), simulator_(robot, options) {
    validate(robot, modules);
    effort_limits_ = effort_limits(robot);
    watchdog_periods_ = static_cast<int>(std::lround(watchdog / options.period));
    heartbeat_periods_ = static_cast<int>(std::lround(heartbeat_interval / options.period));
  }
  /// For a robot known at compile time.
  explicit SimulatedQuanserDrives(const QuanserModules<joint_count>& modules,
                                  const SimulatorOptions<joint_count>& options = {}) requires
      DescribedRobot<R> : SimulatedQuanserDrives(R(), modules, options) {}

  static constexpr double watchdog = 10e-3;             ///< longest time without efforts [s]
  static constexpr double heartbeat_interval = 100e-3;  ///< [s]

  /// Takes a frame from the bus. SYNC lets a period pass and is answered.
  /// @param frame    any frame
  /// @param answers  receives the modules' frames
  /// Real-time: yes.
  void receive(const CanFrame& frame, CanBatch& answers) noexcept {
    if (const auto counter = quanser::decode_sync(frame)) {
      put_into_force(*counter);
      pass_period(answers);
      for (std::size_t j = 0; j < modules_.size(); ++j) report(j, *counter, answers);
      return;
    }
    const std::uint8_t node = quanser::node_of(frame);
    for (std::size_t j = 0; j < modules_.size(); ++j) {
      if (node == 0 || modules_[j].node != node) continue;
      if (const auto control = quanser::decode_control(frame)) obey(units_[j], *control);
      if (const auto effort = quanser::decode_effort(frame)) {
        // Frames may overtake each other in a sender's controller: SYNC may have been here already.
        if (effort->counter == counter_) {
          follow(j, *effort);
        } else {
          units_[j].pending = *effort;
          units_[j].has_pending = true;
        }
      }
    }
  }

  /// Lets a period pass in which there was no SYNC.
  /// @param answers  receives heartbeats that are due
  /// Real-time: yes.
  void pass_silent_period(CanBatch& answers) noexcept { pass_period(answers); }

  /// Latches faults of one module, as its own sensors would. Real-time: yes.
  void raise_fault(int joint, std::uint8_t fault_bits) noexcept {
    latch(units_[static_cast<std::size_t>(joint)], fault_bits);
  }
  /// Resets one module, as a loss of its supply would. Real-time: yes.
  void restart(int joint) noexcept { units_[static_cast<std::size_t>(joint)] = {}; }

  /// The effort that the modules exert [N m], N x 1. Real-time: yes.
  [[nodiscard]] JointVector<joint_count> effort() const noexcept {
    JointVector<joint_count> efforts;
    for (int j = 0; j < joint_count; ++j) efforts[j] = units_[static_cast<std::size_t>(j)].effort;
    return efforts;
  }
  [[nodiscard]] bool enabled(int joint) const noexcept {
    return units_[static_cast<std::size_t>(joint)].enabled;
  }
  [[nodiscard]] const Simulator<R>& simulator() const noexcept { return simulator_; }

 private:
  /// What one module remembers.
  struct Unit {
    bool enabled = false;
    std::uint8_t faults = 0;
    bool has_pending = false;
    bool supervised = false;  ///< an effort has come since the module was enabled
    quanser::Effort pending{};
    double effort = 0;  ///< [N m]
    int silence = 0;    ///< periods since the last effort
    int until_heartbeat = 0;
    std::uint16_t heartbeats = 0;
  };

  static void let_go(Unit& unit) noexcept {
    unit.enabled = unit.supervised = unit.has_pending = false;
    unit.effort = 0;
  }
  static void latch(Unit& unit, std::uint8_t faults) noexcept {
    unit.faults |= faults;
    let_go(unit);
  }
  static void obey(Unit& unit, quanser::Control control) noexcept {
    switch (control) {
      case quanser::Control::enable:
        if (!unit.enabled && unit.faults == 0) {
          let_go(unit);
          unit.enabled = true;
        }
        return;
      case quanser::Control::disable:
        return let_go(unit);
      case quanser::Control::clear_faults:
        let_go(unit);
        unit.faults = 0;
        return;
    }
  }

  void follow(std::size_t j, const quanser::Effort& effort) noexcept {
    Unit& unit = units_[j];
    if (!unit.enabled) return;
    const double limit = effort_limits_[static_cast<int>(j)];
    unit.effort = std::clamp(effort.millinewton_metres * 1e-3, -limit, limit);
    unit.supervised = true;
    unit.silence = 0;
  }

  /// SYNC makes the efforts with its counter valid; any other is dropped.
  void put_into_force(std::uint8_t counter) noexcept {
    counter_ = counter;
    for (std::size_t j = 0; j < modules_.size(); ++j) {
      Unit& unit = units_[j];
      if (unit.has_pending && unit.pending.counter == counter) follow(j, unit.pending);
      unit.has_pending = false;
    }
  }

  void pass_period(CanBatch& answers) noexcept {
    for (Unit& unit : units_) {
      if (unit.supervised && ++unit.silence > watchdog_periods_) {
        latch(unit, quanser::command_timeout);
      }
    }
    static_cast<void>(simulator_.write({effort()}));
    for (std::size_t j = 0; j < modules_.size(); ++j) {
      Unit& unit = units_[j];
      if (--unit.until_heartbeat > 0) continue;
      unit.until_heartbeat = heartbeat_periods_;
      answers.push_back(quanser::encode(quanser::Heartbeat{status(j), unit.faults, unit.heartbeats},
                                        modules_[j].node));
      if (unit.heartbeats < 0xffff) ++unit.heartbeats;
    }
  }

  [[nodiscard]] std::uint8_t status(std::size_t j) const noexcept {
    const Unit& unit = units_[j];
    const bool at_limit =
        unit.enabled && std::abs(unit.effort) >= effort_limits_[static_cast<int>(j)];
    return static_cast<std::uint8_t>((unit.enabled ? quanser::enabled : 0) |
                                     (unit.faults != 0 ? quanser::faulty : 0) |
                                     (at_limit ? quanser::limited : 0));
  }

  /// Rounds to the wire's unit, within its range.
  template <class T>
  [[nodiscard]] static T rounded(double value, double most) noexcept {
    return static_cast<T>(std::lround(std::clamp(value, -most, most)));
  }

  void report(std::size_t j, std::uint8_t counter, CanBatch& answers) noexcept {
    JointState<joint_count> state;
    if (simulator_.read(state) != Status::ok) return;
    const int i = static_cast<int>(j);
    const QuanserModule& module = modules_[j];
    const double angle = state.position[i] - module.position_at_zero;
    const double most_counts = quanser::detail::largest_count, most = 32767;
    answers.push_back(quanser::encode(
        quanser::Position{rounded<std::int32_t>(angle * module.motor_scale(), most_counts),
                          rounded<std::int32_t>(angle * module.load_scale(), most_counts), counter,
                          status(j)},
        module.node));
    answers.push_back(
        quanser::encode(quanser::Motion{rounded<std::int16_t>(state.velocity[i] * 1e3, most),
                                        rounded<std::int16_t>(state.effort[i] * 1e3, most), counter,
                                        units_[j].faults},
                        module.node));
  }

  QuanserModules<joint_count> modules_;
  Simulator<R> simulator_;
  JointVector<joint_count> effort_limits_;
  int watchdog_periods_ = 0;
  int heartbeat_periods_ = 0;
  std::array<Unit, static_cast<std::size_t>(joint_count)> units_{};
  int counter_ = -1;  ///< of the last SYNC; none yet
};

}  // namespace articula

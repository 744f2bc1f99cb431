// SPDX-License-Identifier: Apache-2.0
/// @file Hardware that measures what was recorded.
#pragma once

#include "articula/core/hardware.hpp"
#include "articula/recording/cycle_record.hpp"
#include "articula/sim/simulator.hpp"

#include <optional>
#include <type_traits>

namespace articula {

/// Hardware that answers what recorded hardware answered, until a simulator takes its place. See
/// Replay.
/// @tparam R            the robot
/// @tparam CommandType  of the recorded loop
template <Robot R, class CommandType>
class RecordedHardware {
 public:
  using RobotType = R;
  static constexpr int joint_count = articula::joint_count<R>;
  using Record = CycleRecord<joint_count, CommandType>;

  /// @param robot   whose joints were recorded
  /// @param period  of the recorded loop [s]
  RecordedHardware(const R& robot, double period) : robot_(robot), period_(period) {}

  [[nodiscard]] const R& robot() const noexcept { return robot_; }
  [[nodiscard]] double period() const noexcept { return period_; }

  /// Answers of this cycle from now on. A joint of which nothing is known is a fault to the loop.
  /// Real-time: yes.
  void show(const Record& record) noexcept {
    record_ = record;
    known_ = true;
  }

  /// Whether a command came after the last state. Real-time: yes.
  [[nodiscard]] bool written() const noexcept { return written_; }

  /// A simulator, in the state of the record that is shown, takes the place of the records.
  /// @param simulator  its period is that of the recorded loop
  /// Real-time: no (the simulator's options may own memory).
  void simulate(const Simulator<R>& simulator)
    requires DynamicRobot<R>
  {
    simulator_.emplace(simulator);
    simulator_->set_state(record_.state.position, record_.state.velocity);
  }
  [[nodiscard]] bool is_simulated() const noexcept { return simulator_.has_value(); }
  /// The simulator, once there is one.
  [[nodiscard]] auto& simulator() noexcept { return *simulator_; }

  /// Real-time: yes, all of them.
  [[nodiscard]] Status activate() noexcept {
    return change([](auto& s) { return s.activate(); });
  }
  [[nodiscard]] Status deactivate() noexcept {
    return change([](auto& s) { return s.deactivate(); });
  }
  [[nodiscard]] Status read(JointState<joint_count>& state) noexcept {
    if constexpr (DynamicRobot<R>) {
      if (simulator_) return simulator_->read(state);
    }
    written_ = false;
    if (!known_) return Status::hardware_fault;
    state = record_.state;
    return record_.input.read;
  }
  [[nodiscard]] Status write([[maybe_unused]] const CommandType& command) noexcept {
    if constexpr (DynamicRobot<R>) {
      if (simulator_) return simulator_->write(command);
    }
    written_ = true;
    return record_.input.write;
  }

 private:
  struct Nothing {
    [[nodiscard]] static constexpr bool has_value() noexcept { return false; }
  };
  /// Depends on R only where it has a simulator.
  template <class Robot>
  struct Continuation {
    using Type = Nothing;
  };
  template <DynamicRobot Robot>
  struct Continuation<Robot> {
    using Type = std::optional<Simulator<Robot>>;
  };

  template <class Call>
  [[nodiscard]] Status change([[maybe_unused]] Call call) noexcept {
    if constexpr (DynamicRobot<R>) {
      if (simulator_) return call(*simulator_);
    }
    return record_.input.change;
  }

  [[no_unique_address]] R robot_;
  double period_;
  Record record_{};
  bool known_ = false;
  bool written_ = false;
  typename Continuation<R>::Type simulator_{};
};

}  // namespace articula

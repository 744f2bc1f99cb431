// SPDX-License-Identifier: Apache-2.0
/// @file The state machine of a simulated CiA 402 drive.
#pragma once

#include "articula/hardware/cia402/cia402.hpp"

#include <cstdint>

namespace articula {

/// The state machine of a simulated CiA 402 drive [CiA 402-2, controlword]. A quick stop switches
/// the power off at once. All functions are real-time.
class SimulatedCia402Machine {
 public:
  SimulatedCia402Machine() = default;
  /// @param transition_time  of each transition towards operation enabled [s]
  explicit SimulatedCia402Machine(double transition_time) noexcept
      : transition_time_(transition_time) {}

  [[nodiscard]] bool enabled() const noexcept { return state_ == cia402::State::operation_enabled; }

  void fault() noexcept { state_ = next_ = cia402::State::fault; }

  /// Executes a controlword.
  /// @return true if it has reset a fault
  bool execute(std::uint16_t word) noexcept {
    using cia402::State;
    const bool reset = (word & 0x80) != 0 && (last_word_ & 0x80) == 0;
    last_word_ = word;
    if (state_ == State::fault) {
      if (reset) state_ = next_ = State::switch_on_disabled;
      return reset;
    }
    if ((word & 0x06) != 0x06) {  // no voltage, or quick stop
      go_to(State::switch_on_disabled);
    } else if ((word & 0x01) == 0) {
      go_to(State::ready_to_switch_on);
    } else if ((word & 0x08) == 0) {
      if (state_ == State::ready_to_switch_on || enabled()) go_to(State::switched_on);
    } else if (state_ == State::switched_on) {
      go_to(State::operation_enabled);
    }
    return false;
  }

  /// Lets time pass.
  /// @return true if a transition has ended
  bool pass(double time) noexcept {
    if (next_ == state_) return false;
    left_ -= time;
    if (left_ > time / 2) return false;
    state_ = next_;
    return true;
  }

  /// @param shows_following  sets bit 12 in operation
  [[nodiscard]] std::uint16_t statusword(bool shows_following) const noexcept {
    unsigned bits = 0x40;
    if (state_ == cia402::State::ready_to_switch_on) bits = 0x21;
    if (state_ == cia402::State::switched_on) bits = 0x33;
    if (enabled()) bits = shows_following ? 0x37U | cia402::follows_target : 0x37U;
    if (state_ == cia402::State::fault) bits = 0x08;
    constexpr unsigned remote = 0x200;
    return static_cast<std::uint16_t>(bits | remote);
  }

 private:
  /// Transitions upwards take time, downwards none.
  void go_to(cia402::State state) noexcept {
    const bool upwards = state > state_;
    if (upwards && transition_time_ > 0) {
      if (next_ != state) left_ = transition_time_;
      next_ = state;
    } else {
      state_ = next_ = state;
    }
  }

  double transition_time_ = 0;  ///< [s]
  double left_ = 0;             ///< of the current transition [s]
  cia402::State state_ = cia402::State::switch_on_disabled;
  cia402::State next_ = cia402::State::switch_on_disabled;  ///< target of the transition
  std::uint16_t last_word_ = 0;
};

}  // namespace articula

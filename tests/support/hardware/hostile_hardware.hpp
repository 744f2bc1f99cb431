// SPDX-License-Identifier: Apache-2.0
/// @file Hardware around other hardware that fails in every way, now and then.
#pragma once

#include <articula/core/hardware.hpp>
#include <articula/model/robot.hpp>

#include <limits>
#include <utility>

#include "random.hpp"

namespace support {

/// Loses states and commands, measures NaN, and is inactive at times.
/// @tparam Inner  the hardware that works
template <class Inner>
class HostileHardware {
 public:
  using RobotType = typename Inner::RobotType;
  static constexpr int joint_count = articula::joint_count<RobotType>;
  using Status = articula::Status;

  /// @param one_in  a fault in so many accesses; 0: none
  explicit HostileHardware(Inner inner = Inner(), unsigned seed = 1, int one_in = 0)
      : inner_(std::move(inner)), random_(seed), one_in_(one_in) {}

  void set_faults(int one_in) { one_in_ = one_in; }

  [[nodiscard]] const RobotType& robot() const noexcept { return inner_.robot(); }
  [[nodiscard]] double period() const noexcept { return inner_.period(); }
  [[nodiscard]] Status activate() noexcept {
    if (fails(4)) return Status::hardware_fault;
    return inner_.activate();
  }
  [[nodiscard]] Status deactivate() noexcept {
    const Status status = inner_.deactivate();
    return fails(4) ? Status::hardware_fault : status;
  }
  [[nodiscard]] Status read(articula::JointState<joint_count>& state) noexcept {
    const Status before = last_;
    last_ = Status::ok;
    if (fails(1)) last_ = some_fault();
    if (before != Status::ok && random_.integer(0, 2) > 0) last_ = before;  // goes on for a while
    const Status status = inner_.read(state);
    if (last_ == Status::hardware_fault && random_.one_in(2)) return last_;
    if (last_ == Status::non_finite_state) {
      const double bad = random_.one_in(2) ? std::numeric_limits<double>::quiet_NaN()
                                           : std::numeric_limits<double>::infinity();
      (random_.one_in(2) ? state.position : state.velocity)[random_.integer(0, joint_count - 1)] =
          bad;
      return Status::ok;
    }
    return last_ == Status::ok ? status : last_;
  }
  template <class Command>
  [[nodiscard]] Status write(const Command& command) noexcept {
    const Status status = inner_.write(command);
    return fails(2) ? some_fault() : status;
  }

 private:
  [[nodiscard]] bool fails(int rarer) { return one_in_ > 0 && random_.one_in(one_in_ * rarer); }
  [[nodiscard]] Status some_fault() {
    switch (random_.integer(0, 3)) {
      case 0:
        return Status::hardware_fault;
      case 1:
        return Status::stale_state;
      case 2:
        return Status::inactive;
      default:
        return Status::non_finite_state;
    }
  }

  Inner inner_;
  Random random_;
  int one_in_;
  Status last_ = Status::ok;
};

}  // namespace support

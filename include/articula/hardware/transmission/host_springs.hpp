// SPDX-License-Identifier: Apache-2.0
/// @file Springs and dampers for drives that take only efforts.
#pragma once

#include "articula/command/drive_spring.hpp"
#include "articula/core/hardware.hpp"
#include "articula/core/joint_command.hpp"
#include "articula/core/joint_state.hpp"
#include "articula/hardware/transmission/hardware_adapter.hpp"
#include "articula/model/robot.hpp"

#include <algorithm>
#include <concepts>
#include <utility>

namespace articula {

/// Hardware with a spring and a damper in each drive, made of hardware that takes only efforts.
///
/// Some controllers command a spring, a damper and an effort per joint (MultiModeCommand), because
/// some drives close that loop themselves. No driver of this library is for such drives.
/// HostSprings computes the effort in the host instead, once a cycle, at the measured state:
///
///     effort = clamp(K (q_ref - q) + D (v_ref - v) + effort_ref, -limit, limit)
///
///     const DriveImpedance<Q2d> springs(gains);
///     Loop<HostSprings<Q2dCan>, DriveImpedance> loop(HostSprings<Q2dCan>(), springs);
///
/// Do not use it to obtain the stiffness of springs in drives: these run at the drives' rate, some
/// ten times faster than a loop. For a controller of your own, JointImpedance commands efforts
/// directly.
/// @tparam H  hardware that takes EffortCommand
template <class H>
  requires Hardware<H, EffortCommand<H::joint_count>>
class HostSprings : public detail::HardwareAdapter<H> {
 public:
  using RobotType = typename H::RobotType;
  static constexpr int joint_count = H::joint_count;

  /// @param hardware  of the drives
  explicit HostSprings(H hardware = H())
    requires std::move_constructible<H>
      : detail::HardwareAdapter<H>(std::move(hardware)), limits_(effort_limits(robot())) {}

  /// What the joints do, as the hardware inside measures it.
  /// @return as the hardware inside
  /// Real-time: yes, if the read of the hardware inside is.
  [[nodiscard]] Status read(JointState<joint_count>& state) noexcept {
    const Status status = this->hardware_.read(state);
    if (status != Status::hardware_fault) state_ = state;
    return status;
  }

  /// Writes the effort of springs and dampers at the last measured state.
  /// @param command  springs, dampers and efforts
  /// @return         as the hardware inside, which also refuses an effort that is not finite
  /// Real-time: yes, if the write of the hardware inside is.
  [[nodiscard]] Status write(const MultiModeCommand<joint_count>& command) noexcept {
    EffortCommand<joint_count> total{spring_pull(command, state_) + command.effort};
    for (int j = 0; j < joint_count; ++j) {  // std::clamp keeps a NaN
      total.effort[j] = std::clamp(total.effort[j], -limits_[j], limits_[j]);
    }
    return this->hardware_.write(total);
  }

  [[nodiscard]] decltype(auto) robot() const noexcept { return this->hardware_.robot(); }

 private:
  JointVector<joint_count> limits_;
  JointState<joint_count> state_{};
};

}  // namespace articula

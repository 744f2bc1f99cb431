// SPDX-License-Identifier: Apache-2.0
/// @file References that another program sets, joint by joint.
#pragma once

#include "articula/core/joint_array.hpp"
#include "articula/reference/stop_and_return.hpp"

namespace articula::remote {

/// The joints whose reference another program sets, and the numbers.
/// @tparam N  number of joints
template <int N>
struct JointSetting {
  JointArray<bool, N> joints{};     ///< those that are set
  JointArray<bool, N> positions{};  ///< those whose position is set; others keep theirs
  JointReference<N> values{};
};

/// A reference of which some joints are set at once. Joints that were not set come to rest by the
/// fastest stop, and stay there.
template <Robot R>
class SetMotion {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using Reference = JointReference<joint_count>;
  using Setting = JointSetting<joint_count>;

  /// @param limits  that validate() accepts
  SetMotion(const R& robot, const MotionLimits<joint_count>& limits) noexcept
      : rest_(robot, JointVector<joint_count>::Zero(), limits) {}

  /// Begins with the stop of all joints. Real-time: yes.
  void begin(const Reference& from) noexcept {
    rest_.begin(from);
    joints_.fill(false);
  }

  /// Sets some joints; the others go on.
  /// @param from  the present reference
  /// Real-time: yes.
  void set(const Reference& from, const Setting& setting) noexcept {
    for (int j = 0; j < joint_count; ++j) {
      if (!setting.joints[j]) continue;
      joints_[j] = true;
      const double position = setting.positions[j] ? setting.values.position[j] : from.position[j];
      set_motion(values_, j, {position, setting.values.velocity[j], 0});
      values_.effort[j] = setting.values.effort[j];
    }
  }

  /// Moves on by a period [s], > 0. Real-time: yes. O(N).
  [[nodiscard]] Reference advance(double period) noexcept {
    Reference reference = rest_.advance(period);
    moves_ = rest_.moves();
    for (int j = 0; j < joint_count; ++j) {
      if (!joints_[j]) continue;
      articula::set_motion(reference, j, motion_of(values_, j));
      reference.effort[j] = values_.effort[j];
      moves_ = moves_ || values_.velocity[j] != 0;
    }
    return reference;
  }

  /// Whether the last reference has a velocity. Real-time: yes.
  [[nodiscard]] bool moves() const noexcept { return moves_; }

 private:
  StopAndReturn<R> rest_;
  JointArray<bool, joint_count> joints_{};  ///< set since the beginning
  Reference values_{};
  bool moves_ = true;
};

}  // namespace articula::remote

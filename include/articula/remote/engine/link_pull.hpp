// SPDX-License-Identifier: Apache-2.0
/// @file The joint efforts of a force on a link.
#pragma once

#include "articula/dynamics/jacobian.hpp"

namespace articula::remote {

/// A force on a point that is fixed to a link, and the joint efforts that do its work:
///
///     effort = J^T (f, p x f)
///
/// J is the link's Jacobian, f the force and p the vector from the link's origin to the point, both
/// in the root link's frame.
template <Robot R>
class LinkPull {
 public:
  static constexpr int joint_count = articula::joint_count<R>;

  /// @param link   of the robot
  /// @param point  in the link's frame [m]
  /// @param force  in the root link's frame [N]
  /// Real-time: yes.
  void set(LinkIndex link, const Eigen::Vector3d& point, const Eigen::Vector3d& force) noexcept {
    link_ = link;
    point_ = point;
    force_ = force;
  }
  [[nodiscard]] bool acts() const noexcept { return !force_.isZero(0); }

  /// The efforts at a position [N m or N], N x 1. Real-time: yes. O(N).
  [[nodiscard]] JointVector<joint_count> effort(const R& robot,
                                                const JointVector<joint_count>& q) const noexcept {
    const LinkJacobian<joint_count> j = jacobian(robot, q, link_);
    const Eigen::Vector3d lever = forward_kinematics(robot, q, link_).linear() * point_;
    const Eigen::Vector3d moment = lever.cross(force_);
    return for_each_joint<joint_count>([&](int k) noexcept {
      double sum = 0;
      for (int i = 0; i < 3; ++i) sum += j(i, k) * force_[i] + j(i + 3, k) * moment[i];
      return sum;
    });
  }

 private:
  LinkIndex link_{};
  Eigen::Vector3d point_{0, 0, 0};
  Eigen::Vector3d force_{0, 0, 0};
};

}  // namespace articula::remote

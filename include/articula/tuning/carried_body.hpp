// SPDX-License-Identifier: Apache-2.0
/// @file The links that a joint carries, as one rigid body.
#pragma once

#include "articula/core/joint_array.hpp"
#include "articula/core/refuse.hpp"
#include "articula/dynamics/engine/configuration.hpp"
#include "articula/dynamics/engine/evaluate.hpp"
#include "articula/dynamics/moving_joints.hpp"
#include "articula/model/robot.hpp"
#include "articula/tuning/equivalent_inertia.hpp"

#include <cmath>

namespace articula {

/// The links that a joint carries, as one rigid body, in terms of the joint's axis. Its drive
/// accelerates about_axis; about_center is less by mass lever^2.
struct CarriedBody {
  double mass = 0;          ///< m [kg]
  double lever = 0;         ///< c, distance of the centre of mass from the axis [m]
  double about_axis = 0;    ///< inertia about the joint's axis [kg m^2]
  double about_center = 0;  ///< inertia about the parallel axis through the centre of mass [kg m^2]
};

/// The body that a joint carries if all joints beyond it are locked: masses and moments add up, and
/// about_axis = about_center + m c^2. The reflected inertia of drives is not included.
/// @param robot  a described robot or a model
/// @param q      joint positions [rad or m], N x 1
/// @param joint  index of the joint, 0 .. N - 1, or its name
/// @throws std::invalid_argument if there is no such joint or a position is not finite
/// @throws std::invalid_argument if other joints mimic it, so that it carries several bodies; each
///         message names the joint
/// Real-time: no (set-up).
template <Robot R, class Joint>
[[nodiscard]] CarriedBody carried_body(const R& robot, const JointVector<joint_count<R>>& q,
                                       const Joint& joint) {
  static_assert(detail::has_masses<R, CarriedBody>);
  const int own_joint = detail::checked_joint(robot, q, joint);
  const auto& mechanism = model_of(robot).mechanism;
  constexpr int n = joint_count<R>;
  constexpr int b = moving_joint_count<R>;
  const Configuration<double, b> configuration =
      configuration_of<double, n, b>(mechanism, detail::to_array(q));

  int own = -1;  // the body on the joint
  for (int i = 0; i < b; ++i) {
    if ((n == b ? i : mechanism.couplings[i].joint) != own_joint) continue;
    if (own >= 0) {
      detail::refuse({"joint '", model_of(robot).joints[own_joint].name.view(),
                      "' is mimicked by other joints and carries more than one body"});
    }
    own = i;
  }
  JointArray<MassMoments<double>, b> composite{};
  for (int i = b - 1; i >= own; --i) {
    composite[i] = composite[i] + configuration[i].moments;
    const int parent = mechanism.bodies[i].parent;
    if (parent >= own) configuration[i].add_to_parent(composite[i], composite[parent]);
  }
  const auto& [mass, first, second] = composite[own];
  CarriedBody body{.mass = mass, .about_axis = second.xx + second.yy};
  if (mass > 0) body.lever = std::hypot(first.x, first.y) / mass;
  body.about_center = body.about_axis - mass * body.lever * body.lever;
  return body;
}

}  // namespace articula

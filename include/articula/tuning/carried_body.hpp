// SPDX-License-Identifier: Apache-2.0
/// @file What a joint carries, as one rigid body.
#pragma once

#include "articula/core/refuse.hpp"
#include "articula/dynamics/engine/configuration.hpp"
#include "articula/dynamics/engine/evaluate.hpp"
#include "articula/model/dynamic_robot.hpp"
#include "articula/model/robot.hpp"
#include "articula/tuning/equivalent_inertia.hpp"

#include <cmath>
#include <cstddef>
#include <string_view>

namespace articula {

/// The links beyond a joint, taken as one rigid body, as far as the joint's axis knows them. A
/// drive has to turn about_axis; about_center is less, by mass lever^2, and turns nothing on its
/// own.
struct CarriedBody {
  double mass = 0;          ///< m [kg]
  double lever = 0;         ///< c, distance of the centre of mass from the axis [m]
  double about_axis = 0;    ///< inertia about the joint's axis [kg m^2]
  double about_center = 0;  ///< inertia about the parallel axis through the centre of mass [kg m^2]
};

/// What a joint carries with all joints beyond it locked: masses and moments add up, and the two
/// inertias differ by the parallel-axis term, about_axis = about_center + m c^2. Reflected inertia
/// of drives is not part of it.
/// @param robot  a described robot or a model
/// @param q      joint positions [rad or m], N x 1
/// @param joint  index of the joint, 0 .. N - 1
/// @throws std::invalid_argument if there is no such joint, others mimic it (it carries several
///         bodies then), or a position is not finite; the message names the joint
/// Real-time: no (set-up).
template <Robot R>
[[nodiscard]] CarriedBody carried_body(const R& robot, const JointVector<joint_count<R>>& q,
                                       int joint) {
  static_assert(detail::has_masses<R, CarriedBody>);
  detail::check_joint_and_positions(robot, q, joint);
  const auto& mechanism = model_of(robot).mechanism;
  constexpr int n = joint_count<R>;
  constexpr int b = static_cast<int>(std::tuple_size_v<decltype(mechanism.bodies)>);
  const Configuration<double, b> configuration =
      configuration_of<double, n, b>(mechanism, detail::to_array(q));

  int own = -1;  // the body on the joint
  for (int i = 0; i < b; ++i) {
    const int moved_by = n == b ? i : mechanism.couplings[static_cast<std::size_t>(i)].joint;
    if (moved_by != joint) continue;
    if (own >= 0) {
      detail::refuse({"joint '", joint_names(robot)[static_cast<std::size_t>(joint)],
                      "' is mimicked by others and carries more than one body"});
    }
    own = i;
  }
  std::array<MassMoments<double>, static_cast<std::size_t>(b)> composite{};
  for (std::size_t i = composite.size(); i-- > static_cast<std::size_t>(own);) {
    composite[i] = composite[i] + configuration[i].moments;
    const int parent = mechanism.bodies[i].parent;
    if (parent >= own) {
      configuration[i].add_to_parent(composite[i], composite[static_cast<std::size_t>(parent)]);
    }
  }
  const auto& [mass, first, second] = composite[static_cast<std::size_t>(own)];
  CarriedBody body{.mass = mass, .about_axis = second.xx + second.yy};
  if (mass > 0) body.lever = std::hypot(first.x, first.y) / mass;
  body.about_center = body.about_axis - mass * body.lever * body.lever;
  return body;
}

/// The same for a joint by its name.
/// @throws std::invalid_argument as above
/// Real-time: no (set-up).
template <Robot R>
[[nodiscard]] CarriedBody carried_body(const R& robot, const JointVector<joint_count<R>>& q,
                                       std::string_view joint) {
  return carried_body(robot, q, joint_index(robot, joint));
}

}  // namespace articula

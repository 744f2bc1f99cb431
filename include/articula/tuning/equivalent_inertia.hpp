// SPDX-License-Identifier: Apache-2.0
/// @file The inertia that the drive of a joint accelerates.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/joint_array.hpp"
#include "articula/core/refuse.hpp"
#include "articula/dynamics/engine/tree_factors.hpp"
#include "articula/dynamics/mass_matrix.hpp"
#include "articula/model/robot.hpp"

#include <concepts>
#include <string_view>

namespace articula {

/// The state of the other joints while one joint moves.
enum class OtherJoints : unsigned char {
  locked,  ///< held by brakes or by much stiffer controllers
  free,    ///< without effort
};

namespace detail {

/// The index of a joint.
/// @param q      joint positions [rad or m], N x 1
/// @param joint  its index or its name
/// @throws std::invalid_argument if there is no such joint or a position is not finite; the message
///         names the joint and the valid range
template <Robot R, class Joint>
[[nodiscard]] int checked_joint(const R& robot, const JointVector<joint_count<R>>& q,
                                const Joint& joint) {
  for (int j = 0; j < joint_count<R>; ++j) {
    if (is_finite(q[j])) continue;
    refuse({"position ", q[j], " of joint '", model_of(robot).joints[j].name.view(),
            "' is not finite"});
  }
  if constexpr (std::convertible_to<const Joint&, std::string_view>) {
    return joint_index(robot, joint);
  } else {
    if (joint >= 0 && joint < joint_count<R>) return joint;
    refuse({"robot '", model_of(robot).name.view(), "': joint index ", joint,
            " is not within 0 .. ", joint_count<R> - 1});
  }
}

}  // namespace detail

/// The inertia that the drive of a joint accelerates, at rest and without gravity:
///
///     I = M_jj               the other joints locked
///     I = 1 / (M^-1)_jj      the other joints free, at most the former
///
/// Both follow from M(q) a = effort [Featherstone 2008, section 6.1]: only the acceleration of
/// joint j, or only its effort, is not zero.
///
///     equivalent_inertia(Ur10(), q, "elbow_joint", OtherJoints::free)
///
/// @param robot   a described robot or a model
/// @param q       joint positions [rad or m], N x 1
/// @param joint   index of the joint, 0 .. N - 1, or its name
/// @param others  whether the other joints are locked or free
/// @return        I [kg m^2 or kg]
/// @throws std::invalid_argument if there is no such joint or a position is not finite
/// @throws std::invalid_argument if the other joints are free and M(q) is singular; each message
///         names the joint
/// Real-time: no (set-up).
template <Robot R, class Joint>
[[nodiscard]] double equivalent_inertia(const R& robot, const JointVector<joint_count<R>>& q,
                                        const Joint& joint,
                                        OtherJoints others = OtherJoints::locked) {
  constexpr int n = joint_count<R>;
  const int own = detail::checked_joint(robot, q, joint);
  const JointMatrix<n> matrix = mass_matrix(robot, q);
  if (others == OtherJoints::locked) return matrix(own, own);
  const JointArray<int, n> parents = elimination_tree(model_of(robot).mechanism);
  const auto factors = factorise<double, n>(parents, detail::to_rows(matrix));
  for (int j = n - 1; j >= 0; --j) {  // in the order of elimination
    // Where a pivot should be 0, cancellation leaves about 1e-16 of the diagonal.
    if (1 / factors.inverse_pivot[j] > 1e-12 * matrix(j, j)) continue;
    detail::refuse({"the mass matrix is singular: joint '", model_of(robot).joints[j].name.view(),
                    "' moves no mass if the joints that it carries are free"});
  }
  JointArray<double, n> effort{};
  effort[own] = 1;
  return 1 / solve<double, n>(parents, factors, effort)[own];
}

}  // namespace articula

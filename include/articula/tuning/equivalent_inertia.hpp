// SPDX-License-Identifier: Apache-2.0
/// @file The inertia that one joint's drive sees.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/refuse.hpp"
#include "articula/dynamics/engine/tree_factors.hpp"
#include "articula/dynamics/mass_matrix.hpp"
#include "articula/model/robot.hpp"

#include <cstddef>
#include <string_view>

namespace articula {

/// What the other joints do while one is moved.
enum class OtherJoints : unsigned char {
  locked,  ///< they stay: held by brakes, or by controllers that are much stiffer
  free,    ///< no drive holds them: they give way
};

namespace detail {

/// @throws std::invalid_argument naming the index and how many joints there are, or the joint whose
///         position is not finite
template <Robot R>
void check_joint_and_positions(const R& robot, const JointVector<joint_count<R>>& q, int joint) {
  if (joint < 0 || joint >= joint_count<R>) {
    refuse({"robot '", model_of(robot).name.view(), "': joint index ", joint,
            " is not within 0 .. ", joint_count<R> - 1});
  }
  for (int j = 0; j < joint_count<R>; ++j) {
    if (is_finite(q[j])) continue;
    refuse({"position ", q[j], " of joint '", joint_names(robot)[static_cast<std::size_t>(j)],
            "' is not finite"});
  }
}

}  // namespace detail

/// The inertia that a joint's drive has to accelerate, at rest and without weight:
///
///     I = M_jj               the other joints locked
///     I = 1 / (M^-1)_jj      the other joints free, never more than the former
///
/// Both follow from M(q) a = effort [Featherstone 2008, section 6.1]: with the acceleration of
/// joint j alone, or its effort alone, not zero.
/// @param robot   a described robot or a model
/// @param q       joint positions [rad or m], N x 1
/// @param joint   index of the joint, 0 .. N - 1
/// @param others  what the other joints do
/// @return        I [kg m^2 or kg]
/// @throws std::invalid_argument if there is no such joint, a position is not finite, or M(q) is
///         singular, which leaves nothing to compute where the others are free; the message names
///         the joint
/// Real-time: no (set-up).
template <Robot R>
[[nodiscard]] double equivalent_inertia(const R& robot, const JointVector<joint_count<R>>& q,
                                        int joint, OtherJoints others = OtherJoints::locked) {
  constexpr int n = joint_count<R>;
  detail::check_joint_and_positions(robot, q, joint);
  const JointMatrix<n> matrix = mass_matrix(robot, q);
  if (others == OtherJoints::locked) return matrix(joint, joint);
  const JointArray<int, n> parents = elimination_tree(model_of(robot).mechanism);
  const auto factors = factorise<double, n>(parents, detail::to_rows(matrix));
  for (int j = n - 1; j >= 0; --j) {  // in the order of elimination
    const double pivot = 1 / factors.inverse_pivot[j];
    if (pivot > 1e-12 * matrix(j, j))
      continue;  // what cancellation leaves of nothing is some 1e-16
    detail::refuse({"the mass matrix is singular: joint '",
                    joint_names(robot)[static_cast<std::size_t>(j)],
                    "' moves no mass when the joints that it carries give way"});
  }
  JointArray<double, n> effort{};
  effort[joint] = 1;
  return 1 / solve<double, n>(parents, factors, effort)[joint];
}

/// The same for a joint by its name.
/// @throws std::invalid_argument as above
/// Real-time: no (set-up).
template <Robot R>
[[nodiscard]] double equivalent_inertia(const R& robot, const JointVector<joint_count<R>>& q,
                                        std::string_view joint,
                                        OtherJoints others = OtherJoints::locked) {
  return equivalent_inertia(robot, q, joint_index(robot, joint), others);
}

}  // namespace articula

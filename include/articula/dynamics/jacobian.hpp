// SPDX-License-Identifier: Apache-2.0
/// @file Jacobians: velocities of links from velocities of joints.
#pragma once

#include "articula/dynamics/forward_kinematics.hpp"

#include <string_view>

namespace articula {

/// The derivatives of a link frame's motion with respect to joint velocities, 6 x N.
template <int N>
using LinkJacobian = Eigen::Matrix<double, 6, N>;

namespace detail {

/// Adds a body's contribution to the column of its joint. Let r lead from a point of the axis z to
/// a point. A body that turns about the axis moves the point by z x r, and turns a frame there by
/// z. A body that slides along z moves the point by z. Source: [Siciliano et al. 2009, section
/// 3.1.3].
/// @param jacobian  6 x N, column by column
template <class S, int N, int B>
[[gnu::always_inline]] constexpr void add_column(const Mechanism<N, B>& mechanism, int body,
                                                 const Vector3<S>& z, const Vector3<S>& r,
                                                 S* jacobian) noexcept {
  const bool slides = mechanism.bodies[body].prismatic;
  const Vector3<S> linear = slides ? z : cross(z, r);
  const Vector3<S> angular = slides ? Vector3<S>{} : z;
  const S rates[] = {linear.x, linear.y, linear.z, angular.x, angular.y, angular.z};
  for (int k = 0; k < 6; ++k) {
    if constexpr (N == B) {
      jacobian[6 * body + k] = rates[k];
    } else {
      const Coupling& coupling = mechanism.couplings[body];
      S& element = jacobian[6 * coupling.joint + k];
      element = element + S(coupling.multiplier) * rates[k];
    }
  }
}

/// A link's Jacobian from its chain.
/// @param[in,out] jacobian  6 x N, column by column, filled with zeros
template <class S, int N, int B>
constexpr void fill_jacobian(const Mechanism<N, B>& mechanism, LinkChain<S, B>& chain,
                             S* jacobian) noexcept {
  Vector3<S> lever = chain.last_step;
  for (int k = chain.path.count; k-- > 0;) {
    add_column<S, N, B>(mechanism, chain.path.bodies[k], chain.axes[k], lever, jacobian);
    lever = chain.steps[k] + lever;
  }
}

/// The same from the placements of all bodies.
template <int N, int B>
void fill_jacobian(const Mechanism<N, B>& mechanism, const LinkFrame& link,
                   const JointArray<Placement<double>, B>& bodies, double* jacobian) noexcept {
  const Placement<double>& carrier = bodies[link.body];
  const Vector3<double> point = carrier.rotation * link.placement.translation + carrier.translation;
  for (int i = link.body; i >= 0; i = mechanism.bodies[i].parent) {
    add_column<double, N, B>(mechanism, i, bodies[i].rotation.column(2),
                             point - bodies[i].translation, jacobian);
  }
}

}  // namespace detail

/// The algorithm of the Jacobian of a link named at compile time, along the joints that move it.
/// @tparam Link  the name, as in `JacobianOf<"tool0">`
template <Name Link>
struct JacobianOf {
  static constexpr bool needs_no_masses = true;
  static constexpr Name link = Link;

  /// @return 6 x N, column by column
  template <Frames frames, class S, class AnyModel>
  [[nodiscard]] static constexpr auto evaluate(const AnyModel& model,
                                               const JointArray<S, AnyModel::joint_count>& q) {
    constexpr int n = AnyModel::joint_count, b = AnyModel::body_count;
    const LinkFrame& frame = model.links[detail::index_of_link(model, Link)];
    auto chain = detail::link_chain<frames, S, n, b>(model.mechanism, frame, q);
    JointArray<S, 6 * n> jacobian;
    jacobian.fill(S(0.0));
    detail::fill_jacobian<S, n, b>(model.mechanism, chain, jacobian.data());
    return jacobian;
  }
};

/// The geometric Jacobian of a link. J(q) v are the velocity of the link's origin (rows 0 to 2) and
/// the angular velocity of the link (rows 3 to 5). Both are in the frame of the robot's root link.
/// J(q)^T (f, n) are the joint efforts that do the work of a force f at that origin and a moment n.
/// Joints that do not move the link have columns of zeros.
/// @param robot  a described robot or a model
/// @param q      joint positions [rad or m], N x 1
/// @param link   the link, from link_index of the same robot
/// @return       J, 6 x N; rows 0 to 2 in m/rad (1 for a prismatic joint), rows 3 to 5 in rad/rad
///               (0 for a prismatic joint)
/// Real-time: yes. O(N). It takes operations<BodyPlacements, R>() and 9 multiplications for each
/// joint before the link.
template <Robot R>
[[nodiscard]] LinkJacobian<joint_count<R>> jacobian(const R& robot,
                                                    const JointVector<joint_count<R>>& q,
                                                    LinkIndex link) noexcept {
  const auto& model = model_of(robot);
  const LinkFrame& frame = model.links[link.value];
  LinkJacobian<joint_count<R>> jacobian = LinkJacobian<joint_count<R>>::Zero();
  if (detail::all_bodies_are_faster<R>(frame)) {
    detail::fill_jacobian(model.mechanism, frame, detail::evaluate<BodyPlacements>(robot, q),
                          jacobian.data());
    return jacobian;
  }
  auto chain = detail::link_chain<Frames::moving>(model.mechanism, frame, detail::to_array(q));
  detail::fill_jacobian(model.mechanism, chain, jacobian.data());
  return jacobian;
}

/// The same for a link named at compile time, `jacobian<"tool0">(Ur10(), q)`. This is the fastest
/// way, because the compiler knows the joints that move the link. A name that the robot does not
/// have does not compile. Real-time: yes. The number of operations is
/// operations<JacobianOf<"tool0">, Ur10>().
template <Name Link, DescribedRobot R>
[[nodiscard]] LinkJacobian<joint_count<R>> jacobian(const R&,
                                                    const JointVector<joint_count<R>>& q) noexcept {
  LinkJacobian<joint_count<R>> jacobian;
  if constexpr (detail::has_link<Link, R>()) {
    const auto columns = compiled::run<JacobianOf<Link>, R>(q.data());
    symbolic::detail::for_each_index<columns.size()>(
        [&](std::size_t i) __attribute__((always_inline)) { jacobian.data()[i] = columns[i]; });
  } else {
    detail::reject_link<Link, R>();
  }
  return jacobian;
}

/// The same for a link by its name.
/// @throws std::invalid_argument if the robot has no such link
/// Real-time: no (throws, searches by name).
template <Robot R>
[[nodiscard]] LinkJacobian<joint_count<R>> jacobian(const R& robot,
                                                    const JointVector<joint_count<R>>& q,
                                                    std::string_view link) {
  return jacobian(robot, q, link_index(robot, link));
}

}  // namespace articula

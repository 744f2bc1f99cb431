// SPDX-License-Identifier: Apache-2.0
/// @file Forward kinematics: the placements of links.
#pragma once

#include "articula/dynamics/engine/body_placements.hpp"
#include "articula/dynamics/engine/evaluate.hpp"
#include "articula/dynamics/engine/link_chain.hpp"

#include <Eigen/Geometry>

#include <cstddef>
#include <string_view>
#include <utility>

namespace articula {

/// The index of a robot's link: found by name once, used in the loop.
struct LinkIndex {
  std::size_t value = 0;
};

namespace detail {

template <class AnyModel>
[[nodiscard]] constexpr std::size_t index_of_link(const AnyModel& model, std::string_view name) {
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    if (model.links[i].name.view() == name) return i;
  }
  no_such_link(model, name);
}

}  // namespace detail

/// Finds a link by name, fixed ones included. As a constant it is checked by the compiler:
/// `constexpr auto tool = link_index(Q2d{}, "tool_link");`.
/// @throws std::invalid_argument if the robot has no such link; the message lists its links
/// Real-time: no (throws).
template <Robot R>
[[nodiscard]] constexpr LinkIndex link_index(const R& robot, std::string_view name) {
  return {detail::index_of_link(model_of(robot), name)};
}

namespace detail {

/// Its instantiation is the error message for a link that the robot does not have.
/// @tparam R      the robot
/// @tparam Asked  the requested name
/// @tparam Links  the names of its links
template <class R, class Asked, class... Links>
struct RobotHasNoLink {
  static_assert(!Robot<R>,
                "articula: the robot has no link of that name. The first template argument of "
                "RobotHasNoLink is the robot, the second is the requested name, the others are the "
                "names of its links.");
};

/// Whether a robot has a link of a name.
template <Name Link, DescribedRobot R>
[[nodiscard]] consteval bool has_link() {
  for (const auto& link : model_of(R{}).links) {
    if (link.name == Link) return true;
  }
  return false;
}

/// Instantiates the message. (Deduced arguments are printed as values, given ones as expressions.)
template <class R, class Asked, class... Links>
constexpr void print_names(Asked, Links...) {
  static_cast<void>(RobotHasNoLink<R, Asked, Links...>());
}

/// Causes the compiler's error message, with the names of the robot's links.
template <Name Link, DescribedRobot R>
constexpr void reject_link() {
  constexpr const auto& links = model_of(R{}).links;
  []<std::size_t... I>(std::index_sequence<I...>) {
    print_names<R>(printable<Link>(), printable<links[I].name>()...);
  }(std::make_index_sequence<links.size()>());
}

/// A link's frame in the base frame: the sum of the steps of its chain, and its rotation.
template <class S, int B>
[[nodiscard]] constexpr Placement<S> placement_at_end(LinkChain<S, B>& chain) noexcept {
  Vector3<S> translation = chain.last_step;
  for (int k = chain.path.count; k-- > 0;) translation = chain.steps[k] + translation;
  return {chain.rotation, translation};
}

[[nodiscard]] inline Eigen::Isometry3d to_isometry(const Placement<double>& placement) noexcept {
  const auto to_eigen = [](const Vector3<double>& a) { return Eigen::Vector3d(a.x, a.y, a.z); };
  Eigen::Isometry3d isometry = Eigen::Isometry3d::Identity();
  for (int k = 0; k < 3; ++k) isometry.linear().col(k) = to_eigen(placement.rotation.column(k));
  isometry.translation() = to_eigen(placement.translation);
  return isometry;
}

}  // namespace detail

/// The algorithm of forward kinematics for a link named at compile time, along the joints that move
/// it.
/// @tparam Link  the name, as in `PlacementOf<"tool0">`
template <Name Link>
struct PlacementOf {
  static constexpr bool needs_no_masses = true;
  static constexpr Name link = Link;

  template <Frames frames, class S, class AnyModel>
  [[nodiscard]] static constexpr Placement<S> evaluate(
      const AnyModel& model, const JointArray<S, AnyModel::joint_count>& q) {
    constexpr int n = AnyModel::joint_count, b = AnyModel::body_count;
    const LinkFrame& frame = model.links[detail::index_of_link(model, Link)];
    auto chain = detail::link_chain<frames, S, n, b>(model.mechanism, frame, q);
    return detail::placement_at_end(chain);
  }
};

/// The placement of a link's frame in the frame of the robot's root link: X_0L(q).
/// @param robot  a described robot or a model
/// @param q      joint positions [rad or m], N x 1
/// @param link   the link, from link_index of the same robot
/// @return       rotation (dimensionless) and translation [m], as a 4 x 4 isometry
/// Real-time: yes. O(N).
template <Robot R>
[[nodiscard]] Eigen::Isometry3d forward_kinematics(const R& robot,
                                                   const JointVector<joint_count<R>>& q,
                                                   LinkIndex link) noexcept {
  const auto& model = model_of(robot);
  const LinkFrame& frame = model.links[link.value];
  if (detail::all_bodies_are_faster<R>(frame)) {
    const auto bodies = detail::evaluate<BodyPlacements>(robot, q);
    return detail::to_isometry(bodies[frame.body] * frame.placement);
  }
  auto chain = detail::link_chain<Frames::moving>(model.mechanism, frame, detail::to_array(q));
  return detail::to_isometry(detail::placement_at_end(chain));
}

/// The same for a link named at compile time, `forward_kinematics<"tool0">(Ur10(), q)`. This is the
/// fastest way, because the compiler knows the joints that move the link. A name that the robot
/// does not have does not compile. Real-time: yes. The number of operations is
/// operations<PlacementOf<"tool0">, Ur10>().
template <Name Link, DescribedRobot R>
[[nodiscard]] Eigen::Isometry3d forward_kinematics(const R&,
                                                   const JointVector<joint_count<R>>& q) noexcept {
  if constexpr (detail::has_link<Link, R>()) {
    return detail::to_isometry(compiled::run<PlacementOf<Link>, R>(q.data()));
  } else {
    detail::reject_link<Link, R>();
    return Eigen::Isometry3d::Identity();
  }
}

/// The same for a link by its name.
/// @throws std::invalid_argument if the robot has no such link
/// Real-time: no (throws, searches by name).
template <Robot R>
[[nodiscard]] Eigen::Isometry3d forward_kinematics(const R& robot,
                                                   const JointVector<joint_count<R>>& q,
                                                   std::string_view link) {
  return forward_kinematics(robot, q, link_index(robot, link));
}

}  // namespace articula

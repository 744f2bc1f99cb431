// SPDX-License-Identifier: Apache-2.0
/// @file The robot that algorithms take: a type with a description, or a model loaded at run time.
#pragma once

#include "articula/core/joint_vector.hpp"
#include "articula/model/build_model.hpp"
#include "articula/model/description.hpp"

#include <array>
#include <string_view>
#include <type_traits>

namespace articula {

/// A robot that is known when the program is compiled: an empty type with a constexpr description.
/// Its algorithms are the fastest, and the compiler refuses a description with a fault:
///
///     struct Pendulum {
///       static constexpr RobotDescription description{.name = "pendulum", ...};
///     };
///
/// CMake's `articula_add_robot` makes such a type from a URDF. Do not write one for a file that a
/// user of the program chooses: load_urdf gives a Model.
template <class R>
concept DescribedRobot = std::is_empty_v<R> && std::is_default_constructible_v<R> &&
                         is_robot_description<std::remove_cvref_t<decltype(R::description)>>;

namespace detail {

template <class T>
inline constexpr bool is_model = false;
template <int N, int Bodies, class LinkFrames, bool Kinematic>
inline constexpr bool is_model<Model<N, Bodies, LinkFrames, Kinematic>> = true;

/// The model of a described robot, checked by the compiler.
template <DescribedRobot R>
[[nodiscard]] consteval auto compile_model() {
  constexpr const auto& description = R::description;
  constexpr auto fault =
      find_fault(description.name, description.gravity, description.links, description.joints,
                 description.allow_unphysical, description.kinematic);
  if constexpr (fault.rule != Rule::none) {
    return reject(printable<fault.element>(), std::integral_constant<Rule, fault.rule>{});
  } else {
    constexpr ModelSize size = model_size(description.joints);
    using LinkFrames = std::array<LinkFrame, description.links.size()>;
    return build_model<size.joints, size.bodies, description.kinematic>(
        description.name, description.gravity, description.links, description.joints, LinkFrames{},
        description.right_angle_tolerance);
  }
}

template <DescribedRobot R>
inline constexpr auto compiled_model = compile_model<R>();

}  // namespace detail

/// A robot, the first argument of all algorithms. It is known at compile time (DescribedRobot) or
/// loaded at run time (a Model). A function for both takes `const R& robot`:
///
///     template <Robot R>
///     int moving_joints(const R& robot) { return joint_count<R>; }
///
/// An algorithm that needs masses takes a DynamicRobot.
template <class R>
concept Robot = DescribedRobot<R> || detail::is_model<R>;

/// The model of a robot. For a described robot, the compiler made it. A model is its own.
/// Real-time: yes.
template <Robot R>
[[nodiscard]] constexpr const auto& model_of(const R& robot) noexcept {
  if constexpr (DescribedRobot<R>) {
    return detail::compiled_model<R>;
  } else {
    return robot;
  }
}

/// The number of joints that can be commanded. Fixed joints and joints that mimic another are none.
template <Robot R>
inline constexpr int joint_count =
    std::remove_cvref_t<decltype(model_of(std::declval<R>()))>::joint_count;

/// The names of these joints in their order: depth first, siblings by joint name.
/// Real-time: yes.
template <Robot R>
[[nodiscard]] constexpr auto joint_names(const R& robot) noexcept {
  std::array<std::string_view, joint_count<R>> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = model_of(robot).joints[i].name.view();
  return names;
}

/// Deleted for temporary models: the names refer to the model.
template <Robot R>
  requires(!DescribedRobot<R>)
auto joint_names(const R&& robot) = delete;

/// The index of one of these joints by name.
/// @throws std::invalid_argument with the reason if the joint is fixed, mimics another one, or does
///         not exist
/// Real-time: no (throws).
template <Robot R>
[[nodiscard]] constexpr int joint_index(const R& robot, std::string_view name) {
  for (int i = 0; i < joint_count<R>; ++i) {
    if (model_of(robot).joints[i].name.view() == name) return i;
  }
  detail::no_such_joint(model_of(robot), name);
}

/// One property of every joint, such as `joint_values(robot, [](auto& j) { return j.damping; })`.
/// @param property  called with the JointProperties of each joint
/// @return          the values in the order of the joints, N x 1
/// Real-time: yes if `property` is.
template <Robot R, class Property>
[[nodiscard]] JointVector<joint_count<R>> joint_values(const R& robot, Property property) noexcept {
  JointVector<joint_count<R>> values;
  for (int i = 0; i < joint_count<R>; ++i) {
    values[i] = property(model_of(robot).joints[i]);
  }
  return values;
}

/// The highest effort of each joint's drive in either direction [N m or N], N x 1. Real-time: yes.
template <Robot R>
[[nodiscard]] JointVector<joint_count<R>> effort_limits(const R& robot) noexcept {
  return joint_values(robot, [](const JointProperties& joint) { return joint.limits.effort; });
}

/// True for a robot without known masses. Its description has `.kinematic = true`, or it is a
/// KinematicModel.
template <Robot R>
inline constexpr bool is_kinematic =
    std::remove_cvref_t<decltype(model_of(std::declval<R>()))>::kinematic;

/// A robot with known masses, so that dynamics can be computed. Frames and Jacobians need none:
/// take a Robot there.
template <class R>
concept DynamicRobot = Robot<R> && !is_kinematic<R>;

namespace detail {

/// Its instantiation is the compiler error where dynamics are needed of a robot without masses.
/// @tparam R     the robot
/// @tparam User  the algorithm or class that needs its dynamics
template <Robot R, class User>
struct RobotHasNoMasses {
  static_assert(!is_kinematic<R>,
                "articula: this robot is kinematic: it was described with .kinematic = true or "
                "loaded by load_kinematic_urdf, so its masses are not known and it has no "
                "dynamics. The first template argument of RobotHasNoMasses is the robot, the "
                "second is the algorithm or class that needs dynamics.");
  static constexpr bool found = true;
};

/// True. An algorithm or class that needs masses has `static_assert(detail::has_masses<R, User>)`.
template <Robot R, class User>
inline constexpr bool has_masses = RobotHasNoMasses<R, User>::found;

}  // namespace detail

}  // namespace articula

// SPDX-License-Identifier: Apache-2.0
/// @file The way from the base to one link, joint by joint.
#pragma once

#include "articula/dynamics/engine/body_placements.hpp"
#include "articula/dynamics/engine/evaluate.hpp"
#include "articula/dynamics/engine/unset_array.hpp"
#include "articula/model/robot.hpp"
#include "articula/symbolic/sine_cosine.hpp"

#include <algorithm>
#include <concepts>
#include <type_traits>
#include <utility>

namespace articula::detail {

/// The bodies that move a link, from the base outwards.
template <int B>
struct LinkPath {
  JointArray<int, B> bodies{};
  int count = 0;

  template <int N>
  constexpr LinkPath(const Mechanism<N, B>& mechanism, const LinkFrame& link) noexcept {
    const auto parent = [&](int body) { return mechanism.bodies[body].parent; };
    for (int body = link.body; body >= 0; body = parent(body)) ++count;
    int k = count;
    for (int body = link.body; body >= 0; body = parent(body)) bodies[--k] = body;
  }
};

/// How a link hangs on the base: an axis and a step for each joint that moves it. All vectors are
/// in the frame of the base.
/// @tparam B  number of bodies of the robot
template <class S, int B>
struct LinkChain {
  UnsetArray<Vector3<S>, B> axes;   ///< z of each body on the way
  UnsetArray<Vector3<S>, B> steps;  ///< from the origin of the body before, or the base, to its own
  Vector3<S> last_step{};           ///< from the last body's origin to the link's
  Matrix3<S> rotation{};            ///< of the link's frame
};

/// True if a body's axis is parallel to that of the body that carries it.
[[nodiscard]] constexpr bool is_parallel_to_parent(const Body& body) noexcept {
  const Vector3<double>& axis = body.placement.rotation.rows[2];
  return body.parent >= 0 && axis.x == 0 && axis.y == 0;
}

/// How far each body on the way has turned about its axis. In moving frames that is the joint's own
/// turn. In resting frames it is the sum of those of the parallel axes that follow each other.
template <Frames frames, class S, int N, int B>
[[nodiscard]] constexpr JointArray<AxialTurn<S>, B> turns_along(
    const Mechanism<N, B>& mechanism, const LinkPath<B>& path,
    const JointArray<S, B>& position) noexcept {
  JointArray<AxialTurn<S>, B> turns;
  if constexpr (std::same_as<S, double> && frames == Frames::moving) {
    if (!std::is_constant_evaluated()) {
      // As many at a time as fill the widest registers.
      constexpr int at_once = std::min(B, 8);
      for (int begin = 0; begin < path.count; begin += at_once) {
        const int taken = std::min(at_once, path.count - begin);
        JointArray<double, at_once> angle{}, sine, cosine;
        for (int k = 0; k < taken; ++k) angle[k] = position[path.bodies[begin + k]];
        symbolic::sine_cosine(angle, sine, cosine);
        for (int k = 0; k < taken; ++k) turns[begin + k] = {sine[k], cosine[k]};
      }
      return turns;
    }
  }
  S angle(0.0);
  for (int k = 0; k < B && k < path.count; ++k) {
    const Body& body = mechanism.bodies[path.bodies[k]];
    const bool goes_on = frames == Frames::resting && is_parallel_to_parent(body);
    angle = !goes_on ? S(0.0) : body.placement.rotation.rows[2].z > 0 ? angle : -angle;
    if (!body.prismatic) angle = angle + position[path.bodies[k]];
    turns[k] = turn_by(angle);
  }
  return turns;
}

/// Walks from the base to a link. (Loops say twice where they end: compilers unroll those of small
/// robots.)
/// @tparam frames    resting ones add the angles of parallel axes that follow each other
/// @param mechanism  the robot's bodies, to which link frames refer
/// @param path       the bodies that move the link
/// @param link       the link
/// @param q          joint positions [rad or m]
template <Frames frames, class S, int N, int B>
[[nodiscard]] constexpr LinkChain<S, B> link_chain(const Mechanism<N, B>& mechanism,
                                                   const LinkPath<B>& path, const LinkFrame& link,
                                                   const JointArray<S, N>& q) noexcept {
  const JointArray<S, B> position = body_positions<S, N, B>(mechanism, q);
  const JointArray<AxialTurn<S>, B> turns = turns_along<frames, S, N, B>(mechanism, path, position);
  LinkChain<S, B> chain;
  Matrix3<S> rotation = constant<S>(Matrix3<double>::identity());
  AxialTurn<S> turn{S(0.0), S(1.0)};  // of the body before in the frame that `rotation` belongs to
  bool turns_before = false;
  for (int k = 0; k < B && k < path.count; ++k) {
    const Body& body = mechanism.bodies[path.bodies[k]];
    const Vector3<S> place = constant<S>(body.placement.translation);
    const bool goes_on = frames == Frames::resting && is_parallel_to_parent(body);
    Vector3<S> step;
    if (goes_on) {
      step = rotation * turn(place);
    } else {
      if (turns_before) rotation = turned(rotation, turn);
      step = rotation * place;
    }
    rotation = k == 0 ? constant<S>(body.placement.rotation)
                      : rotation * constant<S>(body.placement.rotation);
    turn = turns[k];
    turns_before = goes_on || !body.prismatic;
    chain.axes.set(k, rotation.column(2));
    if (body.prismatic) step = step + position[path.bodies[k]] * chain.axes[k];
    chain.steps.set(k, step);
  }
  if (turns_before) rotation = turned(rotation, turn);
  chain.last_step = rotation * constant<S>(link.placement.translation);
  chain.rotation = rotation * constant<S>(link.placement.rotation);
  return chain;
}

/// For each body of a robot known at compile time whether the program of all bodies, which knows
/// zeros, takes no longer than the walk to this one alone.
template <DescribedRobot R>
inline constexpr auto program_is_cheaper = [] {
  constexpr const auto& mechanism = model_of(R{}).mechanism;
  constexpr int b = std::remove_cvref_t<decltype(model_of(R{}))>::body_count;
  // A product of two placements, a turn, a sine and the loop around them, in multiplications.
  constexpr int cost_of_a_step = 100;
  JointArray<bool, b> cheaper{};
  for (int i = 0; i < b; ++i) {
    const LinkPath<b> path(mechanism, {.body = i});
    cheaper[i] = operations<BodyPlacements, R>().cost() <= path.count * cost_of_a_step;
  }
  return cheaper;
}();

/// Whether a link named at run time is placed sooner by placing all bodies: by a program that knows
/// zeros, or because there are so few that finding the way takes longer.
template <Robot R>
[[nodiscard]] constexpr bool takes_all_bodies(const LinkFrame& link) noexcept {
  constexpr int b = std::remove_cvref_t<decltype(model_of(std::declval<R>()))>::body_count;
  if constexpr (DescribedRobot<R>) {
    return link.body >= 0 && program_is_cheaper<R>[link.body];
  }
  return link.body >= 0 && b <= 3;
}

}  // namespace articula::detail

// SPDX-License-Identifier: Apache-2.0
/// @file The chain of bodies from the base to one link.
#pragma once

#include "articula/dynamics/engine/body_placements.hpp"
#include "articula/dynamics/engine/compiled.hpp"
#include "articula/dynamics/engine/unset_array.hpp"
#include "articula/model/robot.hpp"
#include "articula/symbolic/sine_cosine.hpp"

#include <algorithm>
#include <concepts>
#include <type_traits>
#include <utility>

namespace articula::detail {

/// The bodies on the path from the base to a link.
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

/// The position of a link relative to the base: an axis and a step for each body on its path. All
/// vectors are in the base frame.
/// @tparam B  number of bodies of the robot
template <class S, int B>
struct LinkChain {
  LinkPath<B> path;                   ///< bodies between the base and the link
  UnsetArray<Vector3<S>, B> axes{};   ///< z of each body on the path
  UnsetArray<Vector3<S>, B> steps{};  ///< to each body's origin from that of its predecessor
  Vector3<S> last_step{};             ///< from the last body's origin to the link's
  Matrix3<S> rotation{};              ///< of the link's frame
};

/// True if a body's axis is parallel to that of the body that carries it.
[[nodiscard]] constexpr bool is_parallel_to_parent(const Body& body) noexcept {
  const Vector3<double>& axis = body.placement.rotation.rows[2];
  return body.parent >= 0 && axis.x == 0 && axis.y == 0;
}

/// The turn of each body on the path about its axis. In moving frames it is the joint's own turn,
/// in resting frames the sum over consecutive parallel axes.
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
    const bool same_axis = frames == Frames::resting && is_parallel_to_parent(body);
    angle = !same_axis ? S(0.0) : body.placement.rotation.rows[2].z > 0 ? angle : -angle;
    if (!body.prismatic) angle = angle + position[path.bodies[k]];
    turns[k] = turn_by(angle);
  }
  return turns;
}

/// The chain from the base to a link. (Each loop has a second, constant bound, so that compilers
/// unroll the loops of small robots.)
/// @tparam frames    resting frames add the angles of consecutive parallel axes
/// @param mechanism  the robot's bodies, to which link frames refer
/// @param link       the link
/// @param q          joint positions [rad or m]
template <Frames frames, class S, int N, int B>
[[nodiscard]] constexpr LinkChain<S, B> link_chain(const Mechanism<N, B>& mechanism,
                                                   const LinkFrame& link,
                                                   const JointArray<S, N>& q) noexcept {
  const JointArray<S, B> position = body_positions<S, N, B>(mechanism, q);
  LinkChain<S, B> chain{.path = LinkPath<B>(mechanism, link)};
  const LinkPath<B>& path = chain.path;
  const JointArray<AxialTurn<S>, B> turns = turns_along<frames, S, N, B>(mechanism, path, position);
  Matrix3<S> rotation = constant<S>(Matrix3<double>::identity());
  AxialTurn<S> turn{S(0.0), S(1.0)};  // of the predecessor, after `rotation`
  bool has_turn = false;
  for (int k = 0; k < B && k < path.count; ++k) {
    const Body& body = mechanism.bodies[path.bodies[k]];
    const Vector3<S> offset = constant<S>(body.placement.translation);
    const bool same_axis = frames == Frames::resting && is_parallel_to_parent(body);
    Vector3<S> step;
    if (same_axis) {
      step = rotation * turn(offset);
    } else {
      if (has_turn) rotation = turned(rotation, turn);
      step = rotation * offset;
    }
    rotation = k == 0 ? constant<S>(body.placement.rotation)
                      : rotation * constant<S>(body.placement.rotation);
    turn = turns[k];
    has_turn = same_axis || !body.prismatic;
    chain.axes.set(k, rotation.column(2));
    if (body.prismatic) step = step + position[path.bodies[k]] * chain.axes[k];
    chain.steps.set(k, step);
  }
  if (has_turn) rotation = turned(rotation, turn);
  chain.last_step = rotation * constant<S>(link.placement.translation);
  chain.rotation = rotation * constant<S>(link.placement.rotation);
  return chain;
}

/// For each body of a robot known at compile time, whether the program of all bodies costs no more
/// than the chain to this body alone. That program omits zeros.
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

/// Whether the placements of all bodies are faster than the chain to a link named at run time. The
/// cause is a program that omits zeros, or a small number of bodies.
template <Robot R>
[[nodiscard]] constexpr bool all_bodies_are_faster(const LinkFrame& link) noexcept {
  constexpr int b = std::remove_cvref_t<decltype(model_of(std::declval<R>()))>::body_count;
  if constexpr (DescribedRobot<R>) {
    return link.body >= 0 && program_is_cheaper<R>[link.body];
  }
  return link.body >= 0 && b <= 3;
}

}  // namespace articula::detail

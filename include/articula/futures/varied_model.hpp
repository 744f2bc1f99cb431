// SPDX-License-Identifier: Apache-2.0
/// @file A robot that differs from its description as a real one may.
#pragma once

#include "articula/futures/future_options.hpp"
#include "articula/model/canonical_mechanism.hpp"
#include "articula/model/robot.hpp"
#include "articula/sim/random_draw.hpp"

#include <cstdint>
#include <type_traits>

namespace articula {

namespace detail {

/// A body of the same shape with another density.
[[nodiscard]] constexpr Inertia<double> scaled(Inertia<double> inertia, double factor) noexcept {
  inertia.mass *= factor;
  inertia.first_moment = factor * inertia.first_moment;
  Symmetric3<double>& moment = inertia.moment;
  for (double* element : {&moment.xx, &moment.xy, &moment.xz, &moment.yy, &moment.yz, &moment.zz}) {
    *element *= factor;
  }
  return inertia;
}

}  // namespace detail

/// The model of a robot with other masses and friction. Each body's mass, first moment and inertia
/// have one common factor, so the body stays possible. Inertias of drives stay as they are.
/// @param robot   as described
/// @param spread  of mass and friction
/// @param key     the same key gives the same model
/// Real-time: no (set-up).
template <DynamicRobot R>
[[nodiscard]] auto varied_model(const R& robot, const FutureSpread& spread, std::uint64_t key) {
  auto model = model_of(robot);
  std::uint64_t number = 0;
  for (Body& body : model.mechanism.bodies) {
    body.inertia = detail::scaled(body.inertia, detail::random_factor(key, number++, spread.mass));
  }
  for (JointProperties& joint : model.joints) {
    joint.damping *= detail::random_factor(key, number++, spread.friction);
    joint.friction *= detail::random_factor(key, number++, spread.friction);
  }
  model.canonical = canonical_form(model.mechanism).mechanism;
  return model;
}

}  // namespace articula

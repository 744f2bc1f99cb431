// SPDX-License-Identifier: Apache-2.0
/// @file A joint as a linear plant: an inertia with damping, and its motion under a held effort.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/refuse.hpp"
#include "articula/model/robot.hpp"
#include "articula/tuning/equivalent_inertia.hpp"

#include <cmath>
#include <limits>

namespace articula {

/// One joint from effort to position, with the inertia I and viscous damping D:
/// I q'' + D q' = effort,
///
///     P(s) = (1/I) / (s (s + 1/T)),   T = I/D.
///
/// In the time T a coasting joint slows down to 37 % of its speed. Without damping T is infinite
/// and P(s) = 1/(I s^2).
struct JointPlant {
  static constexpr double undamped = std::numeric_limits<double>::infinity();

  double inertia = 1;               ///< I [kg m^2 or kg], > 0
  double time_constant = undamped;  ///< T [s], > 0

  /// 1/T [1/s], 0 without damping. Real-time: yes.
  [[nodiscard]] double decay_rate() const noexcept { return 1 / time_constant; }
};

/// Checks a plant.
/// @throws std::invalid_argument naming the member and its value
/// Real-time: no (throws).
inline void validate(const JointPlant& plant) {
  if (!is_finite(plant.inertia) || !(plant.inertia > 0)) {
    detail::refuse({"joint plant: inertia ", plant.inertia, " is not a finite number > 0"});
  }
  const double rate = plant.decay_rate();  // 0 for infinity, NaN for NaN
  if (!is_finite(rate) || rate < 0 || !(plant.time_constant > 0)) {
    detail::refuse({"joint plant: time_constant ", plant.time_constant,
                    " s is not a number > 0 (infinity: undamped)"});
  }
}

/// A plant with a given damping, T = I/D.
/// @param inertia  I [kg m^2 or kg], > 0
/// @param damping  D [N m s/rad or N s/m], >= 0
/// @throws std::invalid_argument naming the parameter and its value
/// Real-time: no (throws).
[[nodiscard]] inline JointPlant damped_plant(double inertia, double damping) {
  if (!is_finite(damping) || damping < 0) {
    detail::refuse({"joint plant: damping ", damping, " is not a finite number >= 0"});
  }
  JointPlant plant{.inertia = inertia};
  if (damping > 0) plant.time_constant = inertia / damping;
  validate(plant);
  return plant;
}

namespace detail {

/// The exact motion of a plant whose effort is held for a period h, with x = h/T:
///
///     q <- q + f1 h v + f2 h^2 effort/I     f1 = (1 - exp(-x))/x,   1   for x = 0
///     v <- decay v + f1 h effort/I          f2 = (1 - f1)/x,        1/2 for x = 0
///
/// Source: [Åström, Wittenmark 1997, section 2.3].
struct HeldEffort {
  double inertia, period;
  double decay;  ///< exp(-x)
  double f1 = 1, f2;

  HeldEffort(const JointPlant& plant, double held_period)
      : inertia(plant.inertia), period(held_period) {
    const double x = period * plant.decay_rate();
    decay = std::exp(-x);
    if (x > 0) f1 = -std::expm1(-x) / x;
    // Below 1e-3 the difference 1 - f1 cancels; the series leaves out less than 1e-15.
    f2 = x > 1e-3 ? (1 - f1) / x : (1 - x / 3 * (1 - x / 4 * (1 - x / 5))) / 2;
  }

  /// Moves a joint over one period.
  void advance(double& position, double& velocity, double effort) const {
    const double push = period * effort / inertia;
    position += period * (f1 * velocity + f2 * push);
    velocity = decay * velocity + f1 * push;
  }
};

}  // namespace detail

/// A joint of a robot as a plant: its equivalent inertia and the damping of its description. Dry
/// friction, gravity and stops are not part of a linear plant.
/// @param robot   a described robot or a model
/// @param q       joint positions [rad or m], N x 1
/// @param joint   index of the joint, 0 .. N - 1, or its name
/// @param others  whether the other joints are locked or free
/// @throws std::invalid_argument as equivalent_inertia, and if the joint moves no mass; the message
///         names the joint and the value
/// Real-time: no (set-up).
template <Robot R, class Joint>
[[nodiscard]] JointPlant joint_plant(const R& robot, const JointVector<joint_count<R>>& q,
                                     const Joint& joint, OtherJoints others = OtherJoints::locked) {
  const JointProperties& properties =
      model_of(robot).joints[detail::checked_joint(robot, q, joint)];
  const double inertia = equivalent_inertia(robot, q, joint, others);
  if (!is_finite(inertia) || !(inertia > 0)) {
    detail::refuse({"joint '", properties.name.view(), "': equivalent inertia ", inertia,
                    " is not a finite number > 0"});
  }
  return damped_plant(inertia, properties.damping);
}

}  // namespace articula

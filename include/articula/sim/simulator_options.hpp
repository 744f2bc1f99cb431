// SPDX-License-Identifier: Apache-2.0
/// @file How a simulated robot starts, steps and measures.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/dynamics/mass_matrix.hpp"
#include "articula/dynamics/tree_factors.hpp"
#include "articula/model/robot.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace articula {

/// How a simulated robot starts, steps and measures. What is not given has a neutral default.
/// @tparam N  number of joints
template <int N>
struct SimulatorOptions {
  double period = 1e-3;  ///< time from one command to the next [s]
  int substeps = 1;      ///< Runge-Kutta steps in each period

  /// q(0) [rad or m], N x 1; if not given: 0, or the nearest position within the limits
  std::optional<JointVector<N>> initial_position{};
  JointVector<N> initial_velocity = JointVector<N>::Zero();  ///< v(0) [rad/s or m/s], N x 1

  /// Encoder step per joint [rad or m], N x 1; 0: exact measurement. Where it is not 0, the
  /// measured position is a whole number of steps and the measured velocity is its change over the
  /// last period.
  JointVector<N> encoder_resolution = JointVector<N>::Zero();
  JointVector<N> position_noise = JointVector<N>::Zero();  ///< standard deviation [rad or m], N x 1
  JointVector<N> velocity_noise =
      JointVector<N>::Zero();  ///< standard deviation [rad/s or m/s], N x 1
  JointVector<N> effort_noise = JointVector<N>::Zero();  ///< standard deviation [N m or N], N x 1
  std::uint64_t seed = 1;  ///< of the noise; the same seed gives the same noise
};

/// The start position that the options ask for.
/// Real-time: no (set-up).
template <Robot R>
[[nodiscard]] JointVector<joint_count<R>> initial_position(
    const R& robot, const SimulatorOptions<joint_count<R>>& options) {
  if (options.initial_position) return *options.initial_position;
  return joint_values(robot, [](const JointProperties& joint) {
    return std::fmin(std::fmax(0.0, joint.limits.lower), joint.limits.upper);
  });
}

/// Refuses options that cannot be simulated: periods, steps, resolutions or deviations out of
/// range, a start outside the joint limits, a mass matrix that is singular at the start, damping
/// too strong for the step.
/// @throws std::invalid_argument naming the option or joint, the value and the limit
/// Real-time: no (throws).
template <Robot R>
void validate(const R& robot, const SimulatorOptions<joint_count<R>>& options) {
  constexpr int n = joint_count<R>;
  const auto refuse = [](const auto&... parts) {
    std::ostringstream message;
    message << "simulator: ";
    (message << ... << parts);
    throw std::invalid_argument(message.str());
  };
  if (!is_finite(options.period) || options.period <= 0) {
    refuse("period ", options.period, " s is not a positive number");
  }
  if (options.substeps < 1) refuse("substeps ", options.substeps, " is less than 1");

  const JointVector<n> q = initial_position(robot, options);
  for (int j = 0; j < n; ++j) {
    const JointProperties& joint = model_of(robot).joints[static_cast<std::size_t>(j)];
    const std::string_view name = joint.name.view();
    const auto check_not_negative = [&](std::string_view what, double value) {
      if (!is_finite(value) || value < 0) {
        refuse(what, " ", value, " of joint '", name, "' is not a number >= 0");
      }
    };
    check_not_negative("encoder_resolution", options.encoder_resolution[j]);
    check_not_negative("position_noise", options.position_noise[j]);
    check_not_negative("velocity_noise", options.velocity_noise[j]);
    check_not_negative("effort_noise", options.effort_noise[j]);
    if (!is_finite(options.initial_velocity[j])) {
      refuse("initial_velocity ", options.initial_velocity[j], " of joint '", name,
             "' is not finite");
    }
    if (!is_finite(q[j]) || q[j] < joint.limits.lower || q[j] > joint.limits.upper) {
      refuse("initial_position ", q[j], " of joint '", name, "' is outside its limits ",
             joint.limits.lower, " .. ", joint.limits.upper);
    }
  }

  // A pivot is the inertia that a joint feels when the joints that it carries are free to give way.
  const JointArray<int, n> parents = branches(model_of(robot).mechanism);
  const auto factors = factorise<double, n>(parents, detail::to_rows(mass_matrix(robot, q)));
  for (int j = 0; j < n; ++j) {
    const double pivot = 1 / factors.inverse_pivot[static_cast<std::size_t>(j)];
    const double whole = mass_matrix(robot, q)(j, j);
    if (!(pivot > 1e-12 * whole)) {  // what cancellation leaves of nothing is some 1e-16
      refuse("the mass matrix is singular at the initial position: joint '",
             model_of(robot).joints[static_cast<std::size_t>(j)].name.view(),
             "' moves no mass when the joints that it carries give way");
    }
  }

  // Damped joints decay with the eigenvalues of M^-1 D, the largest of which is found by power
  // iteration. The Runge-Kutta method is stable on the negative real axis up to 2.785 per step
  // [Hairer, Wanner 1996, section IV.2]; M changes with the position and the iteration may fall
  // short, so half of it is asked for.
  const JointVector<n> damping =
      joint_values(robot, [](const JointProperties& joint) { return joint.damping; });
  JointVector<n> mode = JointVector<n>::Ones();
  double rate = 0;
  for (int k = 0; k < 100; ++k) {
    const JointVector<n> next = detail::to_vector(
        solve<double, n>(parents, factors, detail::to_array<n>(damping.cwiseProduct(mode))));
    rate = next.norm() / mode.norm();
    if (!(rate > 0)) return;
    mode = next / next.norm();
  }
  const double most = 2.785 / 2 / rate;
  if (options.period / options.substeps > most) {
    refuse("joint damping decays with ", rate,
           " 1/s at the initial position, which needs steps of at most ", most,
           " s: ask for at least ",
           static_cast<long long>(std::ceil(std::min(options.period / most, 1e18))),
           " substeps instead of ", options.substeps);
  }
}

}  // namespace articula

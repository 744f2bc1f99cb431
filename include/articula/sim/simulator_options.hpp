// SPDX-License-Identifier: Apache-2.0
/// @file Options of a simulated robot: start, steps, drives and sensors.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/refuse.hpp"
#include "articula/dynamics/engine/tree_factors.hpp"
#include "articula/dynamics/mass_matrix.hpp"
#include "articula/model/robot.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

namespace articula {

/// The response of simulated drives to position and velocity commands.
enum class DriveModel : unsigned char {
  servo,  ///< They follow with `servo_bandwidth`, by efforts within their limits, see ServoDrives.
  ideal,  ///< The joints reach the command at the end of the period, without a limit of effort.
};

/// The start, steps, drives and sensors of a simulated robot. All members have defaults.
template <int N>
struct SimulatorOptions {
  double period = 1e-3;  ///< time from one command to the next [s]
  int substeps = 1;      ///< Runge-Kutta steps in each period

  /// q(0) [rad or m], N x 1; by default 0, or the nearest position within the limits
  std::optional<JointVector<N>> initial_position{};
  JointVector<N> initial_velocity = JointVector<N>::Zero();  ///< v(0) [rad/s or m/s], N x 1

  DriveModel drives = DriveModel::servo;  ///< under position and velocity commands
  /// w of the drives' own loops [rad/s], N x 1; it does not depend on the period. If it needs
  /// shorter steps than `substeps` gives, the simulator takes more of them.
  JointVector<N> servo_bandwidth = JointVector<N>::Constant(100);

  /// Encoder step per joint [rad or m], N x 1; 0 for exact measurement. Otherwise the measured
  /// position is a multiple of the step, and the measured velocity is its change over the last
  /// period.
  JointVector<N> encoder_resolution = JointVector<N>::Zero();
  JointVector<N> position_noise = JointVector<N>::Zero();  ///< standard deviation [rad or m], N x 1
  JointVector<N> velocity_noise =
      JointVector<N>::Zero();  ///< standard deviation [rad/s or m/s], N x 1
  JointVector<N> effort_noise = JointVector<N>::Zero();  ///< standard deviation [N m or N], N x 1
  std::uint64_t seed = 1;  ///< of the noise; the same seed gives the same noise
};

/// The number of Runge-Kutta steps in each period under position and velocity commands. In a step
/// of 0.2/w the relative error of the decay of the drive's loop is 0.2^5/120 = 3e-6. Real-time:
/// yes.
template <int N>
[[nodiscard]] double servo_substeps(const SimulatorOptions<N>& options) noexcept {
  const double needed = std::ceil(options.period * options.servo_bandwidth.maxCoeff() / 0.2);
  return std::fmax(options.substeps, needed);
}

/// The start position of the options.
/// Real-time: no (set-up).
template <Robot R>
[[nodiscard]] JointVector<joint_count<R>> initial_position(
    const R& robot, const SimulatorOptions<joint_count<R>>& options) {
  if (options.initial_position) return *options.initial_position;
  return joint_values(robot, [](const JointProperties& joint) {
    return std::fmin(std::fmax(0.0, joint.limits.lower), joint.limits.upper);
  });
}

/// The longest step of the simulation at a position, by the joints' damping: infinite without
/// damping, 0 if it decays too fast for a number. Damped joints decay with the eigenvalues of
/// M^-1 D. Power iteration computes the largest one. The Runge-Kutta method is stable on the
/// negative real axis up to 2.785 per step [Hairer, Wanner 1996, section IV.2]. Half of it is the
/// limit here: M changes with the position, and the iteration may underestimate.
/// @param q  joint positions [rad or m], N x 1
/// @return   [s]
/// Real-time: no (set-up).
template <Robot R>
[[nodiscard]] double longest_step(const R& robot, const JointVector<joint_count<R>>& q) {
  constexpr int n = joint_count<R>;
  const JointArray<int, n> parents = elimination_tree(model_of(robot).mechanism);
  const auto factors = factorise<double, n>(parents, detail::to_rows(mass_matrix(robot, q)));
  const JointVector<n> damping =
      joint_values(robot, [](const JointProperties& joint) { return joint.damping; });
  constexpr double infinity = std::numeric_limits<double>::infinity();
  JointArray<double, n> mode;  // a start without the symmetries of robots
  for (int j = 0; j < n; ++j) mode[j] = 1 / (1.0 + j);
  double rate = 0;
  for (int k = 0; k < 100; ++k) {
    for (int j = 0; j < n; ++j) mode[j] *= damping[j];
    mode = solve<double, n>(parents, factors, mode);
    const double last_rate = rate;
    rate = 0;  // the largest number: a sum of squares may overflow
    for (const double x : mode) rate = std::fmax(rate, is_finite(x) ? std::abs(x) : infinity);
    if (rate == 0) return infinity;
    if (!is_finite(rate)) return 0;
    for (double& x : mode) x /= rate;
    if (std::abs(rate - last_rate) <= 1e-9 * rate) break;
  }
  return 2.785 / 2 / rate;
}

namespace detail {

/// The largest step of an encoder that tells anything: the range of a joint, a revolution of one
/// without limits [rad or m].
[[nodiscard]] inline double range_of_encoder(const JointProperties& joint) {
  const double range = joint.limits.upper - joint.limits.lower;
  if (is_finite(range)) return range;
  return joint.type == JointType::prismatic ? range : 2 * std::numbers::pi;
}

}  // namespace detail

/// Refuses options that cannot be simulated:
/// - periods, steps, bandwidths, resolutions or deviations out of range
/// - drives of no kind, or a start outside the joint limits
/// - a mass matrix that is singular at the start, or damping too strong for the step
/// @throws std::invalid_argument naming the option or joint, the value and the limit
/// Real-time: no (throws).
template <Robot R>
void validate(const R& robot, const SimulatorOptions<joint_count<R>>& options) {
  constexpr int n = joint_count<R>;
  const auto refuse = [](detail::MessageParts parts) {
    detail::refuse({"simulator: ", detail::message_of(parts)});
  };
  if (!is_finite(options.period) || options.period <= 0) {
    refuse({"period ", options.period, " s is not a positive number"});
  }
  if (options.substeps < 1) refuse({"substeps ", options.substeps, " is less than 1"});
  if (options.drives != DriveModel::servo && options.drives != DriveModel::ideal) {
    refuse(
        {"drives ", static_cast<int>(options.drives), " is neither DriveModel::servo nor ideal"});
  }

  const JointVector<n> q = initial_position(robot, options);
  for (int j = 0; j < n; ++j) {
    const JointProperties& joint = model_of(robot).joints[j];
    const std::string_view name = joint.name.view();
    const auto check_not_negative = [&](std::string_view what, double value) {
      if (!is_finite(value) || value < 0) {
        refuse({what, " ", value, " of joint '", name, "' is not a number >= 0"});
      }
    };
    check_not_negative("encoder_resolution", options.encoder_resolution[j]);
    constexpr double smallest_step = 1e-100;  // positions must be few enough steps for a number
    if (options.encoder_resolution[j] != 0 && options.encoder_resolution[j] < smallest_step) {
      refuse({"encoder_resolution ", options.encoder_resolution[j], " of joint '", name,
              "' is neither 0 nor at least ", smallest_step});
    }
    const double range = detail::range_of_encoder(joint);
    if (options.encoder_resolution[j] > range) {
      refuse({"encoder_resolution ", options.encoder_resolution[j], " of joint '", name,
              "' is more than its range, ", range, "; it is a step, not a number of lines"});
    }
    check_not_negative("position_noise", options.position_noise[j]);
    check_not_negative("velocity_noise", options.velocity_noise[j]);
    check_not_negative("effort_noise", options.effort_noise[j]);
    constexpr double most_steps = 1e6;
    const double most_bandwidth = 0.2 * most_steps / options.period;
    const double bandwidth = options.servo_bandwidth[j];
    if (!is_finite(bandwidth) || bandwidth <= 0 || bandwidth > most_bandwidth) {
      refuse({"servo_bandwidth ", bandwidth, " rad/s of joint '", name,
              "' is not a number > 0 and at most ", most_bandwidth,
              ", where a period takes a million steps"});
    }
    if (!is_finite(options.initial_velocity[j])) {
      refuse({"initial_velocity ", options.initial_velocity[j], " of joint '", name,
              "' is not finite"});
    }
    if (!is_finite(q[j]) || q[j] < joint.limits.lower || q[j] > joint.limits.upper) {
      refuse({"initial_position ", q[j], " of joint '", name, "' is outside its limits ",
              joint.limits.lower, " .. ", joint.limits.upper});
    }
  }

  // A pivot is the inertia of a joint when the joints that it carries are free.
  const JointArray<int, n> parents = elimination_tree(model_of(robot).mechanism);
  const auto factors = factorise<double, n>(parents, detail::to_rows(mass_matrix(robot, q)));
  for (int j = 0; j < n; ++j) {
    const double pivot = 1 / factors.inverse_pivot[j];
    const double whole = mass_matrix(robot, q)(j, j);
    if (!(pivot > 1e-12 * whole)) {  // cancellation leaves some 1e-16 of zero
      refuse({"the mass matrix is singular at the initial position: joint '",
              model_of(robot).joints[j].name.view(),
              "' moves no mass when the joints that it carries give way"});
    }
  }

  const double most = longest_step(robot, q);
  if (most == 0) refuse({"joint damping decays too fast for a number"});
  if (options.period / options.substeps > most) {
    std::string advice;
    const double needed = std::ceil(options.period / most);
    if (needed < std::numeric_limits<int>::max()) {
      advice = detail::message_of({": ask for at least ", static_cast<int>(needed),
                                   " substeps instead of ", options.substeps});
    }
    refuse({"joint damping decays with ", 2.785 / 2 / most,
            " 1/s at the initial position, which needs steps of at most ", most, " s", advice});
  }
}

namespace detail {

/// More substeps where a robot that differs from its description needs them: light bodies and
/// strong damping do. `validate` refuses robots that need more than a hundred times as many.
/// @param options  with an initial position
/// Real-time: no (set-up).
template <Robot R>
void shorten_steps(const R& robot, SimulatorOptions<joint_count<R>>& options) {
  const double needed = std::ceil(options.period / longest_step(robot, *options.initial_position));
  if (needed <= 100.0 * options.substeps) {
    options.substeps = std::max(options.substeps, static_cast<int>(needed));
  }
}

}  // namespace detail

}  // namespace articula

// SPDX-License-Identifier: Apache-2.0
/// @file What the user should know about a controller's gains before the robot moves.
#pragma once

#include "articula/control/equivalent_inertia.hpp"
#include "articula/control/pid_gains.hpp"
#include "articula/control/pid_law.hpp"
#include "articula/core/joint_command.hpp"
#include "articula/core/refuse.hpp"
#include "articula/model/robot.hpp"

#include <cmath>
#include <concepts>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace articula {

/// The gain from velocity to effort from which on a joint chatters. With its inertia I, its damping
/// D and an effort -d v that is held for the period dt, its velocity is, from cycle to cycle,
///
///     v_k+1 = (E - d (1 - E)/D) v_k,   E = exp(-D dt/I).
///
/// It grows, with another sign in every cycle, from d = D/tanh(D dt/(2 I)) on; without damping that
/// is 2 I/dt.
/// @param inertia  I > 0 [kg m^2 or kg]
/// @param damping  D >= 0 [N m s/rad or N s/m]
/// @param period   dt > 0 [s]
/// @return         d [N m s/rad or N s/m]
/// Real-time: yes.
[[nodiscard]] inline double chattering_gain(double inertia, double damping,
                                            double period) noexcept {
  const double half = damping * period / (2 * inertia);
  return half > 1e-9 ? damping / std::tanh(half) : 2 * inertia / period;  // equal to 1e-18 there
}

namespace detail {

/// Adds a line for each joint whose gain from velocity to effort makes it chatter.
template <Robot R, PidOf Variable>
void add_chatter_notices(const R& robot, const PidLaw<joint_count<R>, Variable>& law,
                         const JointVector<joint_count<R>>& q, double period,
                         std::vector<std::string>& notices) {
  for (int j = 0; j < joint_count<R>; ++j) {
    const auto i = static_cast<std::size_t>(j);
    const PidGains& g = law.gains()[i];
    const double time = g.derivative_filter_time;
    const bool of_position = Variable == PidOf::position;
    const double gain = of_position ? g.derivative * period / (time + period) : g.proportional;
    const JointProperties& joint = model_of(robot).joints[i];
    double inertia = 0;
    try {
      inertia = equivalent_inertia(robot, q, j, OtherJoints::free);
    } catch (const std::invalid_argument&) {
      return;  // a robot without masses
    }
    const double most = chattering_gain(inertia, joint.damping, period);
    if (!(gain >= most)) continue;
    notices.push_back(
        message_of({"joint '", joint.name.view(), "' will chatter: its ",
                    of_position ? "derivative" : "proportional", " gain is ", gain, ", and from ",
                    most, " on the joint's inertia of ", inertia, " is too little for a period of ",
                    period, " s. Lower the gain", of_position ? ", filter the derivative" : "",
                    " or shorten the period."}));
  }
}

/// Looks at a part of a controller, and at the parts that it is made of.
template <Robot R, class Part>
void add_gain_notices(const R& robot, const Part& part, const JointVector<joint_count<R>>& q,
                      double period, std::vector<std::string>& notices) {
  if constexpr (requires { add_chatter_notices(robot, part, q, period, notices); }) {
    add_chatter_notices(robot, part, q, period, notices);
  } else if constexpr (requires { part.for_each_part([](const auto&) {}); }) {
    part.for_each_part([&](const auto& own) { add_gain_notices(robot, own, q, period, notices); });
  }
}

}  // namespace detail

/// What the user should know about a controller's gains, a line each. So far that is which joints
/// will chatter: at least those whose chattering_gain is exceeded with the inertia that they have
/// while the other joints give way. Looked at are the PIDs of efforts, also within Limited and
/// Switch; a PID of drives that close their own loop cannot be judged by inertias.
/// @param robot       whose joints these are
/// @param controller  with its gains
/// @param q           positions at which inertias are taken [rad or m], N x 1
/// @param period      dt > 0 of the controller [s]
/// Real-time: no (allocates).
template <Robot R, class C>
[[nodiscard]] std::vector<std::string> gain_notices(const R& robot, const C& controller,
                                                    const JointVector<joint_count<R>>& q,
                                                    double period) {
  std::vector<std::string> notices;
  if constexpr (
      !requires { typename C::Command; } ||
      requires(typename C::Command command) { command.effort; }) {
    detail::add_gain_notices(robot, controller, q, period, notices);
  }
  return notices;
}

}  // namespace articula

// SPDX-License-Identifier: Apache-2.0
/// @file What the user should know about a controller's gains before the robot moves.
#pragma once

#include "articula/control/laws/part_scope.hpp"
#include "articula/control/laws/sampled_feedback.hpp"
#include "articula/core/refuse.hpp"
#include "articula/model/robot.hpp"
#include "articula/tuning/joint_plant.hpp"
#include "articula/tuning/sampled_loop.hpp"

#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace articula {

namespace detail {

/// Whether a joint under a law never comes to rest. Where nothing holds the position the spectral
/// radius is 1, and rounding gives it an error of up to 1e-8: the root of that of a number, where
/// two eigenvalues meet. What grows by less than 1e-6 in a cycle is left to friction.
[[nodiscard]] inline bool shakes(const JointPlant& plant, const SampledFeedback& feedback,
                                 double period) {
  return spectral_radius(plant, feedback, period) > 1 + 1e-6;
}

/// A list in words: "a", "a and b", "a, b and c", with " and " before the last.
[[nodiscard]] inline std::string in_words(const std::vector<std::string>& items,
                                          std::string_view last) {
  std::string text;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i > 0) text += i + 1 == items.size() ? last : std::string_view(", ");
    text += items[i];
  }
  return text;
}

/// "lower p and d, for example to 60 and 0.6": halved as often as it takes until the joint does not
/// shake, up to ten times. Nothing if that does not help.
/// @param gains  which of them are lowered together
[[nodiscard]] inline std::string lower_gains(
    const JointPlant& plant, SampledFeedback feedback, double period,
    std::initializer_list<double SampledFeedback::*> gains) {
  for (int k = 0; k < 10; ++k) {
    for (double SampledFeedback::* gain : gains) feedback.*gain /= 2;
    if (shakes(plant, feedback, period)) continue;
    std::vector<std::string> names, values;
    for (double SampledFeedback::* gain : gains) {
      if (feedback.*gain == 0) continue;
      names.emplace_back(feedback.name_of(gain));
      values.push_back(message_of({feedback.*gain}));
    }
    return message_of(
        {"lower ", in_words(names, " and "), ", for example to ", in_words(values, " and ")});
  }
  return {};
}

/// "raise d, for example to 0.8", to what calms the joint soonest of fractions of 2 I/dt, from which
/// on a derivative alone makes it shake. Nothing if that does not help.
[[nodiscard]] inline std::string raise_derivative(const JointPlant& plant,
                                                  const SampledFeedback& feedback, double period) {
  if (feedback.of_velocity) return {};
  double best = 0, smallest = 1;
  for (double fraction = 0.75; fraction > 1e-3; fraction /= 1.5) {
    const double derivative = fraction * 2 * plant.inertia / period;
    SampledFeedback raised = feedback;
    raised.derivative = derivative;
    const double radius = spectral_radius(plant, raised, period);
    if (derivative <= feedback.derivative || radius >= smallest) continue;
    best = derivative;
    smallest = radius;
  }
  if (best == 0) return {};
  return message_of({"raise ", feedback.derivative_name, ", for example to ", best});
}

/// What calms a joint that shakes: each of these is tried out with the same law.
[[nodiscard]] inline std::string calming(const JointPlant& plant, const SampledFeedback& feedback,
                                         double period, bool asks_acceleration) {
  using F = SampledFeedback;
  if (feedback.proportional < 0 || feedback.integral < 0 || feedback.derivative < 0) {
    return "choose gains that are not negative";
  }
  std::vector<std::string> ways;
  std::string lower =
      lower_gains(plant, feedback, period, {&F::proportional, &F::integral, &F::derivative});
  if (lower.empty()) lower = lower_gains(plant, feedback, period, {&F::integral});
  if (lower.empty()) lower = lower_gains(plant, feedback, period, {&F::proportional});
  if (!lower.empty()) ways.push_back(lower);
  if (const std::string raise = raise_derivative(plant, feedback, period); !raise.empty()) {
    ways.push_back(raise);
  }
  if (F unfiltered = feedback; feedback.filter_time > 0) {
    unfiltered.filter_time = 0;
    if (!shakes(plant, unfiltered, period)) ways.emplace_back("shorten the derivative's filter");
  }
  if (!shakes(plant, feedback, period / 16)) ways.emplace_back("shorten the period");
  if (JointPlant heavier = plant; !asks_acceleration) {
    heavier.inertia *= 1000;  // drives' rotors are seen through the square of their gear ratio
    heavier.time_constant *= 1000;
    if (!shakes(heavier, feedback, period)) {
      ways.emplace_back("add the drive's reflected_inertia, if the model has none");
    }
  }
  if (ways.empty()) ways.emplace_back("design the gains anew with design_pd");
  return in_words(ways, ", or ");
}

/// The line for a joint that shakes.
[[nodiscard]] inline std::string gain_notice(const JointProperties& joint, const JointPlant& plant,
                                             const SampledFeedback& feedback, double period,
                                             bool asks_acceleration) {
  const double growth = std::log(spectral_radius(plant, feedback, period));
  std::string gains = message_of({feedback.proportional_name, " ", feedback.proportional, ", ",
                                  feedback.derivative_name, " ", feedback.derivative});
  if (feedback.integral != 0) {
    gains += message_of({", i ", feedback.integral});
  }
  if (feedback.filter_time > 0) {
    gains += message_of({", derivative filter ", feedback.filter_time, " s"});
  }
  const std::string inertia =
      asks_acceleration ? std::string("an output that is an acceleration")
                        : message_of({"an inertia of ", plant.inertia,
                                      joint.type == JointType::prismatic ? " kg" : " kg m^2"});
  return message_of({"joint '", joint.name.view(), "': the gains ", gains, " make it shake. With ",
                     inertia, " and a period of ", period,
                     " s, its motion grows to twice its size within ",
                     period * std::log(2.0) / growth, " s. To calm it, ",
                     calming(plant, feedback, period, asks_acceleration), "."});
}

/// Looks at a part of a controller, and at the parts that it is made of.
template <Robot R, class Part>
void add_gain_notices(const R& robot, const Part& part, const PartScope<joint_count<R>>& scope,
                      const JointVector<joint_count<R>>& q, double period,
                      std::vector<std::string>& notices) {
  if constexpr (requires { part.sampled_feedback(std::size_t{}); }) {
    const double own_period = scope.divisor * period;
    for (int j = 0; j < joint_count<R>; ++j) {
      if (scope.joints[j] == 0) continue;
      const auto i = static_cast<std::size_t>(j);
      const SampledFeedback feedback = part.sampled_feedback(i);
      JointPlant plant;
      if (!scope.asks_acceleration) {
        try {
          plant = joint_plant(robot, q, j, OtherJoints::free);
        } catch (const std::invalid_argument&) {
          return;  // a robot without masses
        }
      }
      if (shakes(plant, feedback, own_period)) {
        notices.push_back(gain_notice(model_of(robot).joints[i], plant, feedback, own_period,
                                      scope.asks_acceleration));
      }
    }
  } else if constexpr (requires { part.for_each_part([](const auto&...) {}); }) {
    part.for_each_part([&](const auto& own, const PartScope<joint_count<R>>& inner = {}) {
      add_gain_notices(robot, own, scope.of(inner), q, period, notices);
    });
  }
}

}  // namespace detail

/// What the user should know about a controller's gains, a line each: which joints they make shake,
/// and what helps. A joint shakes if the spectral_radius of the joint under its law is above 1. It
/// is looked at alone, with the inertia that it has while the other joints give way, and with
/// viscous damping.
///
/// Looked at are the laws of efforts that have a `sampled_feedback`: PidLaw, ControlToolboxPidLaw
/// and ImpedanceLaw, each by itself, also within OnJoints, Groups, Limited, Switch and the
/// ComputedTorqueLaw. Left out are dry friction, limits, delays of the hardware, sensors, how
/// joints and laws act on each other, and drives that close their own loop. So no line is no
/// promise.
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
    detail::add_gain_notices(robot, controller, {}, q, period, notices);
  }
  return notices;
}

}  // namespace articula

// SPDX-License-Identifier: Apache-2.0
/// @file Notices about gains that make a joint unstable or are missing, before the robot moves.
#pragma once

#include "articula/control/composition/parts.hpp"
#include "articula/control/laws/sampled_feedback.hpp"
#include "articula/core/controller.hpp"
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

/// A joint under a law that is computed once per period.
struct SampledJoint {
  JointPlant plant;
  SampledFeedback law;
  double period;         ///< dt [s]
  bool is_unit_inertia;  ///< the law's output is an acceleration, so the plant is an inertia of 1

  /// Whether the joint never comes to rest. Where nothing holds the position, the spectral radius
  /// is 1. Where two eigenvalues meet, its rounding error is up to 1e-8, the root of that of a
  /// number. Growth by less than 1e-6 per period is within the reach of friction.
  [[nodiscard]] bool unstable() const { return spectral_radius(plant, law, period) > 1 + 1e-6; }
};

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

/// "lower p and d, for example to 60 and 0.6": halves gains until the joint is stable, up to ten
/// times. Empty if that does not help.
/// @param gains  which are lowered together
[[nodiscard]] inline std::string lower_gains(
    SampledJoint joint, std::initializer_list<double SampledFeedback::*> gains) {
  for (int k = 0; k < 10; ++k) {
    for (double SampledFeedback::* gain : gains) joint.law.*gain /= 2;
    if (joint.unstable()) continue;
    std::vector<std::string> names, values;
    for (double SampledFeedback::* gain : gains) {
      if (joint.law.*gain == 0) continue;
      names.emplace_back(joint.law.name_of(gain));
      values.push_back(message_of({joint.law.*gain}));
    }
    return message_of(
        {"lower ", in_words(names, " and "), ", for example to ", in_words(values, " and ")});
  }
  return {};
}

/// "raise d, for example to 0.8": tries fractions of 2 I/dt, above which a derivative alone is
/// unstable, and takes the one with the smallest spectral radius. Empty if none helps.
[[nodiscard]] inline std::string raise_derivative(SampledJoint joint) {
  if (joint.law.of_velocity) return {};
  const double present = joint.law.derivative;
  double best = 0, smallest = 1;
  for (double fraction = 0.75; fraction > 1e-3; fraction /= 1.5) {
    joint.law.derivative = fraction * 2 * joint.plant.inertia / joint.period;
    const double radius = spectral_radius(joint.plant, joint.law, joint.period);
    if (joint.law.derivative <= present || radius >= smallest) continue;
    best = joint.law.derivative;
    smallest = radius;
  }
  if (best == 0) return {};
  return message_of({"raise ", joint.law.derivative_name, ", for example to ", best});
}

/// Changes that make an unstable joint stable. Each is tried with the same law.
[[nodiscard]] inline std::string remedies(const SampledJoint& joint) {
  using F = SampledFeedback;
  if (joint.law.proportional < 0 || joint.law.integral < 0 || joint.law.derivative < 0) {
    return "choose gains that are not negative";
  }
  std::vector<std::string> ways;
  std::string lower = lower_gains(joint, {&F::proportional, &F::integral, &F::derivative});
  if (lower.empty()) lower = lower_gains(joint, {&F::integral});
  if (lower.empty()) lower = lower_gains(joint, {&F::proportional});
  for (const std::string& way : {lower, raise_derivative(joint)}) {
    if (!way.empty()) ways.push_back(way);
  }
  const auto add_if_stable = [&](const SampledJoint& changed, const char* way) {
    if (!changed.unstable()) ways.emplace_back(way);
  };
  SampledJoint changed = joint;
  changed.law.filter_time = 0;
  add_if_stable(changed, "shorten the derivative's filter");
  changed = joint;
  changed.period /= 16;
  add_if_stable(changed, "shorten the period");
  changed = joint;
  if (!joint.is_unit_inertia) {
    changed.plant.inertia *= 1000;  // of rotors, which count with the square of the gear ratio
    changed.plant.time_constant *= 1000;
  }
  add_if_stable(changed, "add the drive's reflected_inertia, if the model has none");
  if (ways.empty()) ways.emplace_back("design new gains with design_pd");
  return in_words(ways, ", or ");
}

/// The notice of an unstable joint.
[[nodiscard]] inline std::string gain_notice(const JointProperties& properties,
                                             const SampledJoint& joint) {
  const auto& [plant, law, period, is_unit_inertia] = joint;
  std::string gains = message_of({law.proportional_name, " ", law.proportional, ", ",
                                  law.derivative_name, " ", law.derivative});
  if (law.integral != 0) gains += message_of({", i ", law.integral});
  if (law.filter_time > 0) {
    gains += message_of({", derivative filter ", law.filter_time, " s"});
  }
  const char* const unit = properties.type == JointType::prismatic ? " kg" : " kg m^2";
  const std::string inertia = is_unit_inertia ? std::string("an output that is an acceleration")
                                              : message_of({"an inertia of ", plant.inertia, unit});
  const double growth = std::log(spectral_radius(plant, law, period));
  return message_of({"joint '", properties.name.view(), "' is unstable with the gains ", gains,
                     ". With ", inertia, " and a period of ", period,
                     " s, its motion doubles within ", period * std::log(2.0) / growth,
                     " s. Remedy: ", remedies(joint), "."});
}

/// Whether a joint has gains that are not 0.
template <class Part>
[[nodiscard]] bool has_gains(const Part& part, int joint) {
  const SampledFeedback law = part.sampled_feedback(static_cast<std::size_t>(joint));
  return law.proportional != 0 || law.integral != 0 || law.derivative != 0;
}

/// Adds the joints without gains beside joints with gains: a list may have been too short.
template <Robot R, class Part>
void add_missing_gains(const R& robot, const Part& part, const PartScope<joint_count<R>>& scope,
                       std::vector<std::string>& notices) {
  std::vector<std::string> without;
  bool some = false;
  for (int j = 0; j < joint_count<R>; ++j) {
    if (scope.joints[j] == 0) continue;
    if (has_gains(part, j)) {
      some = true;
    } else {
      without.push_back(message_of({"'", model_of(robot).joints[j].name.view(), "'"}));
    }
  }
  if (!some || without.empty()) return;
  notices.push_back("the gains of joint " + in_words(without, " and ") +
                    " are 0. Remedy: give gains for each joint.");
}

/// Adds the notices of a part of a controller, and of the parts that it consists of.
template <Robot R, class Part>
void add_gain_notices(const R& robot, const Part& part, const PartScope<joint_count<R>>& scope,
                      const JointVector<joint_count<R>>& q, double period,
                      std::vector<std::string>& notices) {
  if constexpr (requires { part.sampled_feedback(std::size_t{}); }) {
    add_missing_gains(robot, part, scope, notices);
    for (int j = 0; j < joint_count<R>; ++j) {
      if (scope.joints[j] == 0) continue;
      SampledJoint joint{.plant = {},
                         .law = part.sampled_feedback(static_cast<std::size_t>(j)),
                         .period = scope.divisor * period,
                         .is_unit_inertia = scope.asks_acceleration};
      if (!scope.asks_acceleration) {
        try {
          joint.plant = joint_plant(robot, q, j, OtherJoints::free);
        } catch (const std::invalid_argument&) {
          return;  // a robot without masses
        }
      }
      if (joint.unstable()) notices.push_back(gain_notice(model_of(robot).joints[j], joint));
    }
  } else if constexpr (HasParts<Part>) {
    for_each_part(part, [&](const auto& own, std::size_t index) {
      const auto inner = scope.of(scope_of_part<joint_count<R>>(part, index));
      add_gain_notices(robot, own, inner, q, period, notices);
    });
  }
}

}  // namespace detail

/// Notices about a controller's gains, a line each: which joints they make unstable, which joints
/// have none beside others that have, and remedies.
/// A joint is unstable if its spectral_radius under its law is above 1. Each joint is checked
/// alone, with viscous damping, and with its inertia while the other joints are free.
///
/// The check covers laws of efforts with a function `sampled_feedback`: PidLaw,
/// ControlToolboxPidLaw and ImpedanceLaw, each alone, also within OnJoints, Groups, Limited, Switch
/// and ComputedTorqueLaw. It does not cover dry friction, limits, delays of hardware and sensors,
/// the coupling of joints and laws, and drives that close their own loop. So gains without a notice
/// can be unstable.
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
  constexpr bool is_law = !requires { typename CommandOf<C, joint_count<R>>; };
  if constexpr (is_law || requires(CommandOf<C, joint_count<R>> command) { command.effort; }) {
    detail::add_gain_notices(robot, controller, {}, q, period, notices);
  }
  return notices;
}

}  // namespace articula

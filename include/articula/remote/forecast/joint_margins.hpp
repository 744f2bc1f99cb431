// SPDX-License-Identifier: Apache-2.0
/// @file The stability margins of all laws of a controller, joint by joint.
#pragma once

#include "articula/control/composition/parts.hpp"
#include "articula/control/laws/sampled_feedback.hpp"
#include "articula/control/switching/switch_board.hpp"
#include "articula/model/robot.hpp"
#include "articula/tuning/stability_margins.hpp"

#include <cstddef>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace articula::remote {

/// The margins of one joint under one law that is active, with the gains of a question. The joint
/// is an inertia with damping, at the present position and with the other joints free; see
/// stability_margins.
struct JointMargins {
  std::string controller{};  ///< as parameters name it
  std::string joint{};
  bool stable = false;
  double gain_margin = 1;   ///< factor on all gains [1]
  double phase_margin = 0;  ///< [rad]
  double delay_margin = 0;  ///< [s]
};

namespace detail {

/// Finds the laws in a controller.
template <DynamicRobot R>
class MarginCollector {
 public:
  static constexpr int joint_count = articula::joint_count<R>;

  MarginCollector(const R& robot, const JointVector<joint_count>& q, double period)
      : robot_(robot), q_(q), period_(period) {}

  /// Adds the margins of a part of a controller, and of the parts that it consists of.
  template <class Part>
  void add(const Part& part, const PartScope<joint_count>& scope, const std::string& controller) {
    if constexpr (requires { part.sampled_feedback(std::size_t{}); }) {
      for (int j = 0; j < joint_count; ++j) {
        const SampledFeedback law = part.sampled_feedback(static_cast<std::size_t>(j));
        if (scope.joints[j] == 0 || law.of_velocity) continue;
        add_joint(j, law, scope, controller);
      }
    } else if constexpr (HasParts<Part>) {
      articula::detail::for_each_part(part, [&](const auto& own, std::size_t index) {
        using Own = std::remove_cvref_t<decltype(own)>;
        const PartScope<joint_count> inner =
            scope.of(articula::detail::scope_of_part<joint_count>(part, index));
        std::string name = controller;
        if constexpr (requires { part.name_of(index); }) {
          if (part.list()[index].status != ControllerStatus::active) return;
          name = part.name_of(index).view();
        } else if constexpr (requires { Part::group_count; }) {
          name = articula::detail::own_name<Own>(index).view();
        }
        this->add(own, inner, name);
      });
    }
  }

  [[nodiscard]] std::vector<JointMargins> take() { return std::move(margins_); }

 private:
  void add_joint(int j, const SampledFeedback& law, const PartScope<joint_count>& scope,
                 const std::string& controller) try {
    const JointPlant plant =
        scope.asks_acceleration ? JointPlant{} : joint_plant(robot_, q_, j, OtherJoints::free);
    const StabilityMargins own = stability_margins(plant,
                                                   {.proportional = law.proportional,
                                                    .integral = law.integral,
                                                    .derivative = law.derivative,
                                                    .derivative_filter_time = law.filter_time},
                                                   scope.divisor * period_ / 2);
    const auto& name = model_of(robot_).joints[static_cast<std::size_t>(j)].name;
    margins_.push_back({controller, std::string(name.view()), own.stable, own.gain_margin,
                        own.phase_margin, own.delay_margin});
  } catch (const std::invalid_argument&) {  // NOLINT(bugprone-empty-catch)
    // Gains that are all 0 make no loop.
  }

  const R& robot_;
  const JointVector<joint_count>& q_;
  double period_;
  std::vector<JointMargins> margins_{};
};

}  // namespace detail

/// The margins of all joints whose law and drive have some.
/// @param robot       with masses
/// @param controller  of efforts; of a Switch those that are active
/// @param q           position of the joints [rad or m]
/// @param period      of the loop [s]
/// Real-time: no (allocates).
template <DynamicRobot R, class C>
[[nodiscard]] std::vector<JointMargins> margins_of(const R& robot, const C& controller,
                                                   const JointVector<joint_count<R>>& q,
                                                   double period) {
  detail::MarginCollector<R> collector(robot, q, period);
  collector.add(controller, {}, std::string(articula::detail::own_name<C>(0).view()));
  return collector.take();
}

}  // namespace articula::remote

// SPDX-License-Identifier: Apache-2.0
/// @file A robot, gains and simulation that differ from the nominal ones by given numbers.
#pragma once

#include "articula/control/laws/pid_gains.hpp"
#include "articula/dynamics/varied_robot.hpp"
#include "articula/futures/varied_model.hpp"
#include "articula/model/canonical_mechanism.hpp"
#include "articula/model/robot.hpp"
#include "articula/sim/lost_commands.hpp"
#include "articula/sim/simulator_options.hpp"
#include "articula/sweep/variation/placed_variation.hpp"
#include "articula/sweep/variation/variation.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>

namespace articula {

namespace detail {

/// The type of robots that differ from R in numbers; of a robot loaded at run time, its model.
template <Robot R>
struct RobotOfKind {
  using Type = R;
};
template <DescribedRobot R>
struct RobotOfKind<R> {
  using Type = VariedRobot<R>;
};

}  // namespace detail

/// Everything about one run that varies: it replays the run in a loop of one's own.
/// @tparam R  the robot as described
template <DynamicRobot R>
struct VariedLoop {
  static constexpr int joint_count = articula::joint_count<R>;
  using Model = std::remove_cvref_t<decltype(model_of(std::declval<const R&>()))>;

  Model model{};  ///< the robot of this run
  /// The same robot, which the run simulates. None if a variation gives numbers that VariedRobot<R>
  /// does not take, such as a payload beside an axis: the run then simulates the model. Of a robot
  /// loaded at run time it is none.
  std::optional<typename detail::RobotOfKind<R>::Type> robot{};
  JointPidGains<joint_count> gains{};          ///< of its controller
  SimulatorOptions<joint_count> simulation{};  ///< with noise and the seed of this run
  int delay = 0;                               ///< of the commands [periods]
  LostCommands lost{};                         ///< commands that do not arrive
};

namespace detail {

/// Applies one variation.
template <class Loop>
void vary(Loop& loop, const PlacedVariation& placed, double value) {
  using enum VariedQuantity;
  auto& bodies = loop.model.mechanism.bodies;
  auto& simulation = loop.simulation;
  switch (placed.variation.quantity) {
    case mass:
      for (const int b : placed.places) bodies[b].inertia = scaled(bodies[b].inertia, value);
      return;
    case payload:
      for (const int b : placed.places) {
        const Vector3<double> moment = value * placed.point;
        bodies[b].inertia =
            bodies[b].inertia +
            Inertia<double>{value, moment, parallel_axis(0.5 * moment, placed.point)};
      }
      return;
    case delay:
      loop.delay = static_cast<int>(std::lround(value / simulation.period));
      return;
    case lost_commands:
      loop.lost.share = value;
      return;
    default:
      break;
  }
  for (const int j : placed.places) {
    const auto place = static_cast<std::size_t>(j);
    switch (placed.variation.quantity) {
      case damping:
        loop.model.joints[j].damping *= value;
        break;
      case friction:
        loop.model.joints[j].friction *= value;
        break;
      case added_friction:
        loop.model.joints[j].friction += value;
        break;
      case added_reflected_inertia:
        for (int b = 0; b < static_cast<int>(bodies.size()); ++b) {
          const bool is_own = loop.model.moving_joints[b] == loop.model.joints[j].name;
          if (is_own) bodies[b].reflected_inertia += value;
        }
        break;
      case effort_limit:
        loop.model.joints[j].limits.effort *= value;
        break;
      case position_noise:
        simulation.position_noise[j] = value;
        break;
      case velocity_noise:
        simulation.velocity_noise[j] = value;
        break;
      case encoder_resolution:
        simulation.encoder_resolution[j] = value;
        break;
      case initial_position:
        (*simulation.initial_position)[j] += value;
        break;
      case proportional:
        loop.gains[place].proportional *= value;
        break;
      case integral:
        loop.gains[place].integral *= value;
        break;
      case derivative:
        loop.gains[place].derivative *= value;
        break;
      default:
        break;
    }
  }
}

/// The nominal loop with all variations. Factors scale the described numbers, whatever the order of
/// the variations.
/// @param values  one for each variation
/// Real-time: no (allocates).
template <DynamicRobot R>
[[nodiscard]] VariedLoop<R> varied_loop(const VariedLoop<R>& nominal,
                                        std::span<const PlacedVariation> variations,
                                        std::span<const double> values, std::uint64_t seed) {
  VariedLoop<R> loop = nominal;
  loop.simulation.seed = loop.lost.seed = seed;
  for (const bool scales : {true, false}) {
    for (std::size_t k = 0; k < variations.size(); ++k) {
      const VariedEffect effect = traits_of(variations[k].variation.quantity).effect;
      if ((effect == VariedEffect::scales) == scales) vary(loop, variations[k], values[k]);
    }
  }
  bool changes_bodies = false;
  for (const PlacedVariation& each : variations) {
    const VariedQuantity quantity = each.variation.quantity;
    changes_bodies = changes_bodies || traits_of(quantity).subject == VariedSubject::link ||
                     quantity == VariedQuantity::added_reflected_inertia;
  }
  if constexpr (DescribedRobot<R>) {
    loop.robot = robot_of_kind<R>(loop.model);
    if (loop.robot && changes_bodies) loop.model.canonical = loop.robot->canonical;
  }
  if (!loop.robot && changes_bodies) {
    loop.model.canonical = canonical_form(loop.model.mechanism).mechanism;
  }
  shorten_steps(loop.model, loop.simulation);
  return loop;
}

}  // namespace detail

}  // namespace articula

// SPDX-License-Identifier: Apache-2.0
/// @file The check of requests before a loop gets them.
#pragma once

#include "articula/control/switching/switch_board.hpp"
#include "articula/remote/engine/loop_traits.hpp"
#include "articula/remote/engine/task.hpp"
#include "articula/remote/motion_task_maker.hpp"
#include "articula/remote/remote_options.hpp"
#include "articula/remote/request.hpp"
#include "articula/remote/request_check.hpp"
#include "articula/sim/simulator_options.hpp"

#include <cmath>
#include <variant>
#include <vector>

namespace articula::remote {

/// Makes tasks of requests. Refuses unknown names, numbers that are not finite or beyond the
/// robot's limits, and requests that this loop does not understand. So nothing unchecked reaches
/// the loop. For the outside. All functions throw std::invalid_argument, naming joint, value and
/// limit.
/// @tparam LoopType  a ControlLoop or SupervisedControlLoop
template <class LoopType>
class TaskMaker {
 public:
  using R = typename LoopType::RobotType;
  static constexpr int joint_count = LoopType::joint_count;
  using Wish = typename Task<R>::Wish;
  using Reference = JointReference<joint_count>;

  /// @param robot          stays where it is
  /// @param largest_force  of a pull, in each direction [N]
  TaskMaker(const R& robot, double largest_force)
      : robot_(robot), check_(robot), motions_(robot), largest_force_(largest_force) {}

  /// @param request  any but SetParameters, which GainParameters checks
  /// @param present  the last reference that is known
  [[nodiscard]] Wish make(const Request& request, const Reference& present) const {
    return std::visit(
        [&](const auto& own) -> Wish {
          if constexpr (requires { motions_.make(own, present); }) {
            return motions_.make(own, present);
          } else {
            return make_wish(own);
          }
        },
        request);
  }

 private:
  [[nodiscard]] Wish make_wish(const Activate&) const {
    check_supervised();
    return task::Activate{};
  }
  [[nodiscard]] Wish make_wish(const Deactivate&) const {
    check_supervised();
    return task::Deactivate{};
  }
  [[nodiscard]] Wish make_wish(const AcknowledgeFault&) const {
    check_supervised();
    return task::Acknowledge{};
  }

  [[nodiscard]] Wish make_wish(const SetTrajectorySpeed& wanted) const {
    if (!(wanted.factor >= 0 && wanted.factor <= 1)) {
      refuse({"trajectory speed: factor ", wanted.factor, " is not within 0 .. 1"});
    }
    return task::SetTrajectorySpeed{wanted.factor};
  }

  [[nodiscard]] Wish make_wish(const SwitchControllers& wanted) const {
    using C = typename LoopType::ControllerType;
    if constexpr (articula::detail::switch_size<C> == 0) {
      refuse({"this loop has one controller, '", articula::detail::own_name<C>(0).view(),
              "', and nothing to switch"});
    }
    return task::Switch{
        .request = {.stop = RequestCheck<R>::checked_names(wanted.stop),
                    .start = RequestCheck<R>::checked_names(wanted.start),
                    .strictness = wanted.best_effort ? Strictness::best_effort : Strictness::strict,
                    .replace = wanted.replace}};
  }

  [[nodiscard]] Wish make_wish(const SetParameters&) const { return task::SetGains{}; }

  [[nodiscard]] Wish make_wish(const Pause& wanted) const {
    check_simulated();
    return task::Pause{wanted.paused};
  }
  [[nodiscard]] Wish make_wish(const Step& wanted) const {
    check_simulated();
    constexpr int most = 100000;
    if (wanted.cycles < 1 || wanted.cycles > most) {
      refuse({"step: ", wanted.cycles, " cycles are not within 1 .. ", most});
    }
    return task::Step{wanted.cycles};
  }
  [[nodiscard]] Wish make_wish(const SetSpeed& wanted) const {
    check_simulated();
    if (!(wanted.factor >= 0.01 && wanted.factor <= 100)) {
      refuse({"speed: factor ", wanted.factor, " is not within 0.01 .. 100"});
    }
    return task::SetSpeed{wanted.factor};
  }
  [[nodiscard]] Wish make_wish(const Reset& wanted) const {
    check_simulated();
    task::Place<joint_count> wish{initial_position(robot_, SimulatorOptions<joint_count>{})};
    for (const auto& [joint, value] : check_.numbers("reset", wanted.positions)) {
      check_.check_position("reset", joint, value);
      wish.position[joint] = value;
    }
    return wish;
  }
  [[nodiscard]] Wish make_wish(const Pull& pull) const {
    check_simulated();
    task::Pull wish{.link = link_index(robot_, pull.link)};
    constexpr double farthest = 1000;  // [m]
    for (std::size_t k = 0; k < 3; ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      if (!(std::abs(pull.point[k]) <= farthest)) {
        refuse({"pull: point ", pull.point[k], " m is not within -", farthest, " .. ", farthest});
      }
      if (!(std::abs(pull.force[k]) <= largest_force_)) {
        refuse({"pull: force ", pull.force[k], " N is not within -", largest_force_, " .. ",
                largest_force_});
      }
      wish.point[i] = pull.point[k];
      wish.force[i] = pull.force[k];
    }
    return wish;
  }

  [[noreturn]] static void refuse(articula::detail::MessageParts parts) {
    articula::detail::refuse(parts);
  }

  static void check_supervised() {
    if constexpr (!is_supervised<LoopType>) {
      refuse(
          {"this loop has no supervision: it is active as long as it runs; use SupervisedLoop to "
           "activate it"});
    }
  }
  static void check_simulated() {
    if constexpr (!is_simulated<LoopType>) {
      refuse({"this robot is not simulated"});
    }
  }

  const R& robot_;
  RequestCheck<R> check_;
  MotionTaskMaker<R> motions_;
  double largest_force_;
};

}  // namespace articula::remote

// SPDX-License-Identifier: Apache-2.0
/// @file The check of requests before a loop gets them.
#pragma once

#include "articula/control/switching/switch_board.hpp"
#include "articula/reference/joint_range.hpp"
#include "articula/reference/trajectory/trajectory_point.hpp"
#include "articula/remote/engine/loop_traits.hpp"
#include "articula/remote/engine/task.hpp"
#include "articula/remote/remote_options.hpp"
#include "articula/remote/request.hpp"
#include "articula/sim/simulator_options.hpp"

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace articula::remote {

/// Makes tasks of requests. Refuses unknown names, numbers that are not finite or beyond the robot's
/// limits, and requests that this loop does not understand. So nothing unchecked reaches the loop.
/// For the outside. All functions throw std::invalid_argument, naming joint, value and limit.
/// @tparam LoopType  a ControlLoop or SupervisedControlLoop
template <class LoopType>
class TaskMaker {
 public:
  using R = typename LoopType::RobotType;
  static constexpr int joint_count = LoopType::joint_count;
  using Wish = typename Task<R>::Wish;
  using Reference = JointReference<joint_count>;
  using Vector = JointVector<joint_count>;

  /// @param robot          stays where it is
  /// @param limits         of profiles
  /// @param largest_force  of a pull, in each direction [N]
  TaskMaker(const R& robot, const MotionLimits<joint_count>& limits, double largest_force)
      : robot_(robot), limits_(limits), largest_force_(largest_force) {}

  /// @param request  any but SetParameters, which GainParameters checks
  /// @param present  the last reference that is known
  [[nodiscard]] Wish make(const Request& request, const Reference& present) const {
    return std::visit([&](const auto& own) { return make_wish(own, present); }, request);
  }

 private:
  [[nodiscard]] Wish make_wish(const Activate&, const Reference&) const {
    check_supervised();
    return task::Activate{};
  }
  [[nodiscard]] Wish make_wish(const Deactivate&, const Reference&) const {
    check_supervised();
    return task::Deactivate{};
  }
  [[nodiscard]] Wish make_wish(const AcknowledgeFault&, const Reference&) const {
    check_supervised();
    return task::Acknowledge{};
  }

  [[nodiscard]] Wish make_wish(const Go& go, const Reference&) const {
    if (go.positions.empty()) refuse({"go: no joint is named"});
    if (!(go.speed >= 0.01 && go.speed <= 1)) {
      refuse({"go: speed ", go.speed, " is not within 0.01 .. 1"});
    }
    task::Go<joint_count> wish{Vector::Constant(std::numeric_limits<double>::quiet_NaN()),
                               go.speed};
    for (const auto& [joint, value] : numbers("go", go.positions)) {
      check_position("go", joint, value);
      wish.target[joint] = value;
    }
    return wish;
  }

  [[nodiscard]] Wish make_wish(const SetReference& set, const Reference&) const {
    task::Set<joint_count> wish;
    auto& [joints, positions, values] = wish.setting;
    for (const auto& [joint, value] : numbers("set_reference", set.positions)) {
      check_position("set_reference", joint, value);
      values.position[joint] = value;
      positions[joint] = joints[joint] = true;
    }
    for (const auto& [joint, value] : numbers("set_reference", set.velocities)) {
      check_size("set_reference", "velocity", joint, value, limits_of(joint).velocity);
      values.velocity[joint] = value;
      joints[joint] = true;
    }
    for (const auto& [joint, value] : numbers("set_reference", set.efforts)) {
      check_size("set_reference", "effort", joint, value, limits_of(joint).effort);
      values.effort[joint] = value;
      joints[joint] = true;
    }
    for (int j = 0; j < joint_count; ++j) {
      if (joints[j]) return wish;
    }
    refuse({"set_reference: no joint is named"});
  }

  [[nodiscard]] Wish make_wish(const PlayTrajectory& play, const Reference& present) const {
    auto trajectory =
        std::make_unique<const Trajectory<R, trajectory_capacity>>(arrange<trajectory_capacity>(
            robot_, play.trajectory,
            {.allow_partial_joints = true, .allow_integration = true, .from = present}));
    const auto points = trajectory->points();
    for (std::size_t k = 1; k < points.size(); ++k) {
      const Vector anything = Vector::Zero();  // all extremes are of interest
      const auto peaks = segment_peaks(points[k - 1], points[k],
                                       {.lowest = anything,
                                        .highest = anything,
                                        .velocity = anything,
                                        .acceleration = anything});
      for (int j = 0; j < joint_count; ++j) {
        check_size("trajectory between its points", "velocity", j, peaks.velocity[j],
                   limits_of(j).velocity * (1 + 1e-9));  // rounding
      }
    }
    task::Follow<R> wish{.trajectory = std::move(trajectory), .delay = play.delay};
    put_tolerances(play.path_tolerances, wish.tolerances.path_position,
                   wish.tolerances.path_velocity);
    put_tolerances(play.goal_tolerances, wish.tolerances.goal_position,
                   wish.tolerances.stopped_velocity);
    wish.tolerances.goal_time = play.goal_time;
    if (play.delay && !is_finite(*play.delay)) {
      refuse({"trajectory: delay ", *play.delay, " s is not a finite number"});
    }
    return wish;
  }

  [[nodiscard]] Wish make_wish(const SetTrajectorySpeed& wanted, const Reference&) const {
    if (!(wanted.factor >= 0 && wanted.factor <= 1)) {
      refuse({"trajectory speed: factor ", wanted.factor, " is not within 0 .. 1"});
    }
    return task::SetTrajectorySpeed{wanted.factor};
  }

  void put_tolerances(const std::vector<NamedTolerance>& named, Vector& position,
                      Vector& velocity) const {
    for (const NamedTolerance& own : named) {
      const int joint = joint_index(robot_, checked_name(own.joint));
      position[joint] = own.position;
      velocity[joint] = own.velocity;
    }
  }

  [[nodiscard]] Wish make_wish(const PlaySignals& play, const Reference& present) const {
    constexpr double longest = 86400;  // [s]
    if (!(play.duration > 0 && play.duration <= longest)) {
      refuse({"signals: duration ", play.duration, " s is not within 0 .. ", longest});
    }
    if (play.signals.empty()) refuse({"signals: there is none"});
    std::vector<JointSignal> signals;
    for (const NamedSignal& own : play.signals) {
      signals.push_back({checked_name(own.joint), own.signal, own.target});
    }
    JointSignals<R> sum(robot_, signals, {.position = present.position, .effort = present.effort});
    Vector velocity = Vector::Zero(), effort = Vector::Zero(), begin = Vector::Zero();
    for (const JointSignal& own : signals) {
      const int joint = joint_index(robot_, own.joint);
      const SignalValue peak = std::visit([](const auto& s) { return s.peak(); }, own.signal);
      (own.target == SignalTarget::effort ? effort : velocity)[joint] +=
          own.target == SignalTarget::effort ? peak.value : peak.rate;
      const bool jumps = std::holds_alternative<StepSignal>(own.signal) ||
                         std::holds_alternative<SquareSignal>(own.signal);
      if (own.target == SignalTarget::position && !jumps) {
        begin[joint] += std::visit([](const auto& s) { return s.sample(0).value; }, own.signal);
      }
    }
    for (int j = 0; j < joint_count; ++j) {
      check_size("signals", "velocity", j, velocity[j], limits_.velocity[j]);
      if (std::abs(begin[j]) > 1e-9) {  // rounding of a phase
        refuse({"signals: joint '", name_of(j), "' would jump by ", begin[j],
                " at the start: choose offset and phase so that the signals begin at 0"});
      }
      check_size("signals", "effort", j, effort[j], limits_of(j).effort);
    }
    return task::Play<R>{sum, play.duration};
  }

  [[nodiscard]] Wish make_wish(const Stop&, const Reference&) const { return task::Stop{}; }

  [[nodiscard]] Wish make_wish(const SwitchControllers& wanted, const Reference&) const {
    using C = typename LoopType::ControllerType;
    if constexpr (articula::detail::switch_size<C> == 0) {
      refuse({"this loop has one controller, '", articula::detail::own_name<C>(0).view(),
              "', and nothing to switch"});
    }
    return task::Switch{
        .request = {.stop = checked_names(wanted.stop),
                    .start = checked_names(wanted.start),
                    .strictness = wanted.best_effort ? Strictness::best_effort : Strictness::strict,
                    .replace = wanted.replace}};
  }

  [[nodiscard]] Wish make_wish(const SetParameters&, const Reference&) const {
    return task::SetGains{};
  }

  [[nodiscard]] Wish make_wish(const Pause& wanted, const Reference&) const {
    check_simulated();
    return task::Pause{wanted.paused};
  }
  [[nodiscard]] Wish make_wish(const Step& wanted, const Reference&) const {
    check_simulated();
    constexpr int most = 100000;
    if (wanted.cycles < 1 || wanted.cycles > most) {
      refuse({"step: ", wanted.cycles, " cycles are not within 1 .. ", most});
    }
    return task::Step{wanted.cycles};
  }
  [[nodiscard]] Wish make_wish(const SetSpeed& wanted, const Reference&) const {
    check_simulated();
    if (!(wanted.factor >= 0.01 && wanted.factor <= 100)) {
      refuse({"speed: factor ", wanted.factor, " is not within 0.01 .. 100"});
    }
    return task::SetSpeed{wanted.factor};
  }
  [[nodiscard]] Wish make_wish(const Reset& wanted, const Reference&) const {
    check_simulated();
    task::Place<joint_count> wish{initial_position(robot_, SimulatorOptions<joint_count>{})};
    for (const auto& [joint, value] : numbers("reset", wanted.positions)) {
      check_position("reset", joint, value);
      wish.position[joint] = value;
    }
    return wish;
  }
  [[nodiscard]] Wish make_wish(const Pull& pull, const Reference&) const {
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

  [[nodiscard]] const JointLimits& limits_of(int joint) const {
    return model_of(robot_).joints[joint].limits;
  }

  /// A name that a Name can hold.
  [[nodiscard]] static Name checked_name(const std::string& name) {
    if (name.size() > Name::capacity || name.find('\0') != std::string::npos) {
      refuse({"a name has at most ", Name::capacity, " characters, none of them NUL"});
    }
    return name;
  }
  [[nodiscard]] static ControllerNames checked_names(const std::vector<std::string>& names) {
    if (names.size() > ControllerNames::capacity) {
      refuse({names.size(), " controllers are more than ", ControllerNames::capacity});
    }
    std::vector<Name> checked;
    for (const std::string& name : names) checked.push_back(checked_name(name));
    return ControllerNames(std::span<const Name>(checked));
  }

  /// The joints and their numbers, each joint once.
  [[nodiscard]] std::vector<std::pair<int, double>> numbers(
      std::string_view what, const std::vector<JointValue>& values) const {
    std::vector<std::pair<int, double>> found;
    for (const JointValue& own : values) {
      const int joint = joint_index(robot_, own.joint);
      for (const auto& [other, value] : found) {
        if (other == joint) refuse({what, ": joint '", own.joint, "' is named twice"});
      }
      found.emplace_back(joint, own.value);
    }
    return found;
  }

  void check_position(std::string_view what, int joint, double value) const {
    const JointLimits& limits = limits_of(joint);
    if (is_finite(value) && value >= limits.lower && value <= limits.upper) return;
    refuse({what, ": position ", value, " of joint '", name_of(joint), "' is not within ",
            limits.lower, " .. ", limits.upper});
  }
  void check_size(std::string_view what, std::string_view quantity, int joint, double value,
                  double limit) const {
    if (is_finite(value) && std::abs(value) <= limit) return;
    refuse({what, ": ", quantity, " ", value, " of joint '", name_of(joint),
            "' is above the limit ", limit});
  }
  [[nodiscard]] std::string_view name_of(int joint) const {
    return model_of(robot_).joints[joint].name.view();
  }

  const R& robot_;
  MotionLimits<joint_count> limits_;
  double largest_force_;
};

}  // namespace articula::remote

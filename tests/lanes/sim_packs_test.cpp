// SPDX-License-Identifier: Apache-2.0
// A simulator of a pack of robots against simulators of one robot each, under all kinds of
// commands. Both do the same operations for each robot. They may differ by what compilers contract,
// which grows with the motion: 1e-9 in two seconds.
#include <articula/robots/panda.hpp>
#include <articula/robots/q2d.hpp>
#include <articula/sim/simulator.hpp>
#include <articula/symbolic/pack.hpp>

#include "catch.hpp"

#include <cmath>
#include <limits>
#include <vector>

using namespace articula;

namespace {

using Pack = symbolic::Pack<>;

/// A vector of the pack with another motion for each robot.
template <int N>
JointVector<N, Pack> waves(double amplitude, double rate, double time) {
  JointVector<N, Pack> packed;
  for (int k = 0; k < Pack::lanes; ++k) {
    JointVector<N> own;
    for (int j = 0; j < N; ++j) own[j] = amplitude * std::sin(rate * time + j + 0.7 * k);
    set_lane(packed, k, own);
  }
  return packed;
}

/// @param command  callable with the time -> command of the pack
/// @param own      callable with a command of the pack and a lane -> command of one robot
template <class R, class Command, class Own>
void compare(const SimulatorOptions<joint_count<R>>& options, const Command& command,
             const Own& own) {
  Simulator<R, Pack> together(options);
  std::vector<Simulator<R>> alone;
  for (int k = 0; k < Pack::lanes; ++k) {
    alone.emplace_back(options);
    if (options.position_noise.maxCoeff() > 0) {
      auto other = options;
      other.seed += static_cast<unsigned>(k);
      alone.back() = Simulator<R>(other);
    }
  }
  for (int cycle = 0; cycle < 2000; ++cycle) {
    const auto commands = command(cycle * options.period);
    REQUIRE(together.write(commands) == Status::ok);
    JointState<joint_count<R>, Pack> states;
    REQUIRE(together.read(states) == Status::ok);
    for (int k = 0; k < Pack::lanes; ++k) {
      Simulator<R>& robot = alone[static_cast<std::size_t>(k)];
      REQUIRE(robot.write(own(commands, k)) == Status::ok);
      JointState<joint_count<R>> state;
      REQUIRE(robot.read(state) == Status::ok);
      REQUIRE((lane_of(states.position, k) - state.position).norm() <= 1e-9);
      REQUIRE((lane_of(states.velocity, k) - state.velocity).norm() <= 1e-8);
      REQUIRE((lane_of(states.effort, k) - state.effort).norm() <= 1e-6);
    }
  }
}

template <class R>
constexpr auto effort_of = [](const EffortCommand<joint_count<R>, Pack>& command, int lane) {
  return EffortCommand<joint_count<R>>{lane_of(command.effort, lane)};
};
template <class R>
constexpr auto position_of = [](const PositionCommand<joint_count<R>, Pack>& command, int lane) {
  return PositionCommand<joint_count<R>>{lane_of(command.position, lane)};
};

}  // namespace

TEST_CASE("Each robot of a pack moves under its efforts as it would alone, stops included") {
  compare<Q2d>(
      {}, [](double t) { return EffortCommand<2, Pack>{waves<2>(3, 3, t)}; }, effort_of<Q2d>);
  compare<Panda>(
      {}, [](double t) { return EffortCommand<7, Pack>{waves<7>(30, 3, t)}; }, effort_of<Panda>);
}

TEST_CASE("Each robot of a pack follows its positions as it would alone, effort limits included") {
  compare<Panda>(
      {}, [](double t) { return PositionCommand<7, Pack>{waves<7>(2, 9, t)}; }, position_of<Panda>);
}

TEST_CASE("Each robot of a pack follows its velocities as it would alone") {
  compare<Q2d>(
      {}, [](double t) { return VelocityCommand<2, Pack>{waves<2>(2, 9, t)}; },
      [](const VelocityCommand<2, Pack>& command, int lane) {
        return VelocityCommand<2>{lane_of(command.velocity, lane)};
      });
}

TEST_CASE("Each robot of a pack has its encoders and its noise, under ideal drives") {
  compare<Q2d>(
      {.drives = DriveModel::ideal, .encoder_resolution = {1e-3, 0}, .position_noise = {0, 1e-3}},
      [](double t) { return PositionCommand<2, Pack>{waves<2>(2, 9, t)}; }, position_of<Q2d>);
}

TEST_CASE("Each robot of a pack is moved by its springs as it would alone") {
  compare<Q2d>(
      {},
      [](double t) {
        MultiModeCommand<2, Pack> command{.position = waves<2>(2, 9, t)};
        command.stiffness.setConstant(20.0);
        command.damping.setConstant(2.0);
        return command;
      },
      [](const MultiModeCommand<2, Pack>& command, int lane) { return lane_of(command, lane); });
}

TEST_CASE("A command that is not finite for one robot is refused for the pack") {
  Simulator<Q2d, Pack> robots;
  EffortCommand<2, Pack> command;
  command.effort[0].set(Pack::lanes - 1, std::numeric_limits<double>::quiet_NaN());
  CHECK(robots.write(command) == Status::non_finite_command);
  CHECK(lane_of(robots.true_state().effort, 0) == JointVector<2>::Zero());
  static_cast<void>(robots.deactivate());
  CHECK(robots.write(EffortCommand<2, Pack>{}) == Status::inactive);
}

// SPDX-License-Identifier: Apache-2.0
// A robot whose masses are not known has kinematics and motion, and no dynamics.
#include <articula/control/computed_torque.hpp>
#include <articula/control/forward_position.hpp>
#include <articula/control/forward_velocity.hpp>
#include <articula/control/limits/limited.hpp>
#include <articula/control/pid.hpp>
#include <articula/control/pid_plus_gravity.hpp>
#include <articula/control/switching/groups.hpp>
#include <articula/control/switching/switch.hpp>
#include <articula/dynamics/dynamics.hpp>
#include <articula/hardware/mock/mock_hardware.hpp>
#include <articula/loop/supervision/supervised_loop.hpp>
#include <articula/reference/trajectory/trajectory_follower.hpp>
#include <articula/sim/simulator.hpp>
#include <articula/tuning/carried_body.hpp>
#include <articula/tuning/equivalent_inertia.hpp>

#include <type_traits>

using namespace articula;

struct Scara {
  static constexpr auto description = RobotDescription{
      .name = "scara",
      .links = std::to_array<Link>({{.name = "base"}, {.name = "arm"}, {.name = "tool"}}),
      .joints = std::to_array<Joint>({{.name = "shoulder",
                                       .type = JointType::revolute,
                                       .parent = "base",
                                       .child = "arm",
                                       .axis = {0, 0, 1},
                                       .limits = {.lower = -1, .upper = 1, .velocity = 2}},
                                      {.name = "elbow",
                                       .type = JointType::revolute,
                                       .parent = "arm",
                                       .child = "tool",
                                       .origin = {0.4, 0, 0},
                                       .axis = {0, 0, 1},
                                       .limits = {.lower = -1, .upper = 1, .velocity = 2}}}),
      .kinematic = true};
};
using Loaded = KinematicModel<2>;

// Neither makes the other, in silence or in braces.
static_assert(!std::is_convertible_v<Loaded, Model<2>> && !std::is_convertible_v<Model<2>, Loaded>);
static_assert(!std::is_constructible_v<Model<2>, Loaded> && !std::is_base_of_v<Model<2>, Loaded>);

static_assert(Robot<Scara> && Robot<Loaded> && DescribedRobot<Scara>);
static_assert(!DynamicRobot<Scara> && !DynamicRobot<Loaded> && DynamicRobot<Model<2>>);

// What needs no masses.
template <Robot R>
using Positions = MockHardware<R>;  // of a kinematic robot
static_assert(std::same_as<Positions<Scara>::Command, PositionCommand<2>>);
static_assert(std::same_as<Positions<Loaded>::Command, PositionCommand<2>>);
template <Robot R>
using Velocities = MockHardware<R, VelocityCommand<2>>;
template <class R>
using LimitedPosition = Limited<R, ForwardPosition<R>>;
template <class R>
using LimitedVelocity = Limited<R, ForwardVelocity<R>>;

template class articula::TrajectoryFollower<Scara>;
template class articula::TrajectoryFollower<Loaded>;

template <Robot R>
void motion(const R& robot) {
  const CommandLimits<2> limits = command_limits(robot);
  Loop<Positions<R>, LimitedPosition> positions{
      Positions<R>{robot}, LimitedPosition<R>{robot, limits}};  // makes its ForwardPosition
  Loop<Velocities<R>, LimitedVelocity> velocities{
      Velocities<R>{robot}, LimitedVelocity<R>{robot, limits, ForwardVelocity<R>{robot}}};
  SupervisedLoop<Positions<R>, ForwardPosition> supervised{Positions<R>{robot},
                                                           ForwardPosition<R>{robot}};
  static_cast<void>(positions.update() == velocities.update() &&
                    positions.update() == supervised.update());
  TrajectoryFollower<R> follower(robot, {0, 0}, {{1, 1}, {1, 1}, {1, 1}});
  static_cast<void>(follower.sample(0.0));
}

template <Robot R>
double kinematics(const R& robot) {
  const JointVector<2> q(0.1, 0.2);
  return forward_kinematics(robot, q, "tool")(0, 3) + jacobian(robot, q, "tool")(0, 0) +
         friction_effort(robot, q)[0] + moving_joint_positions(robot, q)[0];
}

// What does.
template <Robot R>
void dynamics(const R& robot) {
  const JointVector<2> q(0.1, 0.2);
  static_cast<void>(inverse_dynamics(robot, q, q, q));
  static_cast<void>(nonlinear_effects(robot, q, q));
  static_cast<void>(mass_matrix(robot, q));
  static_cast<void>(gravity(robot, q));
  static_cast<void>(potential_energy(robot, q));
  static_cast<void>(kinetic_energy(robot, q, q));
  static_cast<void>(carried_body(robot, q, 0));
}

int main() {
  const Loaded loaded{};
  motion(Scara{});
  motion(loaded);
  const JointVector<2> q(0.1, 0.2);
  double sum = forward_kinematics<"tool">(Scara{}, q)(0, 3) + jacobian<"tool">(Scara{}, q)(0, 0);
  sum += kinematics(Scara{}) + kinematics(loaded);
#ifdef DESCRIBED
  dynamics(Scara{});
  sum += operations<InverseDynamics, Scara>().additions;
#endif
#ifdef LOADED
  dynamics(loaded);
  static_cast<void>(forward_dynamics(loaded, {0.1, 0.2}, {0, 0}, {0, 0}));
#endif
#ifdef PARTS
  Simulator<Scara> simulator;
  GravityCompensation<Scara> gravity_compensation;
  ComputedTorqueLaw<Loaded> computed_torque(loaded, {});
  EffortLimiter<Scara> limiter(Scara{}, {});
#endif
#ifdef EFFORT_LOOP
  using Efforts = MockHardware<Loaded, EffortCommand<2>>;
  Loop<Efforts, Pid> loop{Efforts{loaded}, Pid<Loaded>{loaded, {}}};
  static_cast<void>(loop.update());
#endif
#ifdef SLICED
  const Model<2>& dynamic = loaded;
  sum += gravity(dynamic, q)[0];
#endif
#ifdef BRACED
  sum += gravity(Model<2>{loaded}, q)[0];
#endif
#ifdef INERTIA
  sum += equivalent_inertia(loaded, JointVector<2>(0.1, 0.2), 0);
#endif
  return sum > 0 ? 0 : 1;
}

// SPDX-License-Identifier: Apache-2.0
// The concepts: the least that satisfies each, and what does not. Compiling is passing.
#include "faulty_robots.hpp"

#include <articula/core/controller.hpp>
#include <articula/core/finite.hpp>
#include <articula/core/hardware.hpp>
#include <articula/dynamics/dynamics.hpp>
#include <articula/robots/q2d.hpp>

#include <type_traits>

using namespace articula;

namespace static_tests {

// Data have the size that their type says, and start at zero.
static_assert(JointState<3>::joint_count == 3 && JointReference<3>::joint_count == 3);
static_assert(JointVector<5>::SizeAtCompileTime == 5 && JointMatrix<5>::SizeAtCompileTime == 25);
static_assert(sizeof(JointState<2>) == 6 * sizeof(double));
static_assert(sizeof(EffortCommand<7>) == 7 * sizeof(double));

// Commands.
static_assert(JointCommand<EffortCommand<2>, 2> && JointCommand<PositionCommand<2>, 2>);
static_assert(JointCommand<VelocityCommand<2>, 2>);
static_assert(!JointCommand<EffortCommand<2>, 3> && !JointCommand<JointState<2>, 2>);
static_assert(!JointCommand<const EffortCommand<2>&, 2> && !JointCommand<double, 1>);

// Controllers: an archetype, and one property missing or wrong at a time.
struct LeastController {
  void start(const JointState<2>&) noexcept;
  EffortCommand<2> update(const JointState<2>&, const JointReference<2>&, double) noexcept;
};
struct PositionController : LeastController {
  PositionCommand<2> update(const JointState<2>&, const JointReference<2>&, double) noexcept;
};
struct StartMayThrow : LeastController {
  void start(const JointState<2>&);
};
struct UpdateMayThrow : LeastController {
  EffortCommand<2> update(const JointState<2>&, const JointReference<2>&, double);
};
struct ReturnsAVector : LeastController {
  JointVector<2> update(const JointState<2>&, const JointReference<2>&, double) noexcept;
};
struct WantsToChangeTheState : LeastController {
  EffortCommand<2> update(JointState<2>&, const JointReference<2>&, double) noexcept;
};
struct WithoutPeriod : LeastController {
  EffortCommand<2> update(const JointState<2>&, const JointReference<2>&) noexcept;
};
static_assert(Controller<LeastController, 2> && Controller<PositionController, 2>);
static_assert(!Controller<LeastController, 3>);
static_assert(!Controller<StartMayThrow, 2> && !Controller<UpdateMayThrow, 2>);
static_assert(!Controller<ReturnsAVector, 2> && !Controller<WantsToChangeTheState, 2>);
static_assert(!Controller<WithoutPeriod, 2> && !Controller<int, 2>);

// Hardware likewise.
struct LeastHardware {
  using RobotType = Q2d;
  static constexpr int joint_count = 2;
  [[nodiscard]] const Q2d& robot() const;
  Status activate();
  Status deactivate();
  Status read(JointState<2>&) noexcept;
  Status write(const EffortCommand<2>&) noexcept;
};
struct PositionHardware : LeastHardware {
  Status write(const PositionCommand<2>&) noexcept;
};
struct ReadMayThrow : LeastHardware {
  Status read(JointState<2>&);
};
struct WriteMayThrow : LeastHardware {
  Status write(const EffortCommand<2>&);
};
struct WriteSaysNothing : LeastHardware {
  void write(const EffortCommand<2>&) noexcept;
};
struct ReadSaysBool : LeastHardware {
  bool read(JointState<2>&) noexcept;
};
struct OfAnotherRobot : LeastHardware {
  [[nodiscard]] int robot() const;
};
struct WithoutActivate : LeastHardware {
  void activate() = delete;
};
static_assert(Hardware<LeastHardware> && Hardware<Q2dSim>);
static_assert(Hardware<PositionHardware, PositionCommand<2>> && !Hardware<PositionHardware>);
static_assert(!Hardware<LeastHardware, PositionCommand<2>>);
static_assert(!Hardware<LeastHardware, EffortCommand<3>>);
static_assert(!Hardware<ReadMayThrow> && !Hardware<WriteMayThrow>);
static_assert(!Hardware<WriteSaysNothing> && !Hardware<ReadSaysBool>);
static_assert(!Hardware<OfAnotherRobot> && !Hardware<WithoutActivate>);

// Robots.
struct Swing {
  static constexpr auto description = support::double_pendulum;
};
struct WithState {
  static constexpr auto description = support::double_pendulum;
  double mood = 0;
};
struct WithoutDefault {
  static constexpr auto description = support::double_pendulum;
  WithoutDefault() = delete;
};
struct OddDescription {
  static constexpr int description = 2;
};
static_assert(Robot<Q2d> && DescribedRobot<Q2d> && Robot<Swing> && DescribedRobot<Swing>);
static_assert(Robot<Model<3>> && !DescribedRobot<Model<3>>);
static_assert(!Robot<WithState> && !Robot<WithoutDefault> && !Robot<OddDescription>);
static_assert(!Robot<int> && !Robot<Mechanism<2>> && !Robot<RobotDescription<3, 2>>);
static_assert(joint_count<Q2d> == 2 && joint_count<Swing> == 2 && joint_count<Model<3>> == 3);
static_assert(joint_names(Q2d{}) ==
              std::array<std::string_view, 2>{"shoulder_active_joint", "elbow_active_joint"});
static_assert(joint_index(Q2d{}, "shoulder_active_joint") == 0);
static_assert(joint_index(Q2d{}, "elbow_active_joint") == 1);

// What runs in a loop does not throw.
extern const JointVector<2> q, v, a;
static_assert(noexcept(inverse_dynamics(Q2d{}, q, v, a)));
static_assert(noexcept(forward_dynamics(Q2d{}, q, v, a)));
static_assert(noexcept(nonlinear_effects(Q2d{}, q, v)));
static_assert(noexcept(gravity(Q2d{}, q)) && noexcept(mass_matrix(Q2d{}, q)));
static_assert(noexcept(kinetic_energy(Q2d{}, q, v)) && noexcept(potential_energy(Q2d{}, q)));
static_assert(noexcept(friction_effort(Q2d{}, v)));
static_assert(noexcept(forward_kinematics(Q2d{}, q, LinkIndex{})));

}  // namespace static_tests

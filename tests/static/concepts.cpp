// SPDX-License-Identifier: Apache-2.0
// The concepts: the least that satisfies each, and what does not. Compiling is passing.
#include "robots/faulty_robots.hpp"

#include <articula/control/laws/control_law.hpp>
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
  EffortCommand<2> update(const ControlInput<2>&) noexcept;
};
struct PositionController : LeastController {
  PositionCommand<2> update(const ControlInput<2>&) noexcept;
};
struct WithVerdict : LeastController {
  Outcome<EffortCommand<2>> update(const ControlInput<2>&) noexcept;
};
struct WithMemory : LeastController {
  void start(const ControlInput<2>&) noexcept;
  Outcome<EffortCommand<2>> brake(const ControlInput<2>&) noexcept;
};
struct StartMayThrow : LeastController {
  void start(const ControlInput<2>&);
};
struct StartOfAState : LeastController {
  void start(const JointState<2>&) noexcept;
};
struct UpdateMayThrow : LeastController {
  EffortCommand<2> update(const ControlInput<2>&);
};
struct ReturnsAVector : LeastController {
  JointVector<2> update(const ControlInput<2>&) noexcept;
};
struct WantsToChangeTheInput : LeastController {
  EffortCommand<2> update(ControlInput<2>&) noexcept;
};
struct OfAState : LeastController {
  EffortCommand<2> update(const JointState<2>&, const JointReference<2>&, double) noexcept;
};
static_assert(Controller<LeastController, 2> && Controller<PositionController, 2>);
static_assert(Controller<WithVerdict, 2> && Controller<WithMemory, 2>);
static_assert(Brakes<WithMemory, 2> && !Brakes<LeastController, 2>);
static_assert(std::is_same_v<CommandOf<WithVerdict, 2>, EffortCommand<2>>);
static_assert(!Controller<LeastController, 3>);
static_assert(!Controller<StartMayThrow, 2> && !Controller<UpdateMayThrow, 2>);
static_assert(!Controller<ReturnsAVector, 2> && !Controller<WantsToChangeTheInput, 2>);
static_assert(!Controller<StartOfAState, 2> && !Controller<OfAState, 2> && !Controller<int, 2>);

// A function is a controller, too.
using Function = decltype([](const ControlInput<2>&) noexcept { return EffortCommand<2>(); });
using FunctionMayThrow = decltype([](const ControlInput<2>&) { return EffortCommand<2>(); });
using FunctionOfAState = decltype([](const JointState<2>&) noexcept { return EffortCommand<2>(); });
static_assert(Controller<Function, 2> && !Controller<Function, 3>);
static_assert(!Controller<FunctionMayThrow, 2> && !Controller<FunctionOfAState, 2>);

// A plain command converts to an outcome.
static_assert(std::is_convertible_v<EffortCommand<2>, Outcome<EffortCommand<2>>>);
static_assert(!std::is_convertible_v<EffortCommand<3>, Outcome<EffortCommand<2>>>);

// Laws likewise.
struct LeastLaw {
  JointVector<2> output(const ControlInput<2>&) noexcept;
};
struct LawWithMemory : LeastLaw {
  void start(const ControlInput<2>&) noexcept;
};
struct LawThatShares : LeastLaw {
  JointVector<2> start(const ControlInput<2>&) noexcept;
};
struct OutputMayThrow : LeastLaw {
  JointVector<2> output(const ControlInput<2>&);
};
struct LawStartsFromAState : LeastLaw {
  void start(const JointState<2>&) noexcept;
};
static_assert(ControlLaw<LeastLaw, 2> && ControlLaw<LawWithMemory, 2>);
static_assert(ControlLaw<LawThatShares, 2> && !ControlLaw<LeastLaw, 3>);
static_assert(!ControlLaw<OutputMayThrow, 2> && !ControlLaw<LawStartsFromAState, 2>);

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

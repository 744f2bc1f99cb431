// SPDX-License-Identifier: Apache-2.0
// Every function whose comment says "Real-time: yes" is called here under the allocation guard: for
// a robot known at compile time and for a model loaded at run time.
#include <articula/articula.hpp>
#include <articula/control/laws/friction_compensation.hpp>
#include <articula/core/constant_math.hpp>
#include <articula/robots/q2d.hpp>

#include "allocation_guard.hpp"
#include "catch.hpp"
#include "robots/test_robots.hpp"

using namespace articula;
using articula::testing::heap_calls_in;

namespace {

using Vector = JointVector<2>;

/// The compiler cannot know who looks here, so it must compute what comes.
double volatile seen = 0;
void look(double x) { seen = x; }
template <class Derived>
void look(const Eigen::MatrixBase<Derived>& x) {
  seen = x.sum();
}

const Vector q(0.3, -0.7), v(1, 2), a(-3, 4), effort(5, -6);

template <Robot R>
std::size_t heap_calls_of_model_and_dynamics(const R& robot) {
  const LinkIndex tool = link_index(robot, "tool_link");
  const JointVectors<2, 8> many = JointVectors<2, 8>::Constant(0.5);
  return heap_calls_in([&] {
    look(inverse_dynamics(robot, many, many, many));
    look(gravity(robot, many));
    look(nonlinear_effects(robot, many, many));
    look(forward_dynamics(robot, many, many, many));
    look(static_cast<double>(model_of(robot).links.size()));
    look(static_cast<double>(joint_names(robot)[1].size()));
    look(joint_values(robot, [](const JointProperties& joint) { return joint.damping; }));
    look(effort_limits(robot));
    look(inverse_dynamics(robot, q, v, a));
    look(gravity(robot, q));
    look(nonlinear_effects(robot, q, v));
    look(mass_matrix(robot, q));
    look(forward_dynamics(robot, q, v, effort));
    look(forward_kinematics(robot, q, tool).matrix());
    look(jacobian(robot, q, tool));
    look(kinetic_energy(robot, q, v));
    look(potential_energy(robot, q));
    look(friction_effort(robot, v));
  });
}

template <Robot R>
std::size_t heap_calls_of_control(const R& robot) {
  const auto gains = Q2d::pid_gains;
  Bypass<R> bypass(robot);
  Pid<R> pid(robot, gains);
  PidPlusGravity<R> plus_gravity(robot, gains);
  ComputedTorque<R> torque(robot, gains);
  PidLaw<2> law(gains, joint_names(robot));
  GravityCompensation<R> weight(robot);
  FrictionCompensation<R> friction(robot);
  EffortFeedforward<2> feedforward;
  ComputedTorqueLaw<R> torque_law(robot, gains);
  const JointState<2> state{q, v, effort};
  const JointReference<2> reference{v, q, a, effort};
  const ControlInput<2> in{state, reference, 1e-3, {effort, Held::load}, effort};
  return heap_calls_in([&] {
    const auto runs = [&](auto&... controller) {
      (controller.start(in), ...);
      (look(controller.update(in).effort), ...);
    };
    runs(bypass, pid, plus_gravity, torque);
    look(pid.template part<PidLaw<2>>().integral());
    const auto adds = [&](auto&... part) { (look(part.output(in)), ...); };
    look(law.start(in));
    look(torque_law.start(in));
    adds(law, weight, friction, feedforward, torque_law);
    look(law.integral());
    look(within_effort_limits(robot, EffortCommand<2>{1e3 * effort}).effort);
    look(safe_command(robot, q, EffortCommand<2>{}).effort);
    look(safe_command(robot, q, PositionCommand<2>{}).position);
    look(safe_command(robot, q, VelocityCommand<2>{}).velocity);
  });
}

template <Robot R>
std::size_t heap_calls_of_simulation(const R& robot) {
  SimulatorOptions<2> options;
  options.encoder_resolution.setConstant(1e-4);
  options.position_noise.setConstant(1e-3);
  Simulator<R> simulator(robot, options);
  JointDynamics<R> dynamics(robot);
  JointSensors<2> sensors(options);
  JointState<2> state;
  return heap_calls_in([&] {
    const auto drives = [](const Vector&, const Vector&) noexcept { return effort; };
    look(dynamics.advance({q, v}, drives, 1e-3).position);
    look(dynamics.advance({Vector(1.57, -1.57), 1000 * Vector(1, -1)}, drives, 1e-3).position);
    look(sensors.measure({q, v, effort}).position);
    static_cast<void>(simulator.write({effort}));
    static_cast<void>(simulator.read(state));
    look(state.position + simulator.true_state().position);
    look(simulator.time() + simulator.period() + simulator.options().period);
    look(effort_limits(simulator.robot()));
  });
}

}  // namespace

TEST_CASE("model and dynamics do not touch the heap") {
  CHECK(heap_calls_of_model_and_dynamics(Q2d()) == 0);
  CHECK(heap_calls_of_model_and_dynamics(support::model<Q2d>()) == 0);
}

TEST_CASE("controllers and their parts do not touch the heap") {
  CHECK(heap_calls_of_control(Q2d()) == 0);
  CHECK(heap_calls_of_control(support::model<Q2d>()) == 0);
}

TEST_CASE("the simulation does not touch the heap") {
  CHECK(heap_calls_of_simulation(Q2d()) == 0);
  CHECK(heap_calls_of_simulation(support::model<Q2d>()) == 0);
}

TEST_CASE("the kernels below do not touch the heap") {
  const auto oscillation = [](const Vector& position, const Vector&) -> Vector {
    return -position;
  };
  EffortBounds<2> bounds;
  bounds.upper.setConstant(1);
  JointArray<int, 2> chain{-1, 0};
  const JointMatrix<2> m = mass_matrix(Q2d(), q);
  CHECK(heap_calls_in([&] {
          look(runge_kutta_step<2>({q, v}, 1e-3, oscillation).position);
          look(hold_within_bounds<2>(chain, m, effort, bounds).motion);
          look(constant_math::square_root(2) + constant_math::sine_cosine(1).sine);
          look(static_cast<double>(to_string(Status::ok).size()));
          look(static_cast<double>(Name("joint").view().size()));
          look(is_finite(JointState<2>{q, v, a}) && is_finite(JointReference<2>{q, v, a, effort})
                   ? 1
                   : 0);
          look(is_finite(EffortCommand<2>{q}) && is_finite(PositionCommand<2>{q}) &&
                       is_finite(VelocityCommand<2>{q})
                   ? 1
                   : 0);
        }) == 0);
}

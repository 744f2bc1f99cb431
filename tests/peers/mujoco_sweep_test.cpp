// SPDX-License-Identifier: Apache-2.0
// Runs of a sweep beside MuJoCo with the bodies of these runs.
#include "catch.hpp"
#include "peers/mujoco.hpp"

#include <articula/control/computed_torque.hpp>
#include <articula/robots/ur10.hpp>
#include <articula/sweep/closed_loop_experiment.hpp>
#include <articula/sweep/run_chunk.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

using namespace articula;

namespace {

constexpr int n = 6;
using Arm = std::remove_cvref_t<decltype(model_of(Ur10()))>;

/// UR10s with other masses and an unknown load. MuJoCo has neither damping nor dry friction here,
/// so the factor 0 takes those of the joints away.
auto swept_arms() {
  JointPidGains<n> gains;
  gains.fill({.proportional = 100, .integral = 50, .derivative = 20});
  ClosedLoopOptions<n> options;
  options.duration = 0.5;
  options.simulation.initial_position = JointVector<n>(0, -1.2, 1.2, 0, 0.5, 0);
  options.target = JointVector<n>(0.2, -1.0, 1.5, -0.2, 0.7, 0.3);
  options.vary = {{VariedQuantity::payload, "tool0", 0, 10},
                  {VariedQuantity::mass, {}, 0.7, 1.3},
                  {VariedQuantity::mass, "forearm_link", 0.7, 1.3},
                  {VariedQuantity::damping, {}, 0, 0},
                  {VariedQuantity::friction, {}, 0, 0}};
  const Arm robot = model_of(Ur10());
  const auto make = [robot](const JointPidGains<n>& own) {
    return ComputedTorque<Arm>(robot, own);
  };
  return ClosedLoopExperiment(robot, gains, make, options);
}

}  // namespace

// MuJoCo gets the efforts of a run, and takes the same Runge-Kutta steps: the trajectories have the
// same discretisation. MuJoCo turns inertias to their principal axes by an iteration that it ends
// early, with a relative error of some 1e-8 to 1e-7 in accelerations of at most 100 rad/s^2. In
// half a second, this is 1e-6 rad and 5e-6 rad/s; the tolerance is ten times as much. A load that
// is 1 % off changes the positions by more than 1e-4 rad.
TEST_CASE("a run of a sweep is what MuJoCo makes of its bodies and efforts") {
  const auto experiment = swept_arms();
  const Samples samples(experiment.parameters(),
                        {.method = SamplingMethod::sobol, .runs = 8, .seed = 3});
  const auto run = GENERATE(range(0, 8));
  CAPTURE(run);
  const auto number = static_cast<std::uint64_t>(run);
  const SweepRow row = run_once(experiment, samples, number);
  const auto loop = experiment.loop({row.number, row.seed, row.parameters});
  auto peer = support::load_mujoco(loop.model.mechanism.bodies, loop.model.mechanism.gravity,
                                   loop.simulation.period / loop.simulation.substeps);
  using Numbers = Eigen::Map<Eigen::VectorXd>;
  Numbers position(peer.data->qpos, n), velocity(peer.data->qvel, n),
      effort(peer.data->qfrc_applied, n);
  position = *loop.simulation.initial_position;

  // The run replayed by a loop of one's own.
  const Arm robot = model_of(Ur10());
  ControlLoop arm(Simulator<Arm>(loop.model, loop.simulation),
                  ComputedTorque<Arm>(robot, loop.gains));
  arm.reference().position = JointVector<n>(0.2, -1.0, 1.5, -0.2, 0.7, 0.3);
  double position_error = 0, velocity_error = 0, moved = 0;
  JointVector<n> fastest = JointVector<n>::Zero();
  for (int cycle = 0; cycle < 500; ++cycle) {
    REQUIRE(arm.update() == Status::ok);
    const auto& truth = arm.hardware().true_state();
    effort = truth.effort;
    for (int k = 0; k < loop.simulation.substeps; ++k) mj_step(peer.model.get(), peer.data.get());
    position_error = std::max(position_error, (truth.position - position).cwiseAbs().maxCoeff());
    velocity_error = std::max(velocity_error, (truth.velocity - velocity).cwiseAbs().maxCoeff());
    moved = std::max(moved, std::abs(truth.position[2] - 1.2));
    fastest = fastest.cwiseMax(velocity.cwiseAbs());
  }
  CHECK(moved > 0.2);
  CHECK(position_error < 1e-5);
  CHECK(velocity_error < 5e-5);
  // The sweep's own metric is that of MuJoCo's trajectory.
  const auto& metrics = experiment.metrics();
  const auto peak = std::ranges::find(metrics, "elbow_joint.velocity_peak", &SweepMetric::name);
  REQUIRE(peak != metrics.end());
  CHECK(std::abs(row.metrics[static_cast<std::size_t>(peak - metrics.begin())] - fastest[2]) <
        5e-5);
}

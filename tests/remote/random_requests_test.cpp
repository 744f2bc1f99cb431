// SPDX-License-Identifier: Apache-2.0
// Whatever is asked at whatever time, the reference does not jump, and stays within the limits.
#include <algorithm>
#include <cmath>
#include <string>

#include "catch.hpp"
#include "numbers.hpp"
#include "random.hpp"
#include "remote/remote_arm.hpp"

using namespace articula;
using namespace articula::remote;
using support::elbow;
using support::Random;
using support::shoulder;

namespace {

template <class R>
using Controllers = Switch<R, PidPlusGravity<R>, ComputedTorque<R>>;
using Arm = support::RemoteArm<SupervisedLoop<Q2dSim, Controllers>>;

const std::string& joint(Random& random) { return random.one_in(2) ? shoulder : elbow; }

/// A number that is often out of range, and sometimes none.
double number(Random& random, double size) {
  if (random.one_in(50)) return support::not_a_number;
  if (random.one_in(50)) return std::numeric_limits<double>::infinity();
  return random.number(-size, size);
}

PlayTrajectory trajectory(Random& random) {
  PlayTrajectory play;
  play.trajectory.joint_names = {joint(random)};
  if (random.one_in(2)) play.trajectory.joint_names = {shoulder, elbow};
  double time = 0;
  for (int k = random.integer(0, 3); k >= 0; --k) {
    time += random.number(0.05, 1.5);
    NamedTrajectoryPoint point{.time_from_start = time};
    for (const auto& name : play.trajectory.joint_names) {
      static_cast<void>(name);
      point.positions.push_back(number(random, 1.6));
      point.velocities.push_back(k == 0 ? 0 : random.number(-0.5, 0.5));
    }
    play.trajectory.points.push_back(point);
  }
  return play;
}

/// Any request that does not ask for a jump.
Request smooth_request(Random& random) {
  switch (random.integer(0, 14)) {
    case 0:
    case 1:
    case 2:
    case 3:
      return Go{{{joint(random), number(random, 1.7)}}, random.number(0, 1.05)};
    case 4:
      return Go{{{shoulder, number(random, 1.6)}, {elbow, number(random, 1.6)}}};
    case 5:
    case 6:
      return trajectory(random);
    case 7:
      return random.one_in(2) ? Stop{} : Stop{{joint(random)}};
    case 8: {
      const std::string name = "pid_plus_gravity." + joint(random);
      return SetParameters{{{name + ".p", number(random, 2000)}, {name + ".d", number(random, 5)}}};
    }
    case 9:
      return SwitchControllers{.start = {random.one_in(2) ? "computed_torque" : "pid_plus_gravity"},
                               .replace = true};
    case 10:
      return SetSpeed{random.number(0.5, 3)};
    case 11:
      return Pull{"tool_link", {}, {number(random, 5), number(random, 5), 0}};
    case 12:
      if (random.one_in(2)) return SetTrajectorySpeed{random.number(-0.1, 1.1)};
      return Step{random.integer(-1, 5)};
    case 13:
      return Pause{random.one_in(3)};
    default:
      return PlaySignals{{{joint(random), ChirpSignal{random.number(-0.1, 0.1), 0.2, 1, 2}}},
                         random.number(-0.1, 2)};
  }
}

/// A request that may make the reference jump, or stop the loop.
Request any_request(Random& random) {
  switch (random.integer(0, 7)) {
    case 0:
      return SetReference{{{joint(random), number(random, 1.6)}},
                          {{joint(random), number(random, 2.5)}},
                          {{joint(random), number(random, 10)}}};
    case 1:
      return PlaySignals{{{joint(random), StepSignal{number(random, 0.3), random.number(0, 0.1)}},
                          {joint(random), SineSignal{random.number(0, 0.3), random.number(0, 3)}}},
                         random.number(0, 0.3)};
    case 2:
      return Reset{{{joint(random), number(random, 1.6)}}};
    case 3:
      return Deactivate{};
    case 4:
      return AcknowledgeFault{};
    case 5:
      return Activate{};
    default:
      return smooth_request(random);
  }
}

const JointRange<2> range = joint_range(Q2d());

/// Whether position and velocity of the reference are finite and within the robot's limits.
bool within_limits(const JointReference<2>& reference) {
  bool within = is_finite(reference);
  for (int j = 0; j < 2; ++j) {
    const double most = model_of(Q2d()).joints[j].limits.velocity * (1 + 1e-9);
    within = within && reference.position[j] >= range.lower[j] &&
             reference.position[j] <= range.upper[j] && std::abs(reference.velocity[j]) <= most;
  }
  return within;
}

}  // namespace

TEST_CASE("10^4 requests at random times do not make the reference jump") {
  Arm arm;
  REQUIRE(arm.ask(Activate{}).verdict == support::Verdict::done);
  // The Q2D's damping is too strong for the tool to run away from a pull; its controllers keep up.
  const auto most = joint_values(Q2d(), [](const auto& joint) { return joint.limits.velocity; });
  Random random(1);
  const auto& reference = std::as_const(arm.loop).reference();
  JointReference<2> before = reference;
  int bad = 0, jumps = 0, done = 0, others = 0;
  for (int k = 0; k < 10000; ++k) {
    CAPTURE(k);
    arm.session->ask(smooth_request(random));
    for (int c = random.integer(0, 40); c >= 0; --c) {
      const double time = arm.loop.time();
      arm.cycles(1);
      const double passed = arm.loop.time() - time;
      if (!within_limits(reference)) ++bad;
      for (int j = 0; j < 2; ++j) {
        // Trajectories between points may accelerate harder than profiles: 2 limits in 1 ms at
        // most.
        const double step = std::abs(reference.position[j] - before.position[j]);
        if (step > most[j] * passed * (1 + 1e-6) + 1e-9) ++jumps;
      }
      before = reference;
    }
    while (const auto answer = arm.session->answer()) {
      ++(answer->verdict == support::Verdict::done ? done : others);
      CHECK(answer->verdict != support::Verdict::timed_out);
    }
  }
  CHECK(bad == 0);
  CHECK(jumps == 0);
  CHECK(arm.loop.mode() == LoopMode::active);
  CHECK(done > 3000);
  CHECK(others > 1000);
}

TEST_CASE("a motion under the limits of jerk stays smooth when others replace it") {
  Arm arm;
  REQUIRE(arm.ask(Activate{}).verdict == support::Verdict::done);
  const MotionLimits<2> limits = default_motion_limits(Q2d());
  Random random(2);
  const auto& reference = std::as_const(arm.loop).reference();
  JointReference<2> before = reference;
  int harsh = 0;
  for (int k = 0; k < 2000; ++k) {
    if (random.one_in(5)) {
      arm.session->ask(Stop{});
    } else {
      arm.session->ask(Go{{{joint(random), random.number(-1.5, 1.5)}}, random.number(0.2, 1)});
    }
    for (int c = random.integer(0, 300); c >= 0; --c) {
      arm.cycles(1);
      for (int j = 0; j < 2; ++j) {
        const double change = std::abs(reference.velocity[j] - before.velocity[j]);
        if (change > limits.acceleration[j] * arm.loop.period() * (1 + 1e-6)) ++harsh;
      }
      before = reference;
    }
    while (arm.session->answer()) {
    }
  }
  CHECK(harsh == 0);
}

TEST_CASE("any requests leave the reference within the limits, and each has its answer") {
  Arm arm;
  Random random(3);
  std::uint64_t asked = 0, answered = 0;
  int bad = 0;
  for (int k = 0; k < 10000; ++k) {
    asked = arm.session->ask(any_request(random));
    for (int c = random.integer(0, 20); c >= 0; --c) {
      arm.cycles(1);
      if (arm.loop.mode() == LoopMode::active &&
          !within_limits(std::as_const(arm.loop).reference())) {
        ++bad;
      }
    }
    while (arm.session->answer()) ++answered;
  }
  arm.session->ask(Pause{false});
  arm.session->ask(SetSpeed{1});
  arm.cycles(10000);
  while (arm.session->answer()) ++answered;
  CHECK(bad == 0);
  CHECK(answered == asked + 2);
}

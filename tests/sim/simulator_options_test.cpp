// SPDX-License-Identifier: Apache-2.0
#include <articula/sim/simulator.hpp>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "catch.hpp"
#include "numbers.hpp"
#include "robots/test_robots.hpp"

using namespace articula;
using Catch::Matchers::Contains;
using support::infinity;
using support::not_a_number;

namespace {

using Options = SimulatorOptions<2>;

struct BadOption {
  std::function<void(Options&)> spoil;
  std::vector<std::string> message;  // what it must contain
};

const std::string shoulder = "'shoulder_active_joint'", elbow = "'elbow_active_joint'";

std::string refusal(const Model<1>& robot, const SimulatorOptions<1>& options) {
  try {
    validate(robot, options);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

/// How many sub-steps a message asks for; 0 if for none.
int substeps_in(const std::string& message) {
  const std::string words = "at least ";
  const auto place = message.find(words);
  return place == std::string::npos
             ? 0
             : static_cast<int>(std::stod(message.substr(place + words.size())));
}

}  // namespace

TEST_CASE("the defaults are accepted") { CHECK_NOTHROW(validate(Q2d(), Options())); }

TEST_CASE("bad options are refused, naming option, joint, value and limit") {
  const std::vector<BadOption> bad_options{
      {[](Options& o) { o.period = 0; }, {"period", "0"}},
      {[](Options& o) { o.period = -1e-3; }, {"period", "-0.001"}},
      {[](Options& o) { o.period = not_a_number; }, {"period", "nan"}},
      {[](Options& o) { o.period = infinity; }, {"period", "inf"}},
      {[](Options& o) { o.substeps = 0; }, {"substeps", "0", "1"}},
      {[](Options& o) { o.substeps = -7; }, {"substeps", "-7", "1"}},
      {[](Options& o) { o.drives = DriveModel(7); }, {"drives", "7", "servo", "ideal"}},
      {[](Options& o) { o.initial_position = {0, 1.6}; },
       {"initial_position", "1.6", elbow, "-1.57", "1.57"}},
      {[](Options& o) { o.initial_position = {-1.6, 0}; },
       {"initial_position", "-1.6", shoulder, "-1.57", "1.57"}},
      {[](Options& o) { o.initial_position = {not_a_number, 0}; },
       {"initial_position", "nan", shoulder}},
      {[](Options& o) { o.initial_velocity[1] = -infinity; }, {"initial_velocity", "-inf", elbow}},
      {[](Options& o) { o.initial_velocity[0] = not_a_number; },
       {"initial_velocity", "nan", shoulder}},
      {[](Options& o) { o.servo_bandwidth[0] = 0; }, {"servo_bandwidth", "0", shoulder}},
      {[](Options& o) { o.servo_bandwidth[1] = -50; }, {"servo_bandwidth", "-50", elbow}},
      {[](Options& o) { o.servo_bandwidth[1] = not_a_number; }, {"servo_bandwidth", "nan", elbow}},
      {[](Options& o) { o.servo_bandwidth[0] = 1e9; },
       {"servo_bandwidth", "1e+09", shoulder, "at most 2e+08"}},
      {[](Options& o) { o.encoder_resolution[0] = -1e-5; },
       {"encoder_resolution", "-1e-05", shoulder}},
      {[](Options& o) { o.encoder_resolution[0] = 4096; },
       {"encoder_resolution", "4096", shoulder, "more than its range", "not a number of lines"}},
      {[](Options& o) { o.encoder_resolution[1] = infinity; },
       {"encoder_resolution", "inf", elbow}},
      {[](Options& o) { o.position_noise[0] = not_a_number; }, {"position_noise", "nan", shoulder}},
      {[](Options& o) { o.position_noise[1] = -2; }, {"position_noise", "-2", elbow}},
      {[](Options& o) { o.velocity_noise[0] = -0.5; }, {"velocity_noise", "-0.5", shoulder}},
      {[](Options& o) { o.velocity_noise[1] = infinity; }, {"velocity_noise", "inf", elbow}},
      {[](Options& o) { o.effort_noise[1] = -0.25; }, {"effort_noise", "-0.25", elbow}},
      {[](Options& o) { o.effort_noise[0] = not_a_number; }, {"effort_noise", "nan", shoulder}},
  };
  for (const BadOption& bad : bad_options) {
    CAPTURE(bad.message);
    Options options;
    bad.spoil(options);
    CHECK_THROWS_AS(Q2dSim(options), std::invalid_argument);
    CHECK_THROWS_AS(Simulator<Model<2>>(support::model<Q2d>(), options), std::invalid_argument);
    for (const std::string& part : bad.message) CHECK_THROWS_WITH(Q2dSim(options), Contains(part));
  }
}

TEST_CASE("servos make as many steps as their bandwidth needs, and no fewer than asked for") {
  Options options{.period = 0.01, .substeps = 2};
  CHECK(servo_substeps(options) == 5);  // of 2 ms, for 100 rad/s
  options.servo_bandwidth = {1, 1000};
  CHECK(servo_substeps(options) == 50);
  options.servo_bandwidth = {1, 1};
  CHECK(servo_substeps(options) == 2);
}

TEST_CASE("the limits themselves are a good start") {
  const double limit = Q2d::description.joints[1].limits.upper;
  Options options;
  options.initial_position = {limit, -limit};
  CHECK_NOTHROW(Q2dSim(options));
  options.initial_position = {std::nextafter(limit, 2), 0};
  CHECK_THROWS_AS(Q2dSim(options), std::invalid_argument);
}

TEST_CASE("a joint without inertia is refused") {
  Model<1> turntable = support::single_joint(JointType::continuous);
  turntable.canonical.bodies[0].inertia.moment = {};
  const std::string message = refusal(turntable, {});
  CHECK_THAT(message, Contains("singular") && Contains("'joint'"));
}

TEST_CASE("damping too strong for the step is refused, and accepted with the sub-steps asked for") {
  for (const double damping : {1e4, 3.3e4, 1e6, 7.7e8, 1.114001e10}) {
    CAPTURE(damping);
    Model<1> robot = support::slider();
    robot.joints[0].damping = damping;
    SimulatorOptions<1> options{.period = 1e-3};
    options.initial_velocity.setConstant(1);
    const std::string message = refusal(robot, options);
    CAPTURE(message);
    const int needed = substeps_in(message);
    REQUIRE(needed > 1);
    CHECK_THAT(message, Contains("damping") && Contains("instead of 1"));
    options.substeps = needed;
    CHECK(refusal(robot, options) == "");
    if (needed < 1000000) {  // what the six digits of the message can tell apart
      options.substeps = needed - 1;
      CHECK(refusal(robot, options) != "");
    }
  }
}

TEST_CASE("with the sub-steps asked for, strong damping decays") {
  Model<1> robot = support::slider();
  robot.joints[0].damping = 1e6;
  SimulatorOptions<1> options{.period = 1e-3};
  options.initial_velocity.setConstant(1);
  options.substeps = substeps_in(refusal(robot, options));
  Simulator<Model<1>> simulator(robot, options);
  double speed = 1;
  for (int k = 0; k < 10; ++k) {
    static_cast<void>(simulator.write({}));
    const double now = simulator.true_state().velocity[0];
    CHECK(now >= 0);
    CHECK(now <= 0.7 * speed);
    speed = now;
  }
}

// Two rails at an angle whose joints feel the same mass and damping: moving together they decay
// slowly, moving against each other fast. Starting the search for the fastest decay with all joints
// moving together must not hide that.
TEST_CASE("the fastest decay of coupled joints is found, in whichever direction they move") {
  for (const double along : {0.5, 0.75, 0.875, -0.5, -0.875}) {
    CAPTURE(along);
    using articula::Joint;
    Model<2> robot = support::Blueprint{
        .name = "rails",
        .gravity = {},
        .links = {{.name = "stand"},
                  {.name = "carriage"},
                  {.name = "body", .mass = 1, .inertia = {.xx = 1, .yy = 1, .zz = 1}}},
        .joints = {
            {.name = "one",
             .type = JointType::prismatic,
             .parent = "stand",
             .child = "carriage",
             .axis = {0, 0, 1},
             .damping = 1},
            {.name = "two",
             .type = JointType::prismatic,
             .parent = "carriage",
             .child = "body",
             .axis = {std::sqrt(1 - along * along), 0, along},
             .damping =
                 1}}}.model<2>();
    // M = [1 along; along 1], so the decays are 1 / (1 + along) and 1 / (1 - along).
    const double fastest = 1 / (1 - std::abs(along));
    SimulatorOptions<2> options{.period = 0.99 * 2.785 / fastest};  // just stable
    CHECK_THROWS_AS(validate(robot, options), std::invalid_argument);
  }
}

TEST_CASE("damping that no number of sub-steps can follow is refused, up to the largest number") {
  for (const double damping : {1e20, 1e153, 1e155, 1e200, support::largest}) {
    CAPTURE(damping);
    Model<2> robot = support::model<Q2d>();
    robot.joints[0].damping = damping;
    CHECK_THROWS_AS(validate(robot, SimulatorOptions<2>()), std::invalid_argument);
    CHECK_THROWS_WITH(
        validate(robot, SimulatorOptions<2>()),
        Catch::Matchers::Contains("damping") && !Catch::Matchers::Contains("substeps"));
  }
}

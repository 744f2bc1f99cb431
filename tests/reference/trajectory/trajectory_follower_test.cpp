// SPDX-License-Identifier: Apache-2.0
#include <articula/control/pid_plus_gravity.hpp>
#include <articula/loop/loop.hpp>
#include <articula/reference/reference_generator.hpp>
#include <articula/reference/trajectory/named_trajectory.hpp>
#include <articula/reference/trajectory/trajectory_follower.hpp>
#include <articula/robots/q2d.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "catch.hpp"
#include "numbers.hpp"
#include "random.hpp"
#include "robots/test_robots.hpp"

using namespace articula;
using Catch::Matchers::Contains;
using support::infinity;
using support::not_a_number;
using enum TrajectoryOutcome;

namespace {

using Vector = JointVector<2>;
using Follower = TrajectoryFollower<Q2d>;
using Points = Trajectory<Q2d>;
static_assert(ReferenceGenerator<Follower, 2>);

const MotionLimits<2> limits{{2, 10}, {20, 50}, {400, 1000}};
const Vector zero = Vector::Zero();
constexpr double h = 1e-3;

/// From (0, 0) to (-1, 1) in 2 s, by way of (-0.5, 0.5).
const Points there({{.time_from_start = 1, .position = {-0.5, 0.5}, .velocity = Vector(-0.8, 0.8)},
                    {.time_from_start = 2, .position = {-1, 1}, .velocity = zero}});
/// The same way in straight lines.
const Points straight({{.time_from_start = 1, .position = {-0.5, 0.5}},
                       {.time_from_start = 2, .position = {-1, 1}}});

/// The joints as they are asked to be.
JointState<2> obedient(const Follower& follower) {
  return {follower.reference().position, follower.reference().velocity};
}

/// Samples up to a time with joints that obey; returns the time.
double run(Follower& follower, double from, double to) {
  double t = from;
  static_cast<void>(follower.sample(t));
  for (long k = 1; t < to; ++k) {
    t = from + static_cast<double>(k) * h;
    static_cast<void>(follower.sample(t));
    follower.check(obedient(follower));
  }
  return t;
}

/// Checks that position and velocity go on without a jump from one sample to the next.
class JumpDetector {
 public:
  /// @param acceleration  the highest there is
  JumpDetector(const JointReference<2>& start, double acceleration)
      : last_(start), acceleration_(acceleration) {}

  void check(const JointReference<2>& now) {
    const Vector v_step = now.velocity - last_.velocity;
    const Vector q_error = now.position - last_.position - h * (now.velocity + last_.velocity) / 2;
    // the trapezoidal rule with a bounded acceleration
    const bool smooth = v_step.cwiseAbs().maxCoeff() <= acceleration_ * h &&
                        q_error.cwiseAbs().maxCoeff() <= acceleration_ * h * h / 2;
    if (!smooth) {
      FAIL("from " << last_.position.transpose() << " to " << now.position.transpose()
                   << ", velocity from " << last_.velocity.transpose() << " to "
                   << now.velocity.transpose());
    }
    last_ = now;
  }

 private:
  JointReference<2> last_;
  double acceleration_;
};

}  // namespace

TEST_CASE("it rests where it was made, before and after the clock starts") {
  Follower follower({0.1, 0.2}, limits);
  CHECK(follower.outcome() == idle);
  CHECK(follower.sample(5).position == Vector(0.1, 0.2));
  CHECK(follower.sample(6).velocity.isZero(0));
  follower.cancel();
  CHECK(follower.check(obedient(follower)) == idle);
}

TEST_CASE("from rest it is what the interpolation says, and it ends in success") {
  Follower follower(zero, limits);
  REQUIRE(follower.start(there) == active);
  CHECK(follower.sample(7).position == zero);  // the first sample sets the clock
  const TrajectoryPoint<2> start{.velocity = zero};
  for (int k = 1; k < 1000; ++k) {
    const auto r = follower.sample(7 + k * h);
    const auto expected = interpolate(start, there.points()[0], k * h);
    REQUIRE((r.position - expected.position).norm() < 1e-12);
    REQUIRE((r.velocity - expected.velocity).norm() < 1e-11);
    REQUIRE(follower.check(obedient(follower)) == active);
  }
  run(follower, 8, 8.999);
  CHECK(follower.outcome() == active);
  run(follower, 8.999, 9.001);
  CHECK(follower.outcome() == successful);
  CHECK(follower.reference().position == Vector(-1, 1));
  CHECK(follower.reference().velocity.isZero(0));
  run(follower, 9.001, 10);
  CHECK(follower.reference().position == Vector(-1, 1));
}

TEST_CASE("a trajectory that starts at rest does not care how long nobody has sampled") {
  Follower follower(zero, limits);
  static_cast<void>(follower.sample(0));
  REQUIRE(follower.start(there) == active);
  CHECK(follower.check(obedient(follower)) == active);
  CHECK(follower.sample(100).position == zero);
  CHECK(follower.sample(100 + h).position.norm() < 1e-5);
  CHECK(follower.check(obedient(follower)) == active);
}

TEST_CASE("a joint that leaves its path tolerance ends it, and is not pushed on") {
  for (const bool by_velocity : {false, true}) {
    CAPTURE(by_velocity);
    TrajectoryTolerances<2> tolerances;
    (by_velocity ? tolerances.path_velocity : tolerances.path_position)[1] = 0.1;
    Follower follower(zero, limits, {.tolerances = tolerances});
    REQUIRE(follower.start(there) == active);
    double t = run(follower, 0, 0.7);
    JointState<2> state = obedient(follower);
    state.position[0] += 9;  // no tolerance is set for it
    state.velocity[0] += 9;
    double& measured = (by_velocity ? state.velocity : state.position)[1];
    measured -= 0.09;
    CHECK(follower.check(state) == active);
    measured -= 0.02;
    state.position[0] = follower.reference().position[0];
    JumpDetector detector(follower.reference(), 60);
    CHECK(follower.check(state) == path_tolerance_violated);
    const Vector held = state.position;
    for (int k = 1; k < 1000; ++k) detector.check(follower.sample(t + k * h));
    CHECK((follower.reference().position - held).norm() < 1e-12);
    CHECK(follower.reference().velocity.isZero(0));
    CHECK(follower.check(state) == path_tolerance_violated);
  }
}

TEST_CASE("after an abort the way back is nobody's, and the next trajectory is free of it") {
  Follower follower(zero, limits, {.tolerances = {.path_position = {0.1, 0.1}}});
  REQUIRE(follower.start(there) == active);
  run(follower, 0, 0.7);
  JointState<2> state = obedient(follower);
  state.position[1] -= 0.3;
  CHECK(follower.check(state) == path_tolerance_violated);
  REQUIRE(follower.start(there, {.path_position = {0.1, 0.1}}, 2) == active);
  static_cast<void>(follower.sample(0.701));
  CHECK(follower.check(state) == active);
  run(follower, 0.701, 4.002);
  CHECK(follower.outcome() == successful);
}

TEST_CASE("NaN is out of tolerance") {
  Follower follower(zero, limits, {.tolerances = {.path_position = {0.1, 0.1}}});
  REQUIRE(follower.start(there) == active);
  run(follower, 0, 0.5);
  JointState<2> state = obedient(follower);
  state.position[1] = not_a_number;
  CHECK(follower.check(state) == path_tolerance_violated);
  run(follower, 0.5, 1.5);
  CHECK(is_finite(follower.reference()));
  CHECK(follower.reference().velocity.isZero(0));
}

TEST_CASE("the goal waits for the joints, for goal_time at most") {
  for (const double goal_time : {0.0, 0.5}) {
    CAPTURE(goal_time);
    TrajectoryTolerances<2> tolerances{.goal_position = {0.01, 0.01}, .goal_time = goal_time};
    Follower follower(zero, limits, {.tolerances = tolerances});
    REQUIRE(follower.start(there) == active);
    static_cast<void>(follower.sample(0));
    JointState<2> state{{-1, 0.98}, zero};
    int k = 1;
    for (; k <= 2499; ++k) {
      static_cast<void>(follower.sample(k * h));
      REQUIRE(follower.check(state) == active);
    }
    SECTION("arrives") {
      state.position[1] = 0.991;
      state.velocity[1] = 0.02;  // still moves
      CHECK(follower.check(state) == active);
      state.velocity[1] = 0.009;
      CHECK(follower.check(state) == successful);
    }
    SECTION("does not arrive") {
      for (; k <= 4000; ++k) {
        static_cast<void>(follower.sample(k * h));
        follower.check(state);
      }
      CHECK(follower.outcome() == (goal_time > 0 ? goal_tolerance_violated : active));
      // where it was measured, or still asked to go where it should be
      CHECK(follower.reference().position[1] == Approx(goal_time > 0 ? 0.98 : 1).epsilon(1e-12));
    }
  }
}

TEST_CASE("canceled, it stops from the command within the limits and holds") {
  for (const auto& trajectory : {there, straight}) {
    Follower follower(zero, limits);
    REQUIRE(follower.start(trajectory) == active);
    run(follower, 0, 1.3);
    const auto before = follower.reference();
    JumpDetector detector(before, 51);
    follower.cancel();
    CHECK(follower.outcome() == canceled);
    for (int k = 1; k < 500; ++k) {
      const auto r = follower.sample(1.3 + k * h);
      detector.check(r);
      REQUIRE(std::abs(r.acceleration[0]) <= 20);
      REQUIRE(std::abs(r.acceleration[1]) <= 50);
      REQUIRE((r.position - before.position).norm() < 0.2);
    }
    CHECK(follower.reference().velocity.isZero(0));
    follower.cancel();
    CHECK(follower.outcome() == canceled);
  }
}

TEST_CASE("the effort of the points goes on through stops, ways back and replacement") {
  const Vector weight(3, 4);
  const Points loaded({{.time_from_start = 2, .position = {-1, 1}, .effort = weight}});
  Follower follower(zero, limits, {.tolerances = {.path_position = {0.1, 0.1}}});
  REQUIRE(follower.start(loaded) == active);
  run(follower, 0, 1);
  CHECK((follower.reference().effort - weight / 2).norm() < 1e-9);
  JointState<2> blocked = obedient(follower);
  blocked.position[0] += 0.2;
  CHECK(follower.check(blocked) == path_tolerance_violated);
  run(follower, 1, 2);
  CHECK((follower.reference().effort - weight / 2).norm() < 1e-9);
  REQUIRE(follower.start(Points({{.time_from_start = 1, .position = zero}})) == active);
  run(follower, 2, 2.5);
  CHECK((follower.reference().effort - weight / 4).norm() < 1e-3);
}

TEST_CASE("a replacement leads on from what is asked for at the time") {
  for (const auto& first : {there, straight}) {
    Follower follower(zero, limits);
    REQUIRE(follower.start(first) == active);
    run(follower, 0, 0.8);
    JumpDetector detector(follower.reference(), 21);
    const Points back({{.time_from_start = 0.5, .position = {-0.3, 0.3}},
                       {.time_from_start = 1, .position = {0, 0}}});
    REQUIRE(follower.start(back) == active);
    for (int k = 1; k <= 999; ++k) detector.check(follower.sample(0.8 + k * h));
    // from the first point on it is the new trajectory
    CHECK((follower.reference().position - back.sample(0.999).position).norm() < 1e-12);
    run(follower, 1.799, 1.802);
    CHECK(follower.outcome() == successful);
  }
}

TEST_CASE("one that starts later lets what is followed go on until then") {
  Follower follower(zero, limits), undisturbed(zero, limits);
  REQUIRE(follower.start(there) == active);
  REQUIRE(undisturbed.start(there) == active);
  run(follower, 0, 0.5);
  run(undisturbed, 0, 0.5);
  const Points back({{.time_from_start = 1, .position = {0, 0}, .velocity = zero}});
  REQUIRE(follower.start(back, {}, 0.9005) == active);
  for (int k = 501; k <= 900; ++k) {
    REQUIRE(follower.sample(k * h).position == undisturbed.sample(k * h).position);
  }
  run(follower, 0.9, 1.9);
  CHECK(follower.outcome() == active);
  run(follower, 1.9, 1.902);
  CHECK(follower.outcome() == successful);
  CHECK(follower.reference().position == zero);
}

namespace {

/// A goal for one joint of the Q2D: to be at a position at a time.
Points partial(const char* joint, double position, double time, const JointReference<2>& from) {
  return arrange(Q2d(),
                 {{joint}, {{.time_from_start = time, .positions = {position}, .velocities = {0}}}},
                 {.allow_partial_joints = true, .from = from});
}

}  // namespace

TEST_CASE("joints that a goal leaves out go on along the trajectory that they follow") {
  for (const double start : {Follower::now, 0.9005}) {
    for (const double speed : {1.0, 0.7}) {
      CAPTURE(start, speed);
      Follower follower(zero, limits), undisturbed(zero, limits);
      for (Follower* each : {&follower, &undisturbed}) {
        REQUIRE(each->start(there) == active);
        run(*each, 0, 0.3);
        each->set_speed(speed);
        run(*each, 0.3, 0.5);
      }
      const Points elbow = partial("elbow_active_joint", -0.4, 0.8, follower.reference());
      JumpDetector detector(follower.reference(), 60);
      REQUIRE(follower.start(elbow, {}, start) == active);
      for (int k = 501; k <= 4000; ++k) {
        const double t = k * h;
        const auto now = follower.sample(t), other = undisturbed.sample(t);
        detector.check(now);
        follower.check(obedient(follower));
        undisturbed.check(obedient(undisturbed));
        CAPTURE(t);
        // The time of the trajectory is summed up from another start: rounding, 4000 times.
        REQUIRE(std::abs(now.position[0] - other.position[0]) < 1e-12);
        REQUIRE(std::abs(now.velocity[0] - other.velocity[0]) < 1e-11);
        REQUIRE(follower.outcome() == undisturbed.outcome());  // the shoulder arrives last
      }
      CHECK(follower.outcome() == successful);
      CHECK(follower.reference().position == Vector(-1, -0.4));
    }
  }
}

TEST_CASE("goals for one joint after the other are followed at once, each to its end") {
  Follower follower(zero, limits), other(zero, limits);
  const auto goal = [](const char* joint, double position, double time) {
    return partial(joint, position, time, {});
  };
  REQUIRE(follower.start(goal("shoulder_active_joint", 1, 3)) == active);
  REQUIRE(other.start(goal("shoulder_active_joint", 1, 3)) == active);
  run(follower, 0, 0.5);
  run(other, 0, 0.5);
  JumpDetector detector(follower.reference(), 60);
  for (int k = 501; k <= 3600; ++k) {
    const double t = k * h;
    if (k == 600) REQUIRE(follower.start(goal("elbow_active_joint", 0.5, 1)) == active);
    if (k == 1200) REQUIRE(follower.start(goal("elbow_active_joint", -0.5, 1.2)) == active);
    const auto now = follower.sample(t);
    detector.check(now);
    REQUIRE(std::abs(now.position[0] - other.sample(t).position[0]) < 1e-12);
    follower.check(obedient(follower));
    // The elbow arrives after 2.399 s; the goal is reached when no joint moves any more.
    if (t < 2.998) CHECK(follower.outcome() == active);
  }
  CHECK(follower.outcome() == successful);
  CHECK(follower.reference().position == Vector(1, -0.5));
}

TEST_CASE("a joint that arrives rests while the other one goes on, and can be sent on") {
  Follower follower(zero, limits);
  REQUIRE(follower.start(Points({{.time_from_start = 0.5, .position = {0.2, 0.2}}})) == active);
  run(follower, 0, 0.4);
  REQUIRE(follower.start(partial("elbow_active_joint", 1, 2, follower.reference())) == active);
  double t = run(follower, 0.4, 1);
  CHECK(follower.reference().position[0] == Approx(0.2).margin(1e-2));  // a stop behind the line
  const double rests = follower.reference().position[0];
  CHECK(follower.reference().velocity[0] == 0);
  CHECK(follower.reference().velocity[1] > 0.1);
  REQUIRE(follower.start(partial("shoulder_active_joint", -0.5, 1, follower.reference())) ==
          active);
  t = run(follower, t, t + 0.01);
  CHECK(follower.reference().position[0] != rests);
  run(follower, t, 3);
  CHECK(follower.outcome() == successful);
  CHECK(follower.reference().position == Vector(-0.5, 1));
}

TEST_CASE("a stop goes on in the joints that the next goal leaves out") {
  Follower follower(zero, limits), undisturbed(zero, limits);
  for (Follower* each : {&follower, &undisturbed}) {
    REQUIRE(each->start(there, {.path_position = {0.1, 0.1}}) == active);
    run(*each, 0, 0.7);
    JointState<2> state = obedient(*each);
    state.position[0] += 0.2;
    CHECK(each->check(state) == path_tolerance_violated);
    run(*each, 0.7, 0.71);
  }
  REQUIRE(follower.start(partial("elbow_active_joint", 0, 1, follower.reference())) == active);
  JumpDetector detector(follower.reference(), 60);
  for (int k = 711; k <= 2500; ++k) {
    detector.check(follower.sample(k * h));
    static_cast<void>(undisturbed.sample(k * h));
    follower.check(obedient(follower));
  }
  CHECK(follower.outcome() == successful);
  CHECK(follower.reference().position[0] ==  // the stop of the rest of a stop: rounding
        Approx(undisturbed.reference().position[0]).margin(1e-12));
  CHECK(follower.reference().position[1] == 0);
}

TEST_CASE("one that waits while nothing is followed starts on time") {
  Follower follower(zero, limits);
  REQUIRE(follower.start(there, {}, 3) == active);
  run(follower, 0, 2.999);
  CHECK(follower.outcome() == active);
  CHECK(follower.reference().position == zero);
  run(follower, 2.999, 5.002);
  CHECK(follower.outcome() == successful);
}

TEST_CASE("points in the past are left out, and a trajectory of none but these is refused") {
  Follower follower(zero, limits);
  run(follower, 0, 10);
  REQUIRE(follower.start(there, {}, 8.9) == active);  // the first point was at 9.9
  run(follower, 10, 10.899);
  CHECK(follower.outcome() == active);
  run(follower, 10.899, 10.902);
  CHECK(follower.outcome() == successful);

  REQUIRE(follower.start(Points({{.time_from_start = 1, .position = zero}})) == active);
  run(follower, 10.902, 11.2);
  const auto before = follower.reference();
  CHECK(follower.start(there, {}, 8.9) == old_header_timestamp);
  CHECK(follower.start(Points({{.position = {0.5, 0.5}}})) == old_header_timestamp);
  CHECK(follower.outcome() == active);  // nothing has changed
  CHECK(follower.sample(11.2).position == before.position);
}

TEST_CASE("points that cannot be reached in time are left out, or refused") {
  Follower follower({-1, -1}, limits);
  CHECK(follower.start(Points({{.time_from_start = 0.1, .position = {1, 1}}})) == invalid_goal);
  CHECK(follower.outcome() == idle);
  REQUIRE(follower.start(Points({{.time_from_start = 0.1, .position = {0.9, 0.9}},
                                 {.time_from_start = 3, .position = {1, 1}}})) == active);
  static_cast<void>(follower.sample(0));
  CHECK(follower.sample(1.5).position.norm() < 1e-9);  // half way, in a straight line
}

TEST_CASE("a refusal says which figure of which joint breaks which rule") {
  Follower follower(zero, limits);
  const auto why = [&] { return to_string(Q2d(), follower.refusal()); };
  CHECK(why().empty());

  CHECK(follower.start(there, {.path_velocity = {0, -1}}) == invalid_goal);
  CHECK(follower.refusal().what == "path_velocity");
  CHECK(follower.refusal().joint == 1);
  CHECK(follower.refusal().value == -1);
  CHECK(follower.refusal().rule == "is not a number >= 0");
  CHECK(why() == "path_velocity -1 of joint 'elbow_active_joint' is not a number >= 0");
  CHECK(follower.start(there, {.goal_time = -5}) == invalid_goal);
  CHECK(why() == "goal_time -5 is not a number >= 0");
  CHECK(follower.start(there, {}, infinity) == invalid_goal);
  CHECK(why() == "start_time inf is not a finite number");

  CHECK(follower.start(there) == active);
  CHECK(why().empty());
  run(follower, 0, 3);
  CHECK(follower.start(there, {}, 0.5) == old_header_timestamp);
  CHECK(why() == "the last point's time_from_start 2 has passed");

  // At (-1, 1) now, and 0.1 s are not enough: the shoulder would need 10 m/s, and has 2.
  const Points near({{.time_from_start = 0.1, .position = {0, 0.9}}});
  CHECK(follower.start(near) == invalid_goal);
  CHECK(why() ==
        "before the last point the mean velocity 10 of joint 'shoulder_active_joint' is "
        "above its limit 2");

  // In motion there is a trajectory that the mean velocity lets through, but not the acceleration.
  REQUIRE(follower.start(Points({{.time_from_start = 1, .position = {0.5, 1}}})) == active);
  run(follower, 3, 3.5);
  const Points back({{.time_from_start = 0.2, .position = {-0.5, 1}}});
  CHECK(follower.start(back) == invalid_goal);
  CHECK(follower.refusal().joint == 0);
  CHECK_THAT(why(), Contains("before the last point") && Contains("is above its limit"));
  CHECK(follower.refusal().value > follower.refusal().limit);
  follower.cancel();
  CHECK(!why().empty());  // until the next start

  // One that waits and cannot begin says why when it is due.
  const Points far({{.time_from_start = 0.1, .position = {-1, 1}}});
  REQUIRE(follower.start(far, {}, 10) == active);
  CHECK(why().empty());
  run(follower, 3.5, 11);
  CHECK(follower.outcome() == invalid_goal);
  CHECK(follower.refusal().joint == 0);
  CHECK_THAT(why(), Contains("mean velocity"));
}

TEST_CASE("start times and tolerances that are no numbers are refused") {
  Follower follower(zero, limits);
  CHECK(follower.start(there, {}, not_a_number) == invalid_goal);
  CHECK(follower.start(there, {}, infinity) == invalid_goal);
  for (const double bad : {-0.1, infinity, not_a_number}) {
    CHECK(follower.start(there, {.path_position = {0, bad}}) == invalid_goal);
    CHECK(follower.start(there, {.goal_time = bad}) == invalid_goal);
    CHECK_THROWS_WITH(Follower(zero, limits, {.tolerances = {.goal_position = {0, bad}}}),
                      Contains("goal_position") && Contains("'elbow_active_joint'"));
  }
  CHECK_THROWS_WITH(Follower({0, not_a_number}, limits), Contains("'elbow_active_joint'"));
  CHECK_THROWS_WITH(Follower(zero, {}), Contains("'shoulder_active_joint'"));
  CHECK(follower.outcome() == idle);
}

TEST_CASE("a clock that fails stands still") {
  Follower follower(zero, limits);
  REQUIRE(follower.start(there) == active);
  const double t = run(follower, 0, 0.5);
  const Vector before = follower.reference().position;
  for (const double bad : {not_a_number, infinity, -infinity, t - 0.2}) {
    CHECK(follower.sample(bad).position == before);
  }
  CHECK((follower.sample(t - 0.2 + h).position - before).norm() < 0.002);  // goes on from there
}

TEST_CASE("tolerances of a goal override those that are set, as in ROS") {
  const TrajectoryTolerances<2> set{.path_position = {1, 2}, .goal_time = 3};
  const auto t = overridden(set, {.path_position = {0, -1}, .goal_position = {4, 0}});
  CHECK(t.path_position == Vector(1, 0));
  CHECK(t.goal_position == Vector(4, 0));
  CHECK(t.goal_time == 3);
  CHECK(refusal_of(overridden(set, {.path_position = {-2, 0}})).what == "path_position");
}

TEST_CASE("a last point that moves is followed by a stop") {
  const Points moving({{.time_from_start = 1, .position = {-0.5, 0.5}, .velocity = Vector(-1, 1)}},
                      {.allow_motion_at_end = true});
  Follower follower(zero, limits);
  REQUIRE(follower.start(moving) == active);
  run(follower, 0, 0.99);
  JumpDetector detector(follower.reference(), 51);
  for (int k = 991; k < 1500; ++k) {
    detector.check(follower.sample(k * h));
    follower.check(obedient(follower));
  }
  CHECK(follower.outcome() == successful);
  CHECK(follower.reference().position[0] < -0.51);
}

TEST_CASE("a last point with an acceleration is held, however slowly that could fade") {
  for (const double jerk : {20.0, 100.0, 400.0}) {
    for (const double a : {-15.0, -4.0, 30.0}) {
      for (const double v : {0.0, 1e-7}) {  // as good as none, as a file may have it
        CAPTURE(jerk, a, v);
        const Points points({{.time_from_start = 2, .position = {1, 0.5}, .velocity = zero},
                             {.time_from_start = 3,
                              .position = {1.4, 0},
                              .velocity = Vector(v, 0),
                              .acceleration = Vector(a, -a)}});
        Follower follower(zero, {{2, 10}, {20, 50}, {jerk, jerk}});
        REQUIRE(follower.start(points) == active);
        run(follower, 0, 3.001);
        CHECK(follower.outcome() == successful);
        for (const double t : {3.001, 3.1, 5.0}) {
          const auto r = follower.sample(t);
          CHECK(r.position == Vector(1.4, 0));
          CHECK(r.velocity.isZero(0));
          CHECK(r.acceleration.isZero(0));
        }
      }
    }
  }
}

TEST_CASE("a stop that would lead beyond the joint's limits is harder, and ends there") {
  const double limit = std::numbers::pi / 2;
  const MotionLimits<2> soft{{2, 10}, {2, 2}, {20, 20}};
  const auto check = [&](Follower& follower, double t, double highest) {
    JumpDetector detector(follower.reference(), highest);
    for (int k = 1; k < 9000; ++k) {
      detector.check(follower.sample(t + k * h));
      follower.check(obedient(follower));
      REQUIRE(follower.reference().position[0] <= limit);
    }
    // It is no harder than it has to be: the search leaves 0.2 % of the way at most.
    CHECK(follower.reference().position[0] > limit - 2e-3);
    CHECK(follower.reference().velocity.isZero(0));
  };
  SECTION("canceled") {
    const Points points({{.time_from_start = 3, .position = {-1.5, 0}, .velocity = zero},
                         {.time_from_start = 4.5, .position = {1.5, 0}, .velocity = zero}});
    Follower follower(zero, soft);
    REQUIRE(follower.start(points) == active);
    const double t = run(follower, 0, 3.9);
    const auto from = follower.reference();
    const double way = limit - from.position[0], v = from.velocity[0];
    REQUIRE(v * v / 2 / way > soft.acceleration[0]);
    follower.cancel();
    check(follower, t,
          v * v / way + 9);  // where the deceleration is a triangle, the highest there is
    CHECK(follower.outcome() == canceled);
  }
  SECTION("at the end of a trajectory that moves there") {
    const Points points({{.time_from_start = 3, .position = {1, 0}, .velocity = Vector(1.5, 0)}},
                        {.allow_motion_at_end = true});
    Follower follower(zero, soft);
    REQUIRE(follower.start(points) == active);
    check(follower, run(follower, 0, 2.9), 1.5 * 1.5 / (limit - 1) + 1);
    CHECK(follower.outcome() == successful);
  }
  SECTION("where it was outside before, it stays") {
    Follower follower({limit + 0.1, 0}, soft);
    const Points back({{.time_from_start = 4, .position = {1, 0}, .velocity = zero}});
    REQUIRE(follower.start(back) == active);
    const double t = run(follower, 0, 0.01);
    const double before = follower.reference().position[0];
    follower.cancel();
    run(follower, t, t + 5);
    CHECK(follower.reference().position[0] == Approx(before).margin(1e-3));
    CHECK(before > limit + 0.09);
  }
}

// Straight lines may have a velocity up to the very limit, and there is no stop then: the velocity
// ends where the line does. What else there is, is slower the nearer it comes.
TEST_CASE("whatever is done to it at random, no limit of a position is passed") {
  constexpr unsigned seed = 21;
  CAPTURE(seed);
  support::Random random(seed);
  const auto joints = model_of(Q2d()).joints;
  const auto lower = joint_values(Q2d(), [](const auto& joint) { return joint.limits.lower; });
  const auto upper = joint_values(Q2d(), [](const auto& joint) { return joint.limits.upper; });
  int refused = 0, started = 0, canceled_there = 0, violated = 0;
  const auto power = [&](double low, double high) {
    return std::pow(10, random.number(low, high));
  };
  for (int n = 0; n < 400; ++n) {
    CAPTURE(n);
    MotionLimits<2> any;
    for (int j = 0; j < 2; ++j) {
      any.velocity[j] = std::min(power(-1, 1), joints[static_cast<std::size_t>(j)].limits.velocity);
      any.acceleration[j] = power(-1, 3);
      any.jerk[j] = power(-1, 5);
    }
    Follower follower(random.vector<2>(1), any,
                      {.tolerances = {.path_position = {0.2, 0.2}}, .highest_speed = 2});
    static_cast<void>(follower.sample(0));
    for (int k = 1; k < 4000; ++k) {
      const double t = k * h;
      if (random.one_in(300)) {
        std::vector<TrajectoryPoint<2>> p(static_cast<std::size_t>(random.integer(1, 4)));
        double time = 0;
        const bool velocities = random.one_in(2), accelerations = random.one_in(3),
                   moves_at_end = random.one_in(3);
        for (auto& point : p) {
          point.time_from_start = time += random.number(0.1, 2);
          for (int j = 0; j < 2; ++j) {
            point.position[j] = random.one_in(3) ? (random.one_in(2) ? lower : upper)[j]
                                                 : random.number(lower[j], upper[j]);
          }
          if (velocities) point.velocity = random.vector<2>(random.one_in(2) ? 1.5 : 0);
          if (accelerations) point.acceleration = random.vector<2>(random.one_in(2) ? 10 : 0);
        }
        if (!moves_at_end && velocities) p.back().velocity = zero;
        try {
          const Points points(p, {.allow_motion_at_end = true});
          const double when = random.one_in(2) ? Follower::now : t + random.number(-0.5, 0.5);
          ++(follower.start(points, {.path_position = {0.2, 0.2}}, when) == active ? started
                                                                                   : refused);
        } catch (const TrajectoryError&) {
          ++refused;
        }
      }
      if (random.one_in(600)) {
        canceled_there += follower.outcome() == active;
        follower.cancel();
      }
      if (random.one_in(500)) follower.set_speed(random.number(0, 2));
      const auto reference = follower.sample(t);
      const auto& q = reference.position.array();
      if (!is_finite(reference) || (q < lower.array()).any() || (q > upper.array()).any()) {
        FAIL("cycle " << k << ": at " << reference.position.transpose());
      }
      JointState<2> state = obedient(follower);
      if (random.one_in(500)) state.position += random.vector<2>(2);
      const bool was_active = follower.outcome() == active;
      violated += follower.check(state) == path_tolerance_violated && was_active;
    }
  }
  CAPTURE(started, refused, canceled_there, violated);
  CHECK(started > 500);
  CHECK(refused > 500);
  CHECK(canceled_there > 200);
  CHECK(violated > 200);
}

// The trajectory accelerates with 6 rad/s^2 and the speed rises with 100/s, while stops have 10
// rad/s^3: to let these accelerations fade would take up to hundreds of rad/s.
TEST_CASE("a stop from a high acceleration does not run away") {
  const MotionLimits<2> soft{{2, 10}, {10, 10}, {10, 10}};
  const Points fast({{.time_from_start = 1, .position = {-1, 1}, .velocity = zero}});
  for (const double until : {0.05, 0.1, 0.5, 0.9, 0.99}) {
    for (const bool rising : {false, true}) {
      CAPTURE(until, rising);
      Follower stopping(zero, soft, {.speed_rate = 100});
      REQUIRE(stopping.start(fast) == active);
      double t = run(stopping, 0, until);
      if (rising) {
        stopping.set_speed(0);
        t = run(stopping, t, t + 0.05);
        stopping.set_speed(1);
        t = run(stopping, t, t + 0.003);
      }
      stopping.cancel();
      JumpDetector detector(stopping.reference(), 21);
      for (int k = 1; k < 5000; ++k) {
        const auto r = stopping.sample(t + k * h);
        detector.check(r);
        if (std::abs(r.velocity[0]) > 2 || std::abs(r.velocity[1]) > 10) FAIL("cycle " << k);
      }
      CHECK(stopping.reference().velocity.isZero(0));
    }
  }
}

TEST_CASE("goal_time counts from where a last point that moves has come to rest") {
  // the stop takes v/A + A/J = 0.6 s
  const MotionLimits<2> soft{{2, 10}, {2, 2}, {20, 20}};
  const Points moving({{.time_from_start = 2, .position = {-0.5, 0}, .velocity = Vector(-1, 0)}},
                      {.allow_motion_at_end = true});
  Follower follower(zero, soft);
  REQUIRE(follower.start(moving, {.goal_position = {0.01, 0.01}, .goal_time = 0.2}) == active);
  int k = 0;
  for (; follower.outcome() == active; ++k) {
    static_cast<void>(follower.sample(k * h));
    JointState<2> late = obedient(follower);
    late.position[0] += 0.1;
    follower.check(late);
    REQUIRE(k < 4000);
  }
  CHECK(follower.outcome() == goal_tolerance_violated);
  CHECK(k * h == Approx(2.8).margin(0.005));
}

TEST_CASE("a trajectory that begins during the stop of another is held at its own end") {
  Follower follower(zero, limits, {.tolerances = {.path_position = {0.1, 0.1}}});
  REQUIRE(follower.start(there) == active);
  double t = run(follower, 0, 0.7);
  JointState<2> blocked = obedient(follower);
  blocked.position[0] += 0.2;
  CHECK(follower.check(blocked) == path_tolerance_violated);
  REQUIRE(follower.reference().velocity.norm() > 0.1);
  const Points on({{.time_from_start = 1.5, .position = {-0.6, 0.6}, .velocity = zero}});
  REQUIRE(follower.start(on) == active);
  t = run(follower, t, t + 1.6);
  CHECK(follower.outcome() == successful);
  run(follower, t, t + 1);
  CHECK(follower.reference().position == Vector(-0.6, 0.6));
}

TEST_CASE("no speed above the highest is taken") {
  for (const double highest : {1.0, 1.5}) {
    Follower follower(zero, limits, {.speed_rate = 1e9, .highest_speed = highest});
    follower.set_speed(50);
    run(follower, 0, 2 * h);
    CHECK(follower.speed() == highest);
  }
  CHECK_THROWS_WITH(Follower(zero, limits, {.highest_speed = 0.5}), Contains("highest speed"));
}

TEST_CASE("a stop is not taken over by a clock so slow that it would be too fast in it") {
  Follower follower(zero, limits, {.speed_rate = 100});
  const Points far({{.time_from_start = 2, .position = {1.5, 0.5}, .velocity = zero}});
  REQUIRE(follower.start(far) == active);
  double t = run(follower, 0, 1);
  follower.set_speed(0.02);
  follower.cancel();
  REQUIRE(follower.reference().velocity[0] > 1);
  t = run(follower, t, t + 0.012);  // slow now, and still stopping
  REQUIRE(follower.reference().velocity[0] > 0.5);
  REQUIRE(follower.start(far) == active);
  for (int k = 1; k < 6000; ++k) {
    if (k == 20) follower.set_speed(1);
    const auto r = follower.sample(t + k * h);
    REQUIRE(std::abs(r.velocity[0]) <= limits.velocity[0]);
    follower.check(obedient(follower));
  }
  CHECK(follower.outcome() == successful);
}

// 1e-10 of the speed: what is left of the accelerations is less than the rounding of the rest
TEST_CASE("a trajectory that is all but paused can be replaced as any other") {
  constexpr unsigned seed = 22;
  CAPTURE(seed);
  support::Random random(seed);
  for (int n = 0; n < 1000; ++n) {
    CAPTURE(n);
    Follower follower(zero, limits, {.speed_rate = 1});
    const Points first({{.time_from_start = 1,
                         .position = random.vector<2>(0.5),
                         .velocity = random.vector<2>(0.8)},
                        {.time_from_start = 2, .position = random.vector<2>(1), .velocity = zero}});
    REQUIRE(follower.start(first) == active);
    static_cast<void>(follower.sample(0));
    static_cast<void>(follower.sample(0.3));
    follower.set_speed(0);
    const double t = 1.3 - std::pow(10, random.number(-10, -3));
    static_cast<void>(follower.sample(t));
    REQUIRE(follower.speed() > 0);
    const Points second({{.time_from_start = 2, .position = {0.3, 0.2}, .velocity = zero}});
    REQUIRE(follower.start(second) == active);
    follower.set_speed(1);
    JumpDetector detector(follower.reference(), 20);
    for (int k = 1; k < 4000; ++k) detector.check(follower.sample(t + k * h));
    CHECK(follower.reference().position == Vector(0.3, 0.2));
  }
}

TEST_CASE("a paused trajectory stands still and goes on where it was") {
  Follower follower(zero, limits, {.speed_rate = 5});
  REQUIRE(follower.start(there) == active);
  run(follower, 0, 0.8);
  JumpDetector detector(follower.reference(), 20);
  follower.set_speed(0);
  for (int k = 801; k <= 1500; ++k) {
    detector.check(follower.sample(k * h));
    REQUIRE(follower.check(obedient(follower)) == active);
  }
  CHECK(follower.speed() == 0);
  CHECK(follower.reference().velocity.isZero(0));
  const Vector held = follower.reference().position;
  CHECK(follower.sample(1.6).position == held);
  follower.set_speed(1);
  JumpDetector again(follower.reference(), 20);
  for (int k = 1601; k <= 4000; ++k) {
    again.check(follower.sample(k * h));
    follower.check(obedient(follower));
  }
  CHECK(follower.outcome() == successful);
  CHECK(follower.reference().position == Vector(-1, 1));
}

TEST_CASE("at half speed it takes twice as long, at half the velocity") {
  Follower follower(zero, limits, {.speed_rate = 1e9});
  follower.set_speed(0.5);
  static_cast<void>(follower.sample(0));
  static_cast<void>(follower.sample(h));
  REQUIRE(follower.start(there) == active);
  static_cast<void>(follower.sample(h));
  const auto r = follower.sample(h + 1.4);
  Follower full(zero, limits);
  REQUIRE(full.start(there) == active);
  static_cast<void>(full.sample(0));
  const auto f = full.sample(0.7);
  CHECK((r.position - f.position).norm() < 1e-12);
  CHECK((r.velocity - f.velocity / 2).norm() < 1e-12);
  CHECK((r.acceleration - f.acceleration / 4).norm() < 1e-12);
}

TEST_CASE("continuous joints take the short way round") {
  constexpr double pi = std::numbers::pi;
  const auto knob = support::single_joint(JointType::continuous);
  using Knob = Model<1>;
  const auto one = [](double x) { return JointVector<1>(x); };
  TrajectoryFollower<Knob> follower(knob, one(20 * pi + 3), {one(5), one(10), one(100)},
                                    {.tolerances = {.path_position = one(0.1)}});
  const Trajectory<Knob> trajectory(knob, {{.time_from_start = 1, .position = one(-3)}});
  REQUIRE(follower.start(trajectory) == active);
  static_cast<void>(follower.sample(0));
  CHECK(follower.check({one(3), one(0)}) == active);  // whole turns are no error
  static_cast<void>(follower.sample(0.5));
  CHECK(follower.reference().position[0] == Approx(21 * pi).epsilon(1e-12));
  CHECK(follower.check({one(-pi), one(0)}) == active);
  static_cast<void>(follower.sample(1));
  CHECK(follower.reference().position[0] == Approx(22 * pi - 3).epsilon(1e-12));
  CHECK(follower.check({one(-3), one(0)}) == successful);
}

TEST_CASE("whatever is done to it at random, nothing jumps") {
  constexpr unsigned seed = 8;
  CAPTURE(seed);
  support::Random random(seed);
  Follower follower(zero, limits,
                    {.tolerances = {.path_position = {0.2, 0.2}}, .highest_speed = 1.2});
  double t = 0;
  JumpDetector detector(follower.sample(t), 80);
  CHECK(is_finite(follower.reference()));
  int refused = 0, started = 0, violated = 0, succeeded = 0;
  for (int k = 1; k < 300'000; ++k) {
    if (random.one_in(1500)) {
      std::vector<TrajectoryPoint<2>> p(static_cast<std::size_t>(random.integer(1, 4)));
      double time = random.number(0, 0.5);
      const bool velocities = random.one_in(2), accelerations = random.one_in(2);
      for (auto& point : p) {
        point.time_from_start = time += random.number(0.6, 1);
        point.position = random.vector<2>(0.3);
        point.velocity = random.vector<2>(velocities ? 0.3 : 0);
        if (accelerations) point.acceleration = random.vector<2>(1);
      }
      p.back().velocity = zero;
      const double when = random.one_in(2) ? Follower::now : t + random.number(-1, 1);
      const auto answer = follower.start(Points(p), {.path_position = {0.2, 0.2}}, when);
      ++(answer == active ? started : refused);
    }
    if (random.one_in(3000)) follower.cancel();
    if (random.one_in(1000)) follower.set_speed(random.one_in(3) ? 0 : random.number(0, 1.2));
    t += h;
    detector.check(follower.sample(t));
    JointState<2> state = obedient(follower);
    if (random.one_in(5000)) state.position += random.vector<2>(0.4);
    const bool was_active = follower.outcome() == active;
    const auto outcome = follower.check(state);
    if (was_active && outcome == path_tolerance_violated) ++violated;
    if (was_active && outcome == successful) ++succeeded;
  }
  CAPTURE(started, refused, violated, succeeded);
  CHECK(started > 100);
  CHECK(refused > 0);
  CHECK(violated > 3);
  CHECK(succeeded > 3);
}

TEST_CASE("gravity is compensated on after an abort") {
  Loop<Simulator<support::TiltedQ2d>, PidPlusGravity> loop;
  TrajectoryFollower<support::TiltedQ2d> follower(
      loop.state().position, limits,
      {.tolerances = {.path_position = {1e-4, 1e-4}}});  // tighter than the PID can
  const Trajectory<support::TiltedQ2d> trajectory(
      {{.time_from_start = 1, .position = {-0.5, 0.5}, .velocity = zero}});
  REQUIRE(follower.start(trajectory) == active);
  std::optional<Vector> where;
  for (int k = 0; k < 3000; ++k) {
    loop.reference() = follower.sample(loop.next_time());
    REQUIRE(loop.update() == Status::ok);
    if (!where && follower.check(loop.state()) == path_tolerance_violated) {
      where = loop.state().position;
    }
    if (where) REQUIRE((loop.state().position - *where).norm() < 0.05);
  }
  REQUIRE(where);
  CHECK((loop.state().position - *where).norm() < 1e-3);
  CHECK(loop.state().velocity.norm() < 1e-3);
}

TEST_CASE("outcomes have the codes of ROS's action, and words") {
  CHECK(static_cast<int>(successful) == 0);
  CHECK(static_cast<int>(invalid_goal) == -1);
  CHECK(static_cast<int>(invalid_joints) == -2);
  CHECK(static_cast<int>(old_header_timestamp) == -3);
  CHECK(static_cast<int>(path_tolerance_violated) == -4);
  CHECK(static_cast<int>(goal_tolerance_violated) == -5);
  for (int code = -5; code <= 3; ++code) {
    CHECK(to_string(static_cast<TrajectoryOutcome>(code)) != "unknown outcome");
  }
}

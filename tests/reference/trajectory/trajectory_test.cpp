// SPDX-License-Identifier: Apache-2.0
#include <articula/reference/reference_generator.hpp>
#include <articula/reference/trajectory/named_trajectory.hpp>
#include <articula/reference/trajectory/trajectory.hpp>
#include <articula/robots/q2d.hpp>

#include <numbers>
#include <string>
#include <vector>

#include "catch.hpp"
#include "numbers.hpp"
#include "random.hpp"
#include "slope.hpp"

using namespace articula;
using Catch::Matchers::Contains, Catch::Matchers::Equals;
using support::infinity;
using support::not_a_number;

namespace {

using Point = TrajectoryPoint<2>;
using Vector = JointVector<2>;
static_assert(ReferenceGenerator<Trajectory<Q2d>, 2>);

constexpr double rounding = 1e-12;

bool near(const Vector& a, const Vector& b, double tolerance = rounding) {
  return (a - b).cwiseAbs().maxCoeff() <= tolerance;
}

/// Points that a trajectory of the Q2D may have, with or without velocities and accelerations.
std::vector<Point> points(bool velocities, bool accelerations) {
  std::vector<Point> result{{.time_from_start = 0.5, .position = {0.1, -0.2}},
                            {.time_from_start = 1.25, .position = {0.4, 0.7}},
                            {.time_from_start = 3, .position = {-1, 1.1}}};
  const Vector v[] = {{0.2, 0.1}, {-0.3, 0.6}, {0, 0}};
  const Vector a[] = {{1, -2}, {0.5, 0.3}, {-0.4, 0.8}};
  for (std::size_t k = 0; k < result.size(); ++k) {
    if (velocities) result[k].velocity = v[k];
    if (accelerations) result[k].acceleration = a[k];
    result[k].effort = {1.0 + double(k), 3.0 * double(k)};
  }
  return result;
}

/// What both have at the ends, and derivatives in between that are derivatives.
void check_spline(const std::vector<Point>& p) {
  const Trajectory<Q2d> trajectory(p);
  for (std::size_t k = 0; k + 1 < p.size(); ++k) {
    const double T = p[k + 1].time_from_start - p[k].time_from_start;
    for (const double s : {0.0, 1.0}) {
      const auto r = interpolate(p[k], p[k + 1], s * T);
      const Point& end = s == 0 ? p[k] : p[k + 1];
      CHECK(near(r.position, end.position));
      if (end.velocity) CHECK(near(r.velocity, *end.velocity));
      if (end.acceleration) CHECK(near(r.acceleration, *end.acceleration));
      CHECK(near(r.effort, end.effort));
    }
    const double t = p[k].time_from_start + 0.3 * T;
    const auto position = [&](double h) { return trajectory.sample(t + h).position; };
    const auto velocity = [&](double h) { return trajectory.sample(t + h).velocity; };
    const auto r = trajectory.sample(t);
    CHECK(near(r.velocity, support::slope(position), 1e-9));
    CHECK(near(r.acceleration, support::slope(velocity), 1e-9));
    CHECK(near(r.effort, p[k].effort + 0.3 * (p[k + 1].effort - p[k].effort)));
  }
}

std::string message_of(const std::vector<Point>& p, const TrajectoryOptions& options = {}) {
  try {
    Trajectory<Q2d, 8>(p, options);
  } catch (const TrajectoryError& error) {
    CHECK(error.outcome() == TrajectoryOutcome::invalid_goal);
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("positions alone are joined by straight lines") {
  check_spline(points(false, false));
  const Trajectory<Q2d> trajectory(points(false, false));
  CHECK(near(trajectory.sample(0.8).velocity, Vector(0.4, 1.2)));
  CHECK(trajectory.sample(0.8).acceleration.isZero(0));
}

TEST_CASE("velocities make cubics, accelerations too make quintics") {
  check_spline(points(true, false));
  check_spline(points(true, true));
  // the coefficients of the controller's documentation, by hand for T = 2 at t = 1
  const Point a{.position = {1, 0}, .velocity = Vector(2, 0), .acceleration = Vector(3, 0)};
  const Point b{.time_from_start = 2,
                .position = {4, 0},
                .velocity = Vector(5, 0),
                .acceleration = Vector(6, 0)};
  const double c3 = (-20 * 1 + 20 * 4 - 3 * 3 * 4 + 6 * 4 - 12 * 2 * 2 - 8 * 5 * 2) / (2.0 * 8);
  const double c4 =
      (30 * 1 - 30 * 4 + 3 * 3 * 4 - 2 * 6 * 4 + 16 * 2 * 2 + 14 * 5 * 2) / (2.0 * 16);
  const double c5 = (-12 * 1 + 12 * 4 - 3 * 4 + 6 * 4 - 6 * 2 * 2 - 6 * 5 * 2) / (2.0 * 32);
  CHECK(interpolate(a, b, 1).position[0] == Approx(1 + 2 + 1.5 + c3 + c4 + c5).epsilon(1e-14));
  Point c = a, d = b;
  c.acceleration = d.acceleration = std::nullopt;
  const double c2 = (-3 * 1 + 3 * 4 - 2 * 2 * 2 - 5 * 2) / 4.0;
  CHECK(interpolate(c, d, 1).position[0] ==
        Approx(1 + 2 + c2 + (2 * 1 - 2 * 4 + 2 * 2 + 5 * 2) / 8.0).epsilon(1e-14));
}

TEST_CASE("accelerations without velocities are kept, not answered by zero") {
  check_spline(points(false, true));
  const Trajectory<Q2d> trajectory(points(false, true));
  CHECK(trajectory.sample(1).position[0] > 0.1);
}

TEST_CASE("the degree is that of what both ends have") {
  auto mixed = points(true, true);
  mixed[1].velocity = std::nullopt;
  mixed[1].acceleration = std::nullopt;
  const Trajectory<Q2d> trajectory(mixed);
  CHECK(near(trajectory.sample(0.6).velocity, Vector(0.4, 1.2)));
}

TEST_CASE("positions alone can be joined by the spline whose accelerations are continuous") {
  const TrajectoryOptions smooth{.spline_velocities = true};
  const std::vector<Point> p{{.time_from_start = 0, .position = {0, 0.5}},
                             {.time_from_start = 1, .position = {0.25, 0.9}},
                             {.time_from_start = 1.5, .position = {1, 0.2}},
                             {.time_from_start = 3, .position = {-0.4, -0.1}},
                             {.time_from_start = 4, .position = {0, 0}}};
  const Trajectory<Q2d> trajectory(p, smooth);
  CHECK(trajectory.sample(0).velocity.isZero(0));
  CHECK(trajectory.sample(4).velocity.isZero(0));
  for (std::size_t k = 1; k + 1 < p.size(); ++k) {
    const double t = p[k].time_from_start, e = 1e-9;
    const auto before = trajectory.sample(t - e), after = trajectory.sample(t + e);
    CHECK(near(trajectory.sample(t).position, p[k].position));
    CHECK(near(before.velocity, after.velocity, 1e-6));          // e times the acceleration
    CHECK(near(before.acceleration, after.acceleration, 1e-6));  // e times the jerk
    CHECK(after.acceleration.norm() > 0.1);
  }
  // By hand, with h = 1: 4 v = 3 (q_2 - q_0)
  const Trajectory<Q2d> three({{.time_from_start = 0, .position = {0, 0}},
                               {.time_from_start = 1, .position = {0.25, 0}},
                               {.time_from_start = 2, .position = {1, 0}}},
                              smooth);
  CHECK(near(*three.points()[1].velocity, Vector(0.75, 0)));
  // Velocities that are given stay; a first point with a way before it is left with the slope of a
  // natural spline: 2 v_0 + v_1 = 3 (q_1 - q_0).
  const Trajectory<Q2d> given(
      {{.time_from_start = 1, .position = {0, 0}},
       {.time_from_start = 2, .position = {0.3, 0}, .velocity = Vector(0.1, 0)},
       {.time_from_start = 3, .position = {0, 0}}},
      smooth);
  CHECK(near(*given.points()[0].velocity, Vector(0.4, 0)));
  CHECK(near(*given.points()[1].velocity, Vector(0.1, 0)));
  CHECK(Trajectory<Q2d>({{.time_from_start = 1, .position = {1, 1}}}, smooth).duration() == 1);
  // 3 q_2 / (4 h), where the mean velocities are 1.67
  CHECK_THROWS_WITH(Trajectory<Q2d>({{.time_from_start = 0, .position = {0, 0}},
                                     {.time_from_start = 0.45, .position = {0.75, 0}},
                                     {.time_from_start = 0.9, .position = {1.5, 0}}},
                                    smooth),
                    Contains("velocity 2.5 of joint 'shoulder_active_joint' is above its limit"));
}

TEST_CASE("the spline of a goal begins where the joints are asked to be") {
  const NamedTrajectory named{{"shoulder_active_joint", "elbow_active_joint"},
                              {{.time_from_start = 1, .positions = {0.25, 0}},
                               {.time_from_start = 2, .positions = {1, 0}}}};
  const auto trajectory = arrange(
      Q2d(), named, {.trajectory = {.spline_velocities = true}, .from = JointReference<2>{}});
  CHECK(near(*trajectory.points()[0].velocity, Vector(0.75, 0)));
  REQUIRE(trajectory.points().size() == 2);
}

TEST_CASE("a joint that is left out stands still in the points") {
  Trajectory<Q2d> trajectory(points(true, true));
  CHECK_FALSE(trajectory.left_out()[1]);
  trajectory.leave_out(1);
  CHECK(trajectory.left_out()[1]);
  CHECK_FALSE(trajectory.left_out()[0]);
  for (const Point& point : trajectory.points()) {
    CHECK(point.position[1] == -0.2);
    CHECK((*point.velocity)[1] == 0);
    CHECK((*point.acceleration)[1] == 0);
  }
  CHECK((*trajectory.points()[1].velocity)[0] == -0.3);
  CHECK_THROWS_WITH(trajectory.leave_out(2), Contains("joint 2"));
}

TEST_CASE("before the first point and after the last one it rests there") {
  const Trajectory<Q2d> trajectory(points(true, true));
  for (const double t : {-1e300, -1.0, 0.0, 0.4999}) {
    const auto r = trajectory.sample(t);
    CHECK(r.position == Vector(0.1, -0.2));
    CHECK(r.velocity.isZero(0));
    CHECK(r.effort == Vector(1, 0));
  }
  for (const double t : {3.0, 4.0, 1e300}) {
    const auto r = trajectory.sample(t);
    CHECK(r.position == Vector(-1, 1.1));
    CHECK(r.velocity.isZero(0));
    CHECK(r.acceleration.isZero(0));
    CHECK(r.effort == Vector(3, 6));
  }
  for (const double t : {not_a_number, infinity, -infinity}) {
    CHECK(!is_finite(trajectory.sample(t)));
  }
}

TEST_CASE("without interpolation the next point holds") {
  const Trajectory<Q2d> trajectory(points(true, false), {.interpolation = Interpolation::none});
  CHECK(trajectory.sample(0.2).position == Vector(0.1, -0.2));
  CHECK(trajectory.sample(0.5).position == Vector(0.4, 0.7));
  CHECK(trajectory.sample(0.6).velocity == Vector(-0.3, 0.6));
  CHECK(trajectory.sample(1.25).position == Vector(-1, 1.1));
}

TEST_CASE("points that make no trajectory are refused by point, joint, value and limit") {
  CHECK_THAT(message_of({}), Contains("no point"));
  CHECK_THAT(message_of(std::vector<Point>(9)), Contains("9") && Contains("capacity, 8"));

  for (const double bad : {not_a_number, infinity, -infinity}) {
    CAPTURE(bad);
    const auto with = [&](auto&& change) {
      auto p = points(true, true);
      change(p[1]);
      return message_of(p);
    };
    const auto check = [&](const char* what, auto&& change) {
      CHECK_THAT(with(change),
                 Contains("point 2") && Contains("'elbow_active_joint'") && Contains(what));
    };
    check("position", [&](Point& p) { p.position[1] = bad; });
    check("velocity", [&](Point& p) { (*p.velocity)[1] = bad; });
    check("acceleration", [&](Point& p) { (*p.acceleration)[1] = bad; });
    check("effort", [&](Point& p) { p.effort[1] = bad; });
    CHECK_THAT(with([&](Point& p) { p.time_from_start = bad; }), Contains("time_from_start"));
  }
  const auto with_times = [](double first, double second) {
    return message_of({{.time_from_start = first}, {.time_from_start = second}});
  };
  CHECK_THAT(with_times(-0.1, 1), Contains("point 1") && Contains("-0.1"));
  CHECK_THAT(with_times(1, 1), Contains("point 2") && Contains("not after"));
  CHECK_THAT(with_times(2, 1), Contains("point 2") && Contains("not after"));
  CHECK(with_times(0, support::smallest) == "accepted");

  auto p = points(true, true);
  p[2].position[0] = -1.6;
  CHECK_THAT(message_of(p), Contains("point 3") && Contains("-1.6") && Contains("-1.5708") &&
                                Contains("'shoulder_active_joint'"));
  p = points(true, true);
  (*p[0].velocity)[0] = -2.3;
  CHECK_THAT(message_of(p), Contains("point 1") && Contains("-2.3") && Contains("2.27"));
  p = points(true, true);
  p[1].time_from_start = 0.6;  // 0.3 rad in 0.1 s
  CHECK_THAT(message_of(p), Contains("point 2") && Contains("mean velocity of 3") &&
                                Contains("2.27") && Contains("'shoulder_active_joint'"));
  CHECK(message_of(p, {.interpolation = Interpolation::none}) == "accepted");
  p = points(true, true);
  p[1].acceleration = Vector(0, 1e308);
  CHECK_THAT(message_of(p), Contains("point 2") && Contains("overflows"));
  p = points(true, true);
  p[2].velocity = Vector(0, 0.2);
  CHECK_THAT(message_of(p),
             Contains("last") && Contains("0.2") && Contains("'elbow_active_joint'"));
  CHECK(message_of(p, {.allow_motion_at_end = true}) == "accepted");
}

TEST_CASE("a way that swings out of a joint's limits is refused, as is an end that leaves them") {
  // a cubic between two points at 1.5 rad, which rises by T v / 4 in the middle
  const auto hump = [](double v, double q = 1.5) {
    return message_of({{.position = {0, q}, .velocity = Vector(0, v)},
                       {.time_from_start = 1, .position = {0, q}, .velocity = Vector(0, -v)},
                       {.time_from_start = 2, .position = {0, q}, .velocity = Vector(0, 0)}});
  };
  const double left = std::numbers::pi / 2 - 1.5;
  CHECK(hump(4 * left) == "accepted");
  CHECK_THAT(hump(4 * left + 1e-6), Contains("point 2") && Contains("'elbow_active_joint'") &&
                                        Contains("swing out") && Contains("1.5708"));
  CHECK_THAT(hump(1), Contains("swing out to 1.75,"));
  CHECK_THAT(hump(-1, -1.5), Contains("swing out to -1.75,"));
  const auto end = [](double q, double v) {
    return message_of({{.position = {0, 0}, .velocity = Vector(0, 0)},
                       {.time_from_start = 2, .position = {q, 0}, .velocity = Vector(v, 0)}},
                      {.allow_motion_at_end = true});
  };
  const double limit = Q2d::description.joints[1].limits.upper;
  CHECK_THAT(end(limit, 0.1), Contains("last point") && Contains("leads out of its limits") &&
                                  Contains("'shoulder_active_joint'"));
  CHECK_THAT(end(-limit, -0.1), Contains("leads out of its limits"));
  CHECK(end(limit - 1e-3, 0.1) == "accepted");
  CHECK(end(limit, 1e-7) == "accepted");  // as good as none
}

TEST_CASE("any trajectory that is accepted has finite samples") {
  constexpr unsigned seed = 99;
  CAPTURE(seed);
  support::Random random(seed);
  const double hostile[] = {0,     1e-300, -1e-300, support::smallest, 1.5,          -1.5, 2.2,
                            1e300, -1e9,   1e-9,    infinity,          not_a_number, 0.1};
  const auto number = [&] {
    return random.one_in(4) ? hostile[random.integer(0, 12)] : random.number(-1, 1);
  };
  int accepted = 0;
  for (int k = 0; k < 20'000; ++k) {
    std::vector<Point> p(static_cast<std::size_t>(random.integer(0, 4)));
    double time = 0;
    for (Point& point : p) {
      point.time_from_start = time;
      time += std::abs(number());
      point.position = {random.number(-1, 1), number()};
      if (random.one_in(2)) point.velocity = Vector(number(), 0);
      if (random.one_in(2)) point.acceleration = Vector(number(), number());
    }
    try {
      const Trajectory<Q2d, 3> trajectory(p);
      ++accepted;
      for (int i = 0; i < 10; ++i) {
        const auto r = trajectory.sample(random.number(-0.1, 1.1) * trajectory.duration());
        if (!is_finite(r)) FAIL("not finite, case " << k);
      }
    } catch (const TrajectoryError&) {
    }
  }
  CHECK(accepted > 1'000);
}

TEST_CASE("a named trajectory is put in the robot's order") {
  const NamedTrajectory named{{"elbow_active_joint", "shoulder_active_joint"},
                              {{.time_from_start = 1,
                                .positions = {1, 2.0 / 16},
                                .velocities = {3, 0.5},
                                .accelerations = {5, 6},
                                .effort = {7, 8}},
                               {.time_from_start = 2, .positions = {0.5, 0.25}}}};
  const auto trajectory = arrange<4>(Q2d(), named);
  const Point& p = trajectory.points()[0];
  CHECK(p.time_from_start == 1);
  CHECK(p.position == Vector(0.125, 1));
  CHECK(p.velocity == Vector(0.5, 3));
  CHECK(p.acceleration == Vector(6, 5));
  CHECK(p.effort == Vector(8, 7));
  CHECK(!trajectory.points()[1].velocity);
}

TEST_CASE("names that do not fit are invalid joints, arrays that do not an invalid goal") {
  const auto outcome = [](const NamedTrajectory& named, const char* what) {
    try {
      static_cast<void>(arrange(Q2d(), named));
    } catch (const TrajectoryError& error) {
      CHECK_THAT(error.what(), Contains(what));
      return error.outcome();
    }
    return TrajectoryOutcome::successful;
  };
  using enum TrajectoryOutcome;
  const std::string s = "shoulder_active_joint", e = "elbow_active_joint";
  CHECK(outcome({{s, "wrist"}, {{.positions = {0, 0}}}}, "'wrist'") == invalid_joints);
  CHECK(outcome({{s, "wrist"}, {{.positions = {0, 0}}}}, "joints: shoulder_active_joint, elbow") ==
        invalid_joints);
  CHECK(outcome({{s, "base_joint"}, {{.positions = {0, 0}}}}, "'base_joint' is fixed") ==
        invalid_joints);
  CHECK(outcome({{s, e, s}, {{.positions = {0, 0, 0}}}}, "twice") == invalid_joints);
  CHECK(outcome({{s}, {{.positions = {0}}}}, "'elbow_active_joint'") == invalid_joints);
  CHECK(outcome({{}, {}}, "not named") == invalid_joints);
  CHECK(outcome({{s, e}, {}}, "no point") == invalid_goal);
  CHECK(outcome({{s, e}, {{.positions = {0}}}}, "1 positions for 2") == invalid_goal);
  CHECK(outcome({{s, e}, {{.positions = {0, 0, 0}}}}, "3 positions for 2") == invalid_goal);
  CHECK(outcome({{s, e}, {{.positions = {0, 0}, .velocities = {0}}}}, "velocities") ==
        invalid_goal);
  CHECK(outcome({{s, e}, {{.velocities = {0, 0}}}}, "point 1 has no positions") == invalid_goal);
  CHECK(outcome({{s, e}, {{.positions = {0, 9}}}}, "outside") == invalid_goal);
}

TEST_CASE("joints that are not named stay, where that is allowed") {
  const NamedTrajectory named{{"elbow_active_joint"},
                              {{.time_from_start = 1, .positions = {1}, .velocities = {0}}}};
  const auto trajectory =
      arrange(Q2d(), named, {.allow_partial_joints = true, .from = JointReference<2>{{0.3, 0.4}}});
  CHECK(trajectory.points()[0].position == Vector(0.3, 1));
  CHECK(trajectory.points()[0].velocity == Vector(0, 0));
}

TEST_CASE("what stays or is integrated needs to be told where it is") {
  const auto refusal = [](const NamedTrajectory& named, const ArrangeOptions<2>& options) {
    try {
      static_cast<void>(arrange(Q2d(), named, options));
    } catch (const TrajectoryError& error) {
      return std::string(to_string(error.outcome())) + ", " + error.what();
    }
    return std::string();
  };
  const std::string s = "shoulder_active_joint", e = "elbow_active_joint";
  const NamedTrajectory partial{{e}, {{.time_from_start = 1, .positions = {1}}}};
  CHECK_THAT(refusal(partial, {.allow_partial_joints = true}),
             Equals("invalid joints, trajectory: joint 'shoulder_active_joint' is not named; set "
                    "ArrangeOptions::from"));
  const NamedTrajectory velocities{{s, e}, {{.time_from_start = 1, .velocities = {0, 0}}}};
  CHECK_THAT(
      refusal(velocities, {.allow_integration = true}),
      Equals("invalid goal, trajectory: point 1 has no positions; set ArrangeOptions::from"));
  // What leaves nothing open needs none.
  const NamedTrajectory whole{{s, e}, {{.time_from_start = 1, .positions = {0, 1}}}};
  CHECK(refusal(whole, {.allow_partial_joints = true, .allow_integration = true}).empty());
}

TEST_CASE("positions are integrated where that is allowed") {
  const std::vector<std::string> names{"shoulder_active_joint", "elbow_active_joint"};
  const auto by_velocity =
      arrange(Q2d(),
              {names,
               {{.time_from_start = 1, .velocities = {0.2, 0.4}},
                {.time_from_start = 2, .velocities = {0, 0}}}},
              {.allow_integration = true, .from = JointReference<2>{{0.1, 0}}});
  CHECK(near(by_velocity.points()[0].position, Vector(0.2, 0.2)));
  CHECK(near(by_velocity.points()[1].position, Vector(0.3, 0.4)));
  const auto by_acceleration = arrange(Q2d(),
                                       {names,
                                        {{.time_from_start = 1, .accelerations = {0.4, 0.8}},
                                         {.time_from_start = 2, .accelerations = {-0.8, -1.6}}}},
                                       {.allow_integration = true, .from = JointReference<2>{}});
  CHECK(near(*by_acceleration.points()[0].velocity, Vector(0.2, 0.4)));
  CHECK(near(by_acceleration.points()[1].position, Vector(0.1 + 0.1, 0.4)));
}

// SPDX-License-Identifier: Apache-2.0
#include <articula/motion/rest_to_rest.hpp>
#include <articula/reference/reference_generator.hpp>
#include <articula/reference/state_to_state_profile.hpp>
#include <articula/robots/q2d.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "catch.hpp"
#include "numbers.hpp"
#include "random.hpp"

using namespace articula;
using Catch::Matchers::Contains;
using support::infinity;
using support::not_a_number;

namespace {

using Profile = StateToStateProfile<Q2d>;
static_assert(ReferenceGenerator<Profile, 2>);

MotionBounds either_way(double V, double A, double J) { return {-V, V, -A, A, J}; }

struct Case {
  JointMotion start, target;
  MotionBounds bounds;
};

StateToStateMotion motion_of(const Case& c) { return {c.start, c.target, c.bounds}; }

/// The velocity at which the acceleration of a state has faded, as early as possible.
double faded(const JointMotion& state, double side, double jerk) {
  return state.velocity + side * state.acceleration / 2 / jerk * std::abs(state.acceleration);
}

bool is_within(double low, double x, double high) { return low <= x && x <= high; }

/// Whether a motion can begin (side 1) or end (side -1) with a state and keep its limits.
bool is_viable(const JointMotion& state, const MotionBounds& b, double side) {
  return is_within(b.lowest_acceleration, state.acceleration, b.highest_acceleration) &&
         is_within(b.lowest_velocity, state.velocity, b.highest_velocity) &&
         is_within(b.lowest_velocity, faded(state, side, b.jerk), b.highest_velocity);
}

/// A motion between viable states, or between one that is not and one that is.
Case random_case(support::Random& random, bool may_begin_outside) {
  for (;;) {
    Case c;
    const auto limit = [&] { return random.number(0.08, 16); };
    c.bounds = {-limit(), limit(), -limit(), limit(), limit()};
    if (random.one_in(3)) {
      c.bounds.lowest_velocity = -c.bounds.highest_velocity;
      c.bounds.lowest_acceleration = -c.bounds.highest_acceleration;
    }
    for (JointMotion* state : {&c.start, &c.target}) {
      *state = {random.number(-8, 8), random.number(-1.5, 1.5), random.number(-1.5, 1.5)};
      if (random.one_in(4)) state->acceleration = 0;
      if (random.one_in(4)) state->velocity = state->acceleration = 0;
      if (random.one_in(20)) *state = {state->position, c.bounds.highest_velocity, 0};
      if (random.one_in(20)) state->acceleration = c.bounds.lowest_acceleration;
    }
    if (random.one_in(20)) c.target.position = c.start.position;
    if (!is_viable(c.target, c.bounds, -1)) continue;
    if (may_begin_outside || is_viable(c.start, c.bounds, 1)) return c;
  }
}

/// What is wrong with a motion; empty if nothing. Stretch by stretch, its figures are those that
/// the jerk makes of those at the start, and they keep the limits, all up to rounding: 1e-11 of the
/// largest figures on the way.
std::string fault_of(const TransferMotion& motion, const Case& c) {
  const MotionBounds& b = c.bounds;
  const double T = motion.duration();
  JointMotion now = c.start;
  double p_size = 10, v_size = 1;
  for (std::size_t k = 0; k < motion.size(); ++k) {
    const double j = motion.jerk_of(k), t = motion.start_of(k + 1) - motion.start_of(k);
    if (!(std::abs(j) <= b.jerk * (1 + 1e-12))) return "jerk";
    now = {now.position + t * (now.velocity + t * (now.acceleration / 2 + t * j / 6)),
           now.velocity + t * (now.acceleration + t * j / 2), now.acceleration + t * j};
    const double middle = motion.start_of(k) + t / 2;
    for (const double at : {motion.start_of(k), middle}) {
      const JointMotion s = motion.sample(at);
      p_size = std::max(p_size, std::abs(s.position));
      v_size = std::max(v_size, std::abs(s.velocity));
      const double rounding = 1e-11 * v_size;
      if (!is_within(b.lowest_velocity - rounding, s.velocity, b.highest_velocity + rounding)) {
        return "velocity";
      }
      if (!is_within(b.lowest_acceleration, s.acceleration, b.highest_acceleration)) {
        return "acceleration";
      }
    }
    // Turning points of the velocity lie where the acceleration is 0.
    const double zero = motion.start_of(k) - motion.sample(motion.start_of(k)).acceleration / j;
    if (is_within(motion.start_of(k), zero, motion.start_of(k + 1))) {
      const double v = motion.sample(zero).velocity, rounding = 1e-11 * v_size;
      if (!is_within(b.lowest_velocity - rounding, v, b.highest_velocity + rounding)) {
        return "highest velocity";
      }
    }
  }
  const double wrong_p = std::abs(now.position - c.target.position);
  const double wrong_v = std::abs(now.velocity - c.target.velocity);
  const double wrong_a = std::abs(now.acceleration - c.target.acceleration);
  if (!(wrong_a <= 1e-11 * (1 + b.jerk * T))) return "end: acceleration";
  if (!(wrong_v <= 1e-11 * v_size * (1 + T))) return "end: velocity";
  if (!(wrong_p <= 1e-11 * (p_size + v_size * T) * (1 + T))) return "end: position";
  const JointMotion end = motion.sample(T);
  return end.position == c.target.position && end.velocity == c.target.velocity ? "" : "end";
}

/// What lies between D-(T) and D+(T) without limits of velocity, found in another way: the
/// acceleration lies between two envelopes; the furthest way stays at the upper one, falls at full
/// jerk and stays at the lower one, where the moment of the fall is found by bisection.
class Envelope {
 public:
  Envelope(const Case& c, double T, double side)
      : v0_(side * c.start.velocity),
        a0_(side * c.start.acceleration),
        a1_(side * c.target.acceleration),
        low_(side > 0 ? c.bounds.lowest_acceleration : -c.bounds.highest_acceleration),
        high_(side > 0 ? c.bounds.highest_acceleration : -c.bounds.lowest_acceleration),
        J_(c.bounds.jerk),
        T_(T) {
    const double wanted = side * (c.target.velocity - c.start.velocity);
    double early = -10 * (J_ * T + high_ - low_), late = -early;
    exists =
        J_ * T >= std::abs(a1_ - a0_) && run(early).change <= wanted && run(late).change >= wanted;
    if (!exists) return;
    for (int k = 0; k < 60; ++k) {
      const double middle = (early + late) / 2;
      (run(middle).change < wanted ? early : late) = middle;
    }
    const Way way = run(late);
    distance = way.distance;
    highest_velocity = way.highest;
  }

  bool exists = false;
  double distance = 0, highest_velocity = 0;

 private:
  struct Way {
    double change = 0, distance = 0, highest = 0;
  };

  [[nodiscard]] double acceleration(double t, double fall) const {
    const double upper = std::min({a0_ + J_ * t, high_, a1_ + J_ * (T_ - t)});
    const double lower = std::max({a0_ - J_ * t, low_, a1_ - J_ * (T_ - t)});
    return std::max(lower, std::min(upper, fall - J_ * t));
  }

  /// Simpson's rule from kink to kink is exact.
  [[nodiscard]] Way run(double fall) const {
    std::vector<double> kinks{0, T_, (high_ - a0_) / J_, (a0_ - low_) / J_};
    for (const double a : {high_, low_}) {
      kinks.push_back(T_ - std::abs(a - a1_) / J_);
      kinks.push_back((fall - a) / J_);
    }
    kinks.push_back((fall - a0_) / J_ / 2);
    kinks.push_back((fall - a1_ + J_ * T_) / J_ / 2);
    kinks.push_back((fall - a1_ - J_ * T_) / J_ / 2);
    kinks.push_back((a1_ - a0_ + J_ * T_) / J_ / 2);
    kinks.push_back((a0_ - a1_ + J_ * T_) / J_ / 2);
    for (double& kink : kinks) kink = std::clamp(kink, 0.0, T_);
    std::sort(kinks.begin(), kinks.end());
    Way way{0, 0, v0_};
    double v = v0_;
    for (std::size_t k = 0; k + 1 < kinks.size(); ++k) {
      const double s = kinks[k], t = kinks[k + 1], h = t - s;
      const double a = acceleration(s, fall), m = acceleration((s + t) / 2, fall),
                   e = acceleration(t, fall);
      way.distance += h * v + h * h * (a + 2 * m) / 6;
      const double next = v + h * (a + 4 * m + e) / 6;
      way.highest = std::max({way.highest, v, next, a > 0 && e < 0 ? v + a * h : v});
      v = next;
    }
    way.change = v - v0_;
    return way;
  }

  double v0_, a0_, a1_, low_, high_, J_, T_;
};

}  // namespace

TEST_CASE("roots of polynomials and their turning points are found in order") {
  // (x - 1) (x - 2)^2 (x - 4) = x^4 - 9 x^3 + 28 x^2 - 36 x + 16
  const std::array<double, 5> c{16, -36, 28, -9, 1};
  const auto found = roots_and_turns(c, 0, 5);
  std::vector<double> roots;
  for (const double x : found) {
    if (std::abs(polynomial_value(c, x)) < 1e-12) roots.push_back(x);
  }
  CHECK(std::is_sorted(found.begin(), found.end()));
  REQUIRE(roots.size() >= 3);
  CHECK(roots.front() == Approx(1).epsilon(1e-14));
  CHECK(roots[1] == Approx(2).epsilon(1e-7));  // double: half of the digits
  CHECK(roots.back() == Approx(4).epsilon(1e-14));
  CHECK(roots_and_turns(std::array<double, 3>{1, 0, 1}, -1, 1).size == 1);  // the turn
  CHECK(roots_and_turns(std::array<double, 2>{-3, 0}, 0, 9).size == 0);
}

// Published: the durations that ruckig's own tests state, as far as they have digits.
TEST_CASE("durations are those of ruckig, or shorter") {
  struct Known {
    std::vector<Case> joints;
    double duration;
    double minimum = 0;
  };
  const auto rest = [](double from, double to) { return Case{{from}, {to}, {}}; };
  const auto with = [](std::vector<Case> joints, const MotionBounds& bounds) {
    for (Case& joint : joints) joint.bounds = bounds;
    return joints;
  };
  const std::vector<Known> known{
      {with({rest(0, 1)}, either_way(1, 1, 1)), 3.1748021039},
      {with({rest(0, 1)}, either_way(1, 1, 2)), 2.5615528128},
      {with({rest(0, 1)}, either_way(0.6, 1, 2)), 2.7666666667},
      {with({rest(0, 1)}, either_way(0.4, 1, 2)), 3.394427191},
      {with({{{0, 0.3, 0}, {1}, {}}}, either_way(1, 1, 2)), 2.2319602829},
      {with({{{0, 0.3, 0}, {1}, {}}}, either_way(0.6, 1, 2)), 2.410315834},
      {with({{{0, 0.2, 0}, {-1}, {}}}, either_way(10, 10, 2)), 2.7338531701},
      {with({{{-1, 0.2, 0}, {1}, {}}}, either_way(0.4, 1, 2)), 5.6053274785},
      {with({rest(0, 1), {{-2}, {-3, 0.3, 0}, {}}, rest(0, 2)}, either_way(1, 1, 1)), 4},
      {{{{-5.54640573838539, 0.824843228617216, -0.119403564898501},
         {-1.58293112753888, -1.59453676324393, -0.664429703711622},
         either_way(12.9892953062198, 4.2162106624246, 8.03496976453435)},
        {{-2.34195463203842, -1.03863337183304, 0.923861820607788},
         {0.383405919465141, 0, 0},
         either_way(3.74169932927481, 10.2906731766853, 0.200684346397485 - 1e-14)},
        {{5.10070661762967, -0.749451523227729, 3.04022341347259},
         {5.79349604610299, -0.0693173526513803, 0},
         either_way(1.42398447457303, 2.1869079548297, 0.0848503482861296)}},
       1921.0797627836},
      {{{{-6.49539540831446, -1.14327601654428, -1.73501068960131},
         {4.4676187540058, -0.544559915133859, -1.31832055647831},
         either_way(8.65978706670502, 3.40137210377608, 10.9542353113865)},
        {{6.14883133273172, 0.00991019970085593, -0.584885092422228},
         {2.93367894961155, 0.298517792372943, 0},
         either_way(5.94921088330542, 4.04166318018487, 3.11056302676629)},
        {{-2.02636240900911, -1.00932863927626, 0},
         {-0.646008452514058, 1.6058847848484, 0},
         either_way(10.7652253566829, 10.8617860610581, 0.798055744482636 + 9e-12)}},
       4.6277455678},
      {{{{7.06378251402596, 0.436985859305842, -0.80835350359544},
         {4.40606827118048, 0.555084596169823, 0.463000173872542},
         either_way(7.97399137456765, 5.44679859206862, 7.88958080921515)},
        {{-2.4834697862831, 0.0708113515655622, 0},
         {-2.84629921001043, 0, 0},
         either_way(2.68591430972239, 7.61752909348119, 5.26855927512131)},
        {{-0.843847405371359, -0.751266816040307, -0.355284934641626},
         {-2.91829890043522, -1.24631524923535, 0},
         either_way(9.54987666746364, 0.473482772614085, 0.764061581326592 - 1e-14)}},
       8.8739464323},
      {{{{-7.962737259350095, -0.8844863500141733, 2.252932547031004},
         {-3.547368989678775, 0, 0.217242176687843},
         either_way(0.1241065584614779, 1.808598147153279, 2.516849090900998 - 3e-15)}},
       38.3409477609},
      {{{{-4.180150148354134, 1.673805463302308, 1.412175048500792},
         {2.079913937916431, 0.7537566830764975, -0.8610296259045267},
         either_way(1.863775561344568, 9.49223908896113, 8.689575453772798)},
        {{1.030371049895473, -1.435796222257198, 1.892262449040863},
         {1.839862681333277, 0, -0.07876323073516262},
         either_way(0.4357836109021987, 9.002562577262177, 0.09322235504216797)},
        {{-2.660154279239869, 0.9711306630275642, -1.128847905860926},
         {2.341421542126605, 0.02507782261105568, 0},
         either_way(6.260907804906162, 1.119142029086944, 0.1594452521517275 + 3e-15)}},
       1135.0135089249},
      {{{{-4.490717417930574, 0.1839756723363622, -1.057769973808928},
         {-4.928244836531066, 0.1097319156272965, 0.03089046366221739},
         either_way(6.144314006624488, 5.199401036221791, 9.940940357283978)},
        {{3.467236624628543, -0.4356283320280516, 0},
         {-4.821780824003112, -0.9272874846270881, -0.9744054582899561},
         either_way(2.93258338415229, 1.848176490768948, 10.46997753899755)},
        {{-0.7545929089757601, 0.7490399525818022, -2.368645439140517},
         {-8.20567952461017, 0, 0},
         either_way(0.1820021269527196, 11.11168017805234, 0.08166297169205029)}},
       7295.4375633935},
      {with({{{0.01073568005271233, 0.05656281587106524, -5.348847133445708}, {0.0698}, {}},
             {{-0.7002627264230739, 1.011281770884991, -3.400994300842285}, {0.6283}, {}}},
            either_way(1, 7, 1000)),
       1.403613276},
      {{{{0.0001215, 0.00405, 0.09}, {0.1421083333333333087, 0.37, 0.5}, either_way(1, 0.5, 1)}},
       0.9},
      {{{{0.3736320740840176, -0.60486324450823, -0.4953501898933239},
         {0.233562911156468},
         {-1.94898305867544, 10.01369296498101, -0.6829625196960336, 14.72621077848741,
          7.770133554060553}}},
       1.08732372},
      {{{{-0.01919986582215404, -0.3858205249368821, 0.1889847091893647},
         {1.297187158009963, 1.160424379732321, 0.4552736879206988},
         either_way(14.64378197125325, 0.4552736879216988, 12.15045820314999)}},
       3.408914,
       3.408914},
      {{{{1300, 1200, 0}, {1400}, either_way(800, 40000, 200000)}}, 0.1673474569},
      {{{{-19.93333333333424, 10, 0}, {20, 10, 0}, either_way(10, 15, 15)},
        {{-0.4983333333333563, 0.25, 0}, {0.5, 0.25, 0}, either_way(10, 15, 5)},
        {{0}, {0.2}, either_way(10, 15, 2)}},
       3.99333333},
      {{{{0, 1, -2}, {1, 0.5, 0}, either_way(0.8, 2, 5)}}, 1.6041},
      {{{{0.1720894642466409, 0, 0},
         {0.1703441349946466, 0, 0},
         either_way(0.06981316999999999, 0.034906585, 100)},
        {{3.62255615705579, -0.06422550797049381, 0},
         {3.587689540855463, -0.06423623454575711, 0},
         either_way(0.06423623454575711, 0.261799388, 100)},
        {{1.675754445058354, -0.006910864193129071, 0},
         {1.671344092861895, -0.007006078877926925, 0},
         either_way(0.007006078877926925, 0.043633231, 100)},
        {{2.181127634157466, 0.1207111377965507, -0.3999999999978001},
         {2.271916653384632, 0.1187909578397501, 0},
         either_way(0.1187909578397501, 0.4, 100)},
        {{0.7829547024446563}, {0.7826056365942573}, either_way(6.981317008, 4.01425728, 100)},
        {{0}, {-0.003141592653589793}, either_way(34.90658504, 34.90658504, 100)}},
       0.764274}};
  for (const Known& each : known) {
    std::vector<StateToStateMotion> joints;
    for (const Case& joint : each.joints) joints.push_back(motion_of(joint));
    const double duration = common_duration(joints, each.minimum);
    CAPTURE(duration, each.duration);
    CHECK(duration <= each.duration * (1 + 1e-5));  // they state five digits or more
    CHECK(duration >= each.duration * (1 - 1e-5));  // their tests allow 1.2e-5
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const TransferMotion motion = joints[j].motion(duration);
      CHECK(motion.duration() == Approx(duration).epsilon(1e-12));
      if (is_viable(each.joints[j].start, each.joints[j].bounds, 1)) {
        CHECK(fault_of(motion, each.joints[j]).empty());
      }
    }
  }
}

TEST_CASE("half a million random motions, and as many longer ones, arrive and keep their limits") {
  constexpr unsigned seed = 20261;
  CAPTURE(seed);
  support::Random random(seed);
  int gaps = 0;
  for (int k = 0; k < 500'000; ++k) {
    const Case c = random_case(random, false);
    const StateToStateMotion motion = motion_of(c);
    std::string fault = motion.exists() ? fault_of(motion.motion(0), c) : "none";
    const double T = motion.least_duration();
    double longer = T * random.number(1, random.one_in(2) ? 3 : 1.1) + 1e-3;
    if (!motion.can_take(longer)) {
      ++gaps;
      longer = motion.next_duration(longer);
      if (!motion.can_take(longer)) fault = "no longer one";
    }
    const TransferMotion slow = motion.motion(longer);
    if (fault.empty()) fault = fault_of(slow, c);
    if (!(std::abs(slow.duration() - longer) <= 1e-11 * longer)) fault = "duration";
    if (fault.empty()) continue;
    CAPTURE(k, fault, T, longer, c.start.position, c.start.velocity, c.start.acceleration,
            c.target.position, c.target.velocity, c.target.acceleration, c.bounds.lowest_velocity,
            c.bounds.highest_velocity, c.bounds.lowest_acceleration, c.bounds.highest_acceleration,
            c.bounds.jerk);
    FAIL("motion");
  }
  CHECK(gaps > 1000);
}

// For a time that is too short, the target's distance lies outside of what the envelopes leave, or
// the envelopes leave no motion at all.
TEST_CASE("in the whole range of limits that are accepted, motions are found and keep them") {
  support::Random random(11);
  const auto size = [&](double orders) { return std::pow(10.0, random.number(-orders, orders)); };
  for (int k = 0; k < 60000; ++k) {
    INFO(k);
    Case c;
    const double V = size(3), A = V * size(4);  // V / A is 0.1 ms to 10 000 s
    c.bounds = {-V, V, -A, A, std::clamp(size(6) * A * A / V, 1e-9, 1e9)};
    const auto more = [&] { return std::pow(10.0, random.number(0, 2)); };
    (random.one_in(2) ? c.bounds.highest_velocity : c.bounds.lowest_velocity) *= more();
    (random.one_in(2) ? c.bounds.highest_acceleration : c.bounds.lowest_acceleration) *= more();
    for (JointMotion* state : {&c.start, &c.target}) {
      *state = {random.number(-8, 8), random.number(-1, 1) * V, random.number(-1, 1) * A};
      if (random.one_in(2)) state->acceleration = 0;
      if (random.one_in(4)) state->velocity = state->acceleration = 0;
    }
    if (!is_viable(c.target, c.bounds, -1)) continue;
    const StateToStateMotion motion = motion_of(c);
    REQUIRE(motion.exists());
    for (const double factor : {1.0, 1.3, 4.0}) {
      const double wanted = factor * motion.least_duration();
      const double T = motion.can_take(wanted) ? wanted : motion.next_duration(wanted);
      const TransferMotion found = motion.motion(T);
      REQUIRE(found.keeps(c.bounds));
      REQUIRE(found.duration() == T);
    }
  }
}

TEST_CASE("what differs from 0 by rounding alone is 0") {
  support::Random random(12);
  const auto limits = both_ways(motion_limits(Q2d(), {10, 30}, {200, 600}));
  for (const double order : {10.0, 15.0, 20.0, 34.0, 44.0, 80.0, 120.0, 300.0}) {
    for (int k = 0; k < 500; ++k) {
      const auto tiny = [&] {
        return random.one_in(3)
                   ? 0
                   : random.number(-1, 1) * std::pow(10, -order * random.number(0.6, 1));
      };
      JointReference<2> from, to;
      for (int j = 0; j < 2; ++j) {
        from.position[j] = tiny();
        from.velocity[j] = tiny();
        from.acceleration[j] = tiny();
        to.position[j] = tiny();
      }
      INFO(order << " " << k);
      const auto profile = Profile::plan(from, to, limits);
      REQUIRE(profile);
      REQUIRE(profile->duration() < 0.1);
      REQUIRE(profile->sample(profile->duration()).position == to.position);
    }
  }
  // A figure that a joint shows stays.
  const StateToStateMotion slow({0, 1e-9, 0}, {0, 0, 0}, either_way(1, 1, 1));
  CHECK(slow.motion(slow.least_duration()).sample(0).velocity == 1e-9);
}

TEST_CASE("a motion is compared with its limits") {
  TransferMotion motion({0, 0, 0});
  motion.append(1, 1);
  motion.append(-1, 2);
  motion.append(1, 1);
  CHECK(motion.keeps(either_way(1, 1, 1)));
  CHECK_FALSE(motion.keeps(either_way(0.99, 1, 1)));
  CHECK_FALSE(motion.keeps(either_way(1, 0.99, 1)));
  CHECK_FALSE(motion.keeps(either_way(1, 1, 0.99)));
  TransferMotion jumps = motion;
  jumps.end_at({motion.end().position + 0.1, motion.end().velocity, 0});
  CHECK_FALSE(jumps.keeps(either_way(1, 1, 1)));
  jumps.end_at({motion.end().position, motion.end().velocity + 0.1, 0});
  CHECK_FALSE(jumps.keeps(either_way(1, 1, 1)));
  // The velocity turns within a stretch.
  TransferMotion turns({0, 0, 1});
  turns.append(-1, 2);
  CHECK(turns.keeps(either_way(0.5, 1, 1)));
  CHECK_FALSE(turns.keeps({-1, 0.4, -1, 1, 2}));
}

TEST_CASE("no motion between two states is faster") {
  constexpr unsigned seed = 20262;
  CAPTURE(seed);
  support::Random random(seed);
  int shown = 0, by_distance = 0, open = 0;
  for (int k = 0; k < 3000; ++k) {
    const Case c = random_case(random, false);
    const double T = motion_of(c).least_duration();
    for (int i = 1; i <= 20; ++i) {
      const double shorter = i == 20 ? T * (1 - 1e-6) : T * i / 20;
      if (!(shorter > 0)) continue;
      const Envelope up(c, shorter, 1), down(c, shorter, -1);
      const double D = c.target.position - c.start.position;
      const bool impossible = !up.exists || !down.exists || D > up.distance || D < -down.distance;
      // Where the envelope's way passes a limit of velocity, it leaves more than there is.
      const bool wider = up.highest_velocity > c.bounds.highest_velocity ||
                         down.highest_velocity > -c.bounds.lowest_velocity;
      CAPTURE(k, i, T, shorter, D, up.distance, -down.distance);
      if (!impossible && wider) {
        ++open;
        continue;
      }
      REQUIRE(impossible);
      ++shown;
      by_distance += up.exists && down.exists;
    }
  }
  CHECK(shown > 40 * open / 10);
  CHECK(by_distance > 10'000);
}

TEST_CASE("planned anew on its way, a motion arrives when it would have") {
  constexpr unsigned seed = 20263;
  CAPTURE(seed);
  support::Random random(seed);
  for (int k = 0; k < 2000; ++k) {
    const Case c = random_case(random, false);
    const StateToStateMotion first = motion_of(c);
    const double T = first.least_duration();
    const TransferMotion way = first.motion(T);
    for (int i = 1; i <= 20; ++i) {
      const double t = T * i / 20;
      const StateToStateMotion rest(way.sample(t), c.target, c.bounds);
      CAPTURE(k, i, T, t, rest.least_duration(), c.start.position, c.start.velocity,
              c.start.acceleration, c.target.position, c.target.velocity, c.target.acceleration,
              c.bounds.lowest_velocity, c.bounds.highest_velocity, c.bounds.lowest_acceleration,
              c.bounds.highest_acceleration, c.bounds.jerk);
      // The time depends on the third root of a small error of position.
      REQUIRE(std::abs(t + rest.least_duration() - T) < 3e-4 * (1 + T));
    }
  }
}

TEST_CASE("a start outside the limits is led back inside, and no further out than must be") {
  constexpr unsigned seed = 20264;
  CAPTURE(seed);
  support::Random random(seed);
  int outside = 0;
  for (int k = 0; k < 100'000; ++k) {
    Case c = random_case(random, true);
    c.start.velocity *= random.number(1, 4);
    c.start.acceleration *= random.number(1, 4);
    if (is_viable(c.start, c.bounds, 1)) continue;
    ++outside;
    const StateToStateMotion motion = motion_of(c);
    const MotionBounds& b = c.bounds;
    REQUIRE(motion.exists());
    const TransferMotion way = motion.motion(0);
    const double a = c.start.acceleration, v = c.start.velocity, r = faded(c.start, 1, b.jerk);
    // A strong acceleration fades to its limit first, and the velocity on from there.
    const double highest = std::max({b.highest_velocity, v, r}) * (1 + 1e-9) + 1e-9;
    const double lowest = std::min({b.lowest_velocity, v, r}) * (1 + 1e-9) - 1e-9;
    const double T = way.duration();
    for (int i = 0; i <= 40; ++i) {
      const JointMotion now = way.sample(T * i / 40);
      CAPTURE(k, i, T, v, a, b.lowest_velocity, b.highest_velocity, b.lowest_acceleration,
              b.highest_acceleration, b.jerk, now.velocity, now.acceleration);
      REQUIRE(is_within(lowest, now.velocity, highest));
      REQUIRE(is_within(std::min(a, b.lowest_acceleration), now.acceleration,
                        std::max(a, b.highest_acceleration)));
    }
    REQUIRE(way.sample(T).position == c.target.position);
  }
  CHECK(outside > 20'000);
}

TEST_CASE("nothing to do takes no time, and a target that moves is passed") {
  const MotionBounds bounds = either_way(1, 1, 1);
  CHECK(StateToStateMotion({1, 0, 0}, {1, 0, 0}, bounds).least_duration() == 0);
  CHECK(StateToStateMotion({1, 1, 0}, {1, 1, 0}, bounds).least_duration() == 0);
  CHECK(StateToStateMotion({0, 1, 0}, {1e-4, 1, 0}, bounds).least_duration() ==
        Approx(1e-4).epsilon(1e-9));
  const StateToStateMotion passing({0, 0, 0}, {1, 0.5, 0}, bounds);
  const TransferMotion motion = passing.motion(0);
  CHECK(motion.sample(motion.duration() + 2).position == 2);
  CHECK(motion.sample(motion.duration() + 2).velocity == 0.5);
  // arrived at 1 rad/s with an acceleration that must have come from above the limit
  CHECK_FALSE(StateToStateMotion({0, 0, 0}, {1, 1, -0.5}, bounds).exists());
  CHECK(StateToStateMotion({0, 0, 0}, {1, 1, 0.5}, bounds).exists());
  CHECK_FALSE(StateToStateMotion({0, 0, 0}, {1, 1.1, 0}, bounds).exists());
}

TEST_CASE("all joints arrive together, not before the duration that is asked for") {
  const Profile::Limits limits{{{{-1, 2, -10, 20, 400}, {-5, 10, -20, 50, 1000}}}};
  const JointReference<2> from{{0, 0}, {0.5, -1}, {1, 0}, {1, 2}};
  const JointReference<2> to{{-1, 0.2}, {0, 0.3}, {0, 0}, {3, 2}};
  for (const double minimum : {0.0, 1.5, 4.0}) {
    const Profile profile(from, to, limits, minimum);
    CAPTURE(minimum);
    if (minimum > 1.5) CHECK(profile.duration() == minimum);
    CHECK(profile.duration() >= minimum);
    const auto first = profile.sample(0), end = profile.sample(profile.duration());
    CHECK(first.position == from.position);
    CHECK(first.velocity == from.velocity);
    CHECK(first.acceleration == from.acceleration);
    CHECK(first.effort == from.effort);
    CHECK(end.position == to.position);
    CHECK(end.velocity == to.velocity);
    CHECK(end.effort == to.effort);
    for (int k = 0; k <= 1000; ++k) {
      const auto r = profile.sample(profile.duration() * k / 1000);
      for (int j = 0; j < 2; ++j) {
        const MotionBounds b = limits[j];
        REQUIRE(is_within(b.lowest_velocity - 1e-9, r.velocity[j], b.highest_velocity + 1e-9));
        REQUIRE(is_within(b.lowest_acceleration, r.acceleration[j], b.highest_acceleration));
      }
    }
  }
  CHECK_FALSE(is_finite(Profile(from, to, limits).sample(infinity)));
}

TEST_CASE("from rest to rest it is the jerk-limited profile") {
  constexpr unsigned seed = 20265;
  support::Random random(seed);
  for (int k = 0; k < 20'000; ++k) {
    const auto size = [&] { return std::exp(random.number(-4, 4)); };
    const double V = size(), A = size(), J = size(), D = size();
    CAPTURE(seed, k, V, A, J, D);
    REQUIRE(StateToStateMotion({0}, {D}, either_way(V, A, J)).least_duration() ==
            Approx(rest_to_rest(0, D, V, A, J).duration()).epsilon(1e-12));
  }
}

TEST_CASE("limits and states that make no profile are refused by name") {
  const Profile::Limits limits = both_ways(MotionLimits<2>{{2, 10}, {20, 50}, {400, 1000}});
  const JointReference<2> rest{};
  auto bad = limits;
  bad[1].lowest_velocity = 1;
  CHECK_THROWS_WITH(Profile(rest, rest, bad),
                    Contains("lowest velocity 1 of joint 'elbow_active_joint'"));
  bad = limits;
  bad[0].lowest_velocity = -0.01;
  CHECK_THROWS_WITH(Profile(rest, rest, bad),
                    Contains("lowest velocity -0.01 and highest velocity 2 of joint "
                             "'shoulder_active_joint' differ more than 100 times in size"));
  bad = limits;
  bad[1].highest_acceleration = 0.1;
  CHECK_THROWS_WITH(
      Profile(rest, rest, bad),
      Contains("lowest acceleration -50 and highest acceleration 0.1 of joint 'elbow"));
  for (const double jerk : {1e-5, 1e9}) {
    bad = limits;
    bad[0].jerk = jerk;
    CHECK_THROWS_WITH(Profile(rest, rest, bad),
                      Contains("of joint 'shoulder_active_joint' does not suit velocity 2 and "
                               "acceleration 20: velocity * jerk / acceleration^2 is ") &&
                          Contains("not between 1e-6 and 1e6"));
  }
  bad = limits;
  bad[0].highest_velocity = 3;
  CHECK_THROWS_WITH(Profile(rest, rest, bad), Contains("above the joint's limit 2.27"));
  CHECK_THROWS_WITH(Profile(rest, {.position = {0, 9}}, limits), Contains("position 9"));
  CHECK_THROWS_WITH(Profile(rest, {.velocity = {2.1, 0}}, limits),
                    Contains("target velocity 2.1") && Contains("'shoulder_active_joint'"));
  CHECK_THROWS_WITH(Profile(rest, rest, limits, -1), Contains("minimum duration -1"));
  CHECK_THROWS_WITH(Profile({.position = {not_a_number, 0}}, rest, limits), Contains("finite"));
  // 0.1 rad from its limit at 2 rad/s
  CHECK_THROWS_WITH(Profile({.position = {1.5, 0}, .velocity = {2, 0}}, rest, limits),
                    Contains("'shoulder_active_joint' swings out to 1.6"));
  CHECK(Profile::plan({.position = {1.5, 0}, .velocity = {2, 0}}, rest, limits));
  CHECK_FALSE(Profile::plan({.position = {not_a_number, 0}}, rest, limits));
  CHECK_FALSE(Profile::plan(rest, {.velocity = {2.1, 0}}, limits));
}

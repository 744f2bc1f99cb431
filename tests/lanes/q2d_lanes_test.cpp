// SPDX-License-Identifier: Apache-2.0
// Q2Ds that differ, in lanes and one by one: stops, friction, sensors, delay, and a lane that ends.
#include "lane_arms.hpp"
#include "numbers.hpp"

#include <articula/robots/q2d.hpp>

#include <cstring>

using namespace articula;
using support::not_a_number;

namespace {

using Pack = LanePack<Q2d>;
using Lanes = LaneLoop<Q2d, PidPlusGravity>;

/// Whether two lanes' numbers have the same bits.
template <int N>
bool same_bits(const JointVector<N>& a, const JointVector<N>& b) {
  return std::memcmp(a.data(), b.data(), sizeof(double) * N) == 0;
}

}  // namespace

TEST_CASE("Q2Ds that differ move in lanes as one by one") {
  CHECK(support::compare<Q2d>(1, {}, 2000).at_limit > 100);
}

TEST_CASE("Q2Ds in lanes meet their stops as one by one") {
  CHECK(support::compare<Q2d>(2, {.stop = 0.5}, 2000).at_stop > 100);
}

TEST_CASE("Q2Ds in lanes are held by dry friction as one by one") {
  CHECK(support::compare<Q2d>(3, {.friction = 0.3}, 2000).at_rest > 100);
  const auto seen = support::compare<Q2d>(4, {.friction = 0.3, .stop = 0.5}, 2000);
  CHECK(seen.at_stop > 100);
  CHECK(seen.at_rest > 100);
}

TEST_CASE("Q2Ds in lanes take references of any size as one by one") {
  const auto seen = support::compare<Q2d>(7, {.stop = 1, .hostile = true}, 2000);
  CHECK(seen.at_stop > 100);
  CHECK(seen.at_limit > 100);
}

TEST_CASE("Q2Ds in lanes lose commands of their own") {
  support::compare<Q2d>(6, {.delay = 2, .lost = 0.5}, 1500);
  support::compare<Q2d>(7, {.lost = 1}, 500);
}

TEST_CASE("Q2Ds in lanes have sensors and delays of their own") {
  support::compare<Q2d>(5, {.friction = 0.05, .noise = 1e-4, .resolution = 1e-4, .delay = 3}, 1500);
}

TEST_CASE("A lane that is not finite ends and changes no bit of the others") {
  support::Random random(6);
  const auto setups = support::random_setups<Q2d>(random, {.friction = 0.1, .stop = 1});
  const double bad = GENERATE(not_a_number, support::infinity);
  const int where = GENERATE(0, 1, 2);
  const int lame = 1;
  Lanes healthy(setups), ill(setups);
  for (int cycle = 0; cycle < 600; ++cycle) {
    const double side = (cycle / 200) % 2 == 0 ? 1 : -1;
    for (int k = 0; k < Lanes::lane_count; ++k) {
      healthy.set_reference(k, {.position = {side, -0.5 * side * k}});
      ill.set_reference(k, {.position = {side, -0.5 * side * k}});
    }
    if (cycle == 300) {
      if (where == 0) ill.set_reference(lame, {.position = {0, bad}});
      if (where == 1) ill.set_reference(lame, {.velocity = {0, bad}});
      if (where == 2) ill.simulator().set_external_effort(lame, {bad, 0});
    }
    healthy.update();
    ill.update();
    for (int k = 0; k < Lanes::lane_count; ++k) {
      if (k == lame) continue;
      CAPTURE(cycle, k, bad, where);
      REQUIRE(same_bits(lane_of(ill.state().position, k), lane_of(healthy.state().position, k)));
      REQUIRE(same_bits(lane_of(ill.state().velocity, k), lane_of(healthy.state().velocity, k)));
      REQUIRE(same_bits(lane_of(ill.command().effort, k), lane_of(healthy.command().effort, k)));
      REQUIRE(ill.verdict(k).status == Status::ok);
    }
  }
  const Status expected = where == 2 ? Status::non_finite_state : Status::non_finite_reference;
  CHECK(ill.verdict(lame).status == expected);
  CHECK(ill.verdict(lame).time == Approx(where == 2 ? 0.301 : 0.3));
  CHECK_FALSE(is_true(ill.running(), lame));
  CHECK(lane_of(ill.command().effort, lame) == JointVector<2>::Zero());
  CHECK(is_finite(lane_of(ill.state(), lame)));
  CHECK(lane_of(ill.state().position, lame) == *setups[lame].simulation.initial_position);
}

TEST_CASE("A lane whose command is not finite ends, and large angles stay in their lane") {
  const auto fails_in_lane_0 = [fails = false](const ControlInput<2, Pack>& in) mutable noexcept {
    EffortCommand<2, Pack> command{in.reference.position - in.state.position};
    if (fails) command.effort[1].set(0, not_a_number);
    fails = true;
    return command;
  };
  using Loop = LaneControlLoop<Q2d, std::remove_const_t<decltype(fails_in_lane_0)>>;
  const std::vector<LaneSetup<Q2d>> setups(Loop::lane_count);
  Loop loop(setups, fails_in_lane_0);
  loop.run(10);
  CHECK(loop.verdict(0).status == Status::non_finite_command);
  CHECK(loop.verdict(0).time == Approx(1e-3));
  CHECK(loop.verdict(1).status == Status::ok);
  CHECK(loop.time() == Approx(9e-3));

  const JointVector<2> q{0.3, -0.7}, v{1, 2}, effort{0.1, 0.2};
  JointVector<2, Pack> angles, velocities, efforts;
  for (int k = 0; k < Pack::lanes; ++k) {
    set_lane(angles, k, q);
    set_lane(velocities, k, v);
    set_lane(efforts, k, effort);
  }
  const RobotLanes<Q2d, Pack> robots;
  const auto before = forward_dynamics(robots, angles, velocities, efforts);
  for (const double large : {1e7, support::largest, support::infinity, not_a_number}) {
    angles[1].set(0, large);
    const auto after = forward_dynamics(robots, angles, velocities, efforts);
    CHECK(same_bits(lane_of(after, 1), lane_of(before, 1)));
    CHECK_FALSE(same_bits(lane_of(after, 0), lane_of(before, 0)));
  }
}

TEST_CASE("Lanes without a setup are inactive, and the controller of all lanes goes on") {
  const std::vector<LaneSetup<Q2d>> one(1);
  Lanes lanes(one);
  CHECK(lanes.verdict(0).status == Status::ok);
  CHECK(lanes.verdict(1).status == Status::inactive);
  lanes.set_reference(0, {.position = {-1, 1}});
  lanes.run(2000);
  CHECK((lane_of(lanes.state().position, 0) - JointVector<2>(-1, 1)).norm() < 1e-2);
  CHECK(lane_of(lanes.state().position, 1) == JointVector<2>::Zero());
}

TEST_CASE("Each lane's drives have their own effort limits") {
  auto weak = model_of(Q2d{});
  weak.joints[0].limits.effort = 1;
  std::vector<LaneSetup<Q2d>> setups(2);
  setups[1].robot = VariedRobot<Q2d>(weak);
  LaneSimulator<Q2d> lanes(setups);
  Simulator<VariedRobot<Q2d>> alone(setups[1].robot);
  EffortCommand<2, Pack> command;
  command.effort.setConstant(20.0);
  for (int k = 0; k < 100; ++k) {
    REQUIRE(lanes.write(command) == Status::ok);
    REQUIRE(alone.write(EffortCommand<2>{{20, 20}}) == Status::ok);
  }
  CHECK(lane_of(lanes.true_state().effort, 1)[0] == 1);
  CHECK(lane_of(lanes.true_state().effort, 0)[0] == 20);
  CHECK((lane_of(lanes.true_state().position, 1) - alone.true_state().position).norm() <= 1e-12);
}

TEST_CASE("Setups that cannot run are refused with the lane and the reason") {
  using Catch::Matchers::Contains;
  const auto refusal = [](const auto& change) -> std::string {
    std::vector<LaneSetup<Q2d>> setups(2);
    change(setups);
    try {
      LaneSimulator<Q2d>{setups};
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  CHECK_THAT(refusal([](auto& all) { all.clear(); }), Contains("0 setups are not within 1 .. "));
  CHECK_THAT(refusal([](auto& all) { all.resize(17); }),
             Contains("17 setups are not within 1 .. "));
  CHECK_THAT(refusal([](auto& all) { all[1].simulation.period = 2e-3; }),
             Contains("lane 1: period 0.002 s with 1 substeps differs from lane 0"));
  CHECK_THAT(refusal([](auto& all) { all[1].delay = -1; }), Contains("lane 1: delay -1"));
  CHECK_THAT(refusal([](auto& all) { all[1].lost.share = 1.5; }),
             Contains("lane 1: lost commands: the share 1.5 is not within 0 .. 1"));
  CHECK_THAT(refusal([](auto& all) { all[1].simulation.initial_position = {0, 4}; }),
             Contains("lane 1: simulator: initial_position 4 of joint"));
  CHECK(refusal([](auto&) {}) == "accepted");
}

// SPDX-License-Identifier: Apache-2.0
// Controllers for groups of joints, each at its own rate and switched on its own.
#include <articula/control/bypass.hpp>
#include <articula/control/drive_impedance.hpp>
#include <articula/control/joint_impedance.hpp>
#include <articula/control/limits/limited.hpp>
#include <articula/control/pid.hpp>
#include <articula/control/pid_plus_gravity.hpp>
#include <articula/control/switching/groups.hpp>
#include <articula/control/switching/switch.hpp>
#include <articula/loop/loop.hpp>
#include <articula/robots/q2d.hpp>
#include <articula/sim/simulator.hpp>

#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "by_hand.hpp"
#include "catch.hpp"
#include "hardware/fake_hardware.hpp"
#include "numbers.hpp"
#include "random.hpp"
#include "robots/random_robots.hpp"
#include "robots/test_robots.hpp"

using namespace articula;
using Catch::Matchers::Contains;
using support::not_a_number;
using Arm = support::TiltedQ2d;

namespace {

using Vector = JointVector<2>;
constexpr double dt = 1e-3;
const Name shoulder = "shoulder_active_joint", elbow = "elbow_active_joint";

/// Commands the number of its updates, and keeps its last input.
template <int N>
struct Counter {
  int starts = 0, updates = 0;
  Verdict verdict = Verdict::fine;
  double period = 0, bad = 0;
  JointReference<N> reference{};
  JointVector<N> cut = JointVector<N>::Zero();

  void start(const ControlInput<N>&) noexcept { ++starts; }
  Outcome<EffortCommand<N>> update(const ControlInput<N>& in) noexcept {
    ++updates;
    reference = in.reference;
    period = in.period;
    cut = in.cut;
    return {{JointVector<N>::Constant(updates + bad)}, verdict};
  }
};

/// Asks for nothing, or for what is no number.
template <class R>
struct Faltering {
  double bad = 0;

  EffortCommand<2> update(const ControlInput<2>&) noexcept { return {Vector::Constant(bad)}; }
};

template <class R>
using Parting = Groups<R, Bypass<R>, Faltering<R>>;

using Counters = support::ByHand<Groups<Arm, Counter<2>, Counter<2>>>;
static_assert(Controller<Groups<Arm, Counter<2>, Counter<2>>, 2>);

Counters counters(int divisor_of_shoulder, int divisor_of_elbow) {
  return Counters({{{"s", {shoulder}, divisor_of_shoulder}, {"e", {elbow}, divisor_of_elbow}}}, {},
                  {});
}

template <class R>
using Two = Switch<R, PidPlusGravity<R>, JointImpedance<R>>;

Two<Arm> two() { return Two<Arm>({}, {}, JointImpedance<Arm>({{{50, 5}, {50, 5}}})); }

}  // namespace

TEST_CASE("each group's controller is asked at its own rate, and its command is held between") {
  Counters groups = counters(1, 3);
  groups.start({});
  for (int cycle = 0; cycle < 30; ++cycle) {
    CAPTURE(cycle);
    CHECK(groups.update({}, {}, dt).effort == Vector(cycle + 1, cycle / 3 + 1));
  }
  CHECK(groups.member<0>().period == dt);
  CHECK(groups.member<1>().period == 3 * dt);
  groups.start({});  // all in the first cycle
  CHECK(groups.update({}, {}, dt).effort == Vector(31, 11));
  CHECK(groups.member<1>().starts == 2);
}

TEST_CASE("a group sees all joints as they are, and is asked for its own alone") {
  Counters groups = counters(1, 1);
  JointState<2> state;
  state.position = {1, 2};
  state.velocity = {3, 4};
  JointReference<2> reference;
  reference.position = {5, 6};
  reference.velocity = {7, 8};
  reference.acceleration = {9, 10};
  reference.effort = {11, 12};
  groups.start(state);
  static_cast<void>(groups.update(state, reference, dt));
  const JointReference<2>& own = groups.member<1>().reference;
  CHECK(own.position == Vector(1, 6));
  CHECK(own.velocity == Vector(3, 8));
  CHECK(own.acceleration == Vector(0, 10));
  CHECK(own.effort == Vector(0, 12));
}

TEST_CASE("a group gets what was cut off on its joints in the cycle of its last call") {
  Counters groups = counters(1, 2);
  groups.start({});
  for (int cycle = 0; cycle < 6; ++cycle) {
    CAPTURE(cycle);
    static_cast<void>(groups.update({}, {}, dt));
    CHECK(groups.member<0>().cut == Vector(cycle, 0));
    if (cycle % 2 == 0)
      CHECK(groups.member<1>().cut == Vector(0, cycle == 0 ? 0 : 10 * (cycle - 1)));
    groups.cut_off(Vector(cycle + 1, 10 * (cycle + 1)));
  }
}

TEST_CASE(
    "a group that fails gets the safe command, the others go on, and the verdict is degraded") {
  for (const bool by_verdict : {false, true}) {
    CAPTURE(by_verdict);
    Counters groups = counters(1, 5);
    JointState<2> state;
    state.position = {0.3, -0.7};
    const double safe = gravity(Arm(), state.position)[1];
    REQUIRE(std::abs(safe) > 0.1);
    const auto fails = [&](bool now) {
      groups.member<1>().bad = now && !by_verdict ? not_a_number : 0;
      groups.member<1>().verdict = now && by_verdict ? Verdict::failed : Verdict::fine;
    };
    groups.start(state);
    for (int k = 1; k <= 5; ++k) {
      CHECK(groups.update(state, {}, dt).effort == Vector(k, 1));
      CHECK(groups.verdict == Verdict::fine);
    }
    fails(true);
    for (int k = 6; k <= 8; ++k) {
      CHECK(groups.update(state, {}, dt).effort == Vector(k, safe));
      CHECK(groups.verdict == Verdict::degraded);
      CHECK(groups.status_of(0) == ControllerStatus::active);
      CHECK(groups.status_of(1) == ControllerStatus::failed);
      // It is called in every cycle now, each time with the time since the last call.
      CHECK(groups.member<1>().updates == k - 4);
      CHECK(groups.member<1>().period == (k == 6 ? 5 : 1) * dt);
      CHECK(groups.member<1>().cut == Vector(0, 0));  // the safe command was not its own
      groups.cut_off(Vector(1, 1));
    }
    fails(false);
    for (int k = 9; k <= 13; ++k) {
      CHECK(groups.update(state, {}, dt).effort == Vector(k, 5));
      CHECK(groups.verdict == Verdict::fine);
      CHECK(groups.member<1>().period == dt);
      CHECK(groups.member<1>().cut == Vector(0, 0));
    }
    CHECK(groups.update(state, {}, dt).effort == Vector(14, 6));
    CHECK(groups.member<1>().period == 5 * dt);

    fails(true);
    for (int k = 0; k < 5; ++k) static_cast<void>(groups.update(state, {}, dt));
    CHECK(groups.verdict == Verdict::degraded);
    groups.start(state);
    CHECK(groups.status_of(1) == ControllerStatus::active);
    CHECK(groups.update(state, {}, dt).effort[1] == safe);
    CHECK(groups.member<1>().period == 5 * dt);
  }
}

TEST_CASE("a degraded command of a group counts") {
  Counters groups = counters(1, 5);
  groups.start({});
  groups.member<1>().verdict = Verdict::degraded;
  for (int k = 1; k <= 3; ++k) {  // and is replaced in every cycle
    CHECK(groups.update({}, {}, dt).effort == Vector(k, k));
    CHECK(groups.verdict == Verdict::degraded);
  }
}

TEST_CASE("the joints of a group that fails are braked, within limits around the groups, too") {
  using Free = Model<2>;  // its joints would coast: it has no damping
  const Free robot = support::free_arm<Arm>();
  const auto bare = [&] {
    return Parting<Free>(robot, {{{"s", {shoulder}}, {"e", {elbow}}}}, Bypass<Free>(robot), {});
  };
  CommandLimits<2> limits;
  limits.acceleration = {100, 100};
  support::ByHand<Parting<Free>> groups = bare();
  support::ByHand<Limited<Free, Parting<Free>>> limited(robot, limits, bare());
  const auto speed_after = [&](auto& controller, auto& failing) {
    Simulator<Free> arm(robot, SimulatorOptions<2>{.initial_velocity = Vector(0, -1)});
    JointState<2> state;
    REQUIRE(arm.read(state) == Status::ok);
    controller.start(state);
    failing.bad = not_a_number;
    for (int k = 0; k < 300; ++k) {
      REQUIRE(arm.read(state) == Status::ok);
      JointReference<2> reference;
      reference.effort = gravity(robot, state.position);
      REQUIRE(arm.write(controller.update(state, reference, dt)) == Status::ok);
      REQUIRE(controller.verdict == Verdict::degraded);
    }
    return std::abs(state.velocity[1]);
  };
  // Three time constants leave 5 %; as much again for what the shoulder, which is free, takes
  // along.
  CHECK(speed_after(groups, groups.member<1>()) < 0.1);
  CHECK(speed_after(limited, limited.controller().member<1>()) < 0.1);
}

TEST_CASE("where state or reference are to blame no group is called, and none has failed") {
  using InLoop = Groups<Arm, Counter<2>, Counter<2>>;
  Loop loop{support::FakeHardware<Arm>(), InLoop(counters(1, 1))};
  InLoop& groups = loop.controller();
  CHECK(loop.update() == Status::ok);
  groups.member<0>().bad = not_a_number;
  loop.hardware().measured.velocity[0] = not_a_number;
  CHECK(loop.update() == Status::non_finite_state);
  loop.hardware().measured = {};
  loop.reference().velocity[0] = not_a_number;
  CHECK(loop.update() == Status::non_finite_reference);
  CHECK(groups.status_of(0) == ControllerStatus::active);
  CHECK(groups.status_of(1) == ControllerStatus::active);
  groups.member<0>().bad = 0;
  loop.reference() = {};
  CHECK(loop.update() == Status::ok);
  CHECK(loop.command().effort == Vector(2, 2));  // neither was called with a NaN
}

TEST_CASE("a limited controller brakes its group, and a switch in one goes on from what was safe") {
  using Parts =
      support::ByHand<Groups<Arm, Limited<Arm, Faltering<Arm>>, Switch<Arm, Faltering<Arm>>>>;
  CommandLimits<2> limits = command_limits(Arm());
  limits.acceleration = {20, 40};
  using Alone = Limited<Arm, Faltering<Arm>>;
  Parts parts({{{"s", {shoulder}}, {"e", {elbow}}}}, Alone(limits), Switch<Arm, Faltering<Arm>>());
  support::ByHand<Alone> alone(limits);
  JointState<2> state;
  state.position = {0.5, -0.4};
  state.velocity = {1, -1};
  // Its own motion decays in 0.1 s, whatever the shoulder does.
  const double safe = damping_effort(Arm(), state.position, Vector(0, -1), 0.1)[1];
  REQUIRE(std::abs(safe - gravity(Arm(), state.position)[1]) > 0.1);
  parts.start(state);
  alone.start(state);
  parts.member<0>().controller().bad = alone.controller().bad = not_a_number;
  parts.member<1>().member<0>().bad = not_a_number;
  for (int k = 0; k < 3; ++k) {
    const Vector braking = alone.update(state, {}, dt).effort;
    CHECK((parts.update(state, {}, dt).effort - Vector(braking[0], safe)).norm() < 1e-12);
    CHECK(parts.status_of(0) == ControllerStatus::failed);
    CHECK(parts.status_of(1) == ControllerStatus::failed);
  }
  parts.member<1>().member<0>() = {};
  CHECK(std::abs(parts.update(state, {}, dt).effort[1] - safe) < 1e-12);
  CHECK(parts.status_of(1) == ControllerStatus::active);
}

TEST_CASE("joints in two groups, in none, or unknown are refused by name") {
  using Array = std::array<JointGroup, 2>;
  const auto make = [](const Array& groups) { return Counters(groups, {}, {}); };
  CHECK_THROWS_WITH(make({{{"s", {shoulder}}, {"e", {}}}}),
                    Contains("'elbow_active_joint' is in no group"));
  CHECK_THROWS_WITH(make({{{"s", {shoulder, elbow}}, {"e", {elbow}}}}),
                    Contains("'elbow_active_joint' of group 'e' is in group 's' already"));
  CHECK_THROWS_WITH(make({{{"s", {shoulder, shoulder}}, {"e", {elbow}}}}),
                    Contains("'shoulder_active_joint' of group 's' is in group 's' already"));
  CHECK_THROWS_WITH(make({{{"s", {shoulder}}, {"e", {"wrist"}}}}),
                    Contains("groups: group 'e': ") && Contains("'wrist'"));
  CHECK_THROWS_WITH(make({{{"s", {shoulder}}, {"", {elbow}}}}),
                    Contains("group 2 has no name; expected 2 groups, one for each controller"));
  CHECK_THROWS_WITH(make({{{"s", {shoulder}}, {"s", {elbow}}}}), Contains("two are named 's'"));
  for (const int bad : {0, -1}) {
    CHECK_THROWS_WITH(make({{{"s", {shoulder}}, {"e", {elbow}, bad}}}),
                      Contains("divisor " + std::to_string(bad) + " of group 'e'"));
  }
}

TEST_CASE("on random trees each joint gets its group's command") {
  constexpr unsigned seed = 71;
  CAPTURE(seed);
  support::Random random(seed);
  for (int k = 0; k < 20; ++k) {
    CAPTURE(k);
    const Model<5> robot = support::random_robot(random, 5).model<5>();
    const auto names = joint_names(robot);
    std::array<JointGroup, 3> groups{{{"a"}, {"b"}, {"c"}}};
    std::array<std::size_t, 5> owner{};
    for (std::size_t j = 0; j < 5; ++j) {
      owner[j] = static_cast<std::size_t>(random.integer(0, 2));
      groups[owner[j]].joints.push_back(names[j]);
    }
    for (auto& group : groups) group.divisor = random.integer(1, 4);
    using C = Counter<5>;
    support::ByHand<Groups<Model<5>, C, C, C>> together(robot, groups, C{.bad = 0.1}, C{.bad = 0.2},
                                                        C{.bad = 0.3});
    together.start({});
    for (int cycle = 0; cycle < 12; ++cycle) {
      const auto effort = together.update({}, {}, dt).effort;
      for (std::size_t j = 0; j < 5; ++j) {
        const int updates = cycle / groups[owner[j]].divisor + 1;
        REQUIRE(effort[static_cast<int>(j)] == updates + 0.1 * static_cast<double>(owner[j] + 1));
      }
    }
  }
}

TEST_CASE("springs in the drives: all numbers of a joint come from its group") {
  using C = DriveImpedance<Arm>;
  support::ByHand<Groups<Arm, C, C>> groups({{{"s", {shoulder}}, {"e", {elbow}, 2}}},
                                            C({{{1, 2}, {3, 4}}}), C({{{5, 6}, {7, 8}}}));
  JointReference<2> reference;
  reference.position = {0.5, 0.25};
  groups.start({});
  const auto command = groups.update({}, reference, dt);
  CHECK(command.stiffness == Vector(1, 7));
  CHECK(command.damping == Vector(2, 8));
  CHECK(command.position == reference.position);
  CHECK(command.effort == gravity(Arm(), Vector(0, 0)));
}

TEST_CASE("groups are switched on their own, by the group's name, or together") {
  using Parts = support::ByHand<Groups<Arm, Two<Arm>, Two<Arm>>>;
  static_assert(Switching<Parts> && Parts::controller_count == 4);
  Parts parts({{{"s", {shoulder}}, {"e", {elbow}, 5}}}, two(), two());
  const auto states = [&] {
    std::string text;
    for (const auto& c : parts.list()) {
      text += std::string(c.name.view()) + (c.status == ControllerStatus::active ? "*; " : "; ");
    }
    return text;
  };
  CHECK(states() ==
        "s/pid_plus_gravity*; s/joint_impedance; e/pid_plus_gravity*; e/joint_impedance; ");
  parts.start({});
  CHECK(parts.request({.start = {"e/joint_impedance"}, .replace = true}).answer ==
        SwitchAnswer::done);
  static_cast<void>(parts.update({}, {}, dt));
  CHECK(states() ==
        "s/pid_plus_gravity*; s/joint_impedance; e/pid_plus_gravity; e/joint_impedance*; ");

  // A strict request is done on all groups or on none.
  SwitchRequest both{.start = {"s/joint_impedance", "e/joint_impedance"}, .replace = true};
  CHECK(parts.request(both).answer == SwitchAnswer::already_active);
  for (int k = 0; k < 10; ++k) static_cast<void>(parts.update({}, {}, dt));
  CHECK(parts.member<0>().active() == "pid_plus_gravity");
  both.strictness = Strictness::best_effort;
  const SwitchOutcome outcome = parts.request(both);
  CHECK(outcome.answer == SwitchAnswer::already_active);
  CHECK(outcome.controller == "e/joint_impedance");
  CHECK(outcome.started == 1);
  for (int k = 0; k < 10; ++k) static_cast<void>(parts.update({}, {}, dt));
  CHECK(states() ==
        "s/pid_plus_gravity; s/joint_impedance*; e/pid_plus_gravity; e/joint_impedance*; ");
  CHECK(parts
            .request({.stop = {"s/joint_impedance", "e/joint_impedance"},
                      .start = {"s/pid_plus_gravity", "e/pid_plus_gravity"}})
            .started == 2);
  CHECK(parts.request({.start = {"joint_impedance"}}).answer == SwitchAnswer::unknown_name);
}

TEST_CASE("switches of groups make no step, and their limited ones can be reached") {
  using Careful = Limited<Arm, Two<Arm>>;
  using Parts = support::ByHand<Groups<Arm, Two<Arm>, Careful>>;
  static_assert(Parts::controller_count == 4);
  CommandLimits<2> limits = command_limits(Arm());
  limits.acceleration = {200, 400};
  Parts parts({{{"s", {shoulder}, 2}, {"e", {elbow}}}}, two(), Careful(limits, two()));
  Simulator<Arm> arm;
  JointState<2> state;
  REQUIRE(arm.read(state) == Status::ok);
  JointReference<2> reference;
  reference.position = state.position;
  parts.start(state);
  Vector before = parts.update(state, reference, dt).effort;
  const Vector slew = parts.member<0>().slew();
  for (int cycle = 1; cycle < 2000; ++cycle) {
    CAPTURE(cycle);
    const bool even = cycle / 100 % 2 == 0;
    if (cycle % 100 == 0) {
      CHECK(parts
                .request({.start = {even ? "s/pid_plus_gravity" : "s/joint_impedance",
                                    even ? "e/pid_plus_gravity" : "e/joint_impedance"},
                          .replace = true})
                .answer == SwitchAnswer::done);
    }
    REQUIRE(arm.read(state) == Status::ok);
    const auto command = parts.update(state, reference, dt);
    REQUIRE(arm.write(command) == Status::ok);
    // The shoulder's group takes two periods at once; the arm itself hardly moves.
    const Vector step = (command.effort - before).cwiseAbs();
    REQUIRE(step[0] <= 2 * slew[0] * dt + 0.05);
    REQUIRE(step[1] <= slew[1] * dt + 0.05);
    before = command.effort;
  }
}

TEST_CASE("gains reach the one group that takes them") {
  using Mixed = Groups<Arm, Pid<Arm>, JointImpedance<Arm>>;
  static_assert(TakesGains<Mixed, ValidPidGains<2>> && TakesGains<Mixed, ValidImpedanceGains<2>>);
  static_assert(!TakesGains<Groups<Arm, Pid<Arm>, Pid<Arm>>, ValidPidGains<2>>);
  Mixed mixed({{{"s", {shoulder}}, {"e", {elbow}}}}, {}, JointImpedance<Arm>({}));
  const PidGains g{.proportional = 7};
  set_gains(mixed, ValidPidGains<2>({g, g}, joint_names(Arm())));
  CHECK(mixed.member<0>().part<PidLaw<2>>().gains()[1].proportional == 7);
}

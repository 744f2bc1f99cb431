// SPDX-License-Identifier: Apache-2.0
// Loops of eight arms in packs against eight loops of one arm each. Both do the same operations for
// each arm, in the same order, so they give the same bits. Where the processor fuses
// multiplications and additions, compilers fuse other ones in packs. The rounding then differs by
// some 1e-16 in each cycle, which the closed loops keep from growing: 1e-9 in two seconds.
#include "catch.hpp"
#include "test_robots.hpp"

#include <articula/articula.hpp>
#include <articula/robots/panda.hpp>
#include <articula/robots/q2d.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

using namespace articula;
using support::TiltedQ2d;

namespace {

using Pack = symbolic::Pack<>;

constexpr int arms = 8;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
#if defined(__FMA__) || defined(__FP_FAST_FMA)
constexpr double tolerance = 1e-9;
#else
constexpr double tolerance = 0;
#endif

bool agree(const JointVector<2>& a, const JointVector<2>& b) {
  return (a - b).cwiseAbs().maxCoeff() <= tolerance;
}

/// The effort that moves an arm before its loop begins, so that each begins elsewhere.
JointVector<2> push(int arm) { return {0.5 * (arm - 3), 0.2 * (4 - arm)}; }

/// What an arm is asked to do: the first four take small steps, the others large ones, which
/// saturate their drives.
JointReference<2> asked(int arm, int cycle) {
  const double size = arm < 4 ? 0.02 * (arm + 1) : 0.5 * (arm - 2);
  const double side = (cycle / 400) % 2 == 0 ? 1 : -1;
  const double rate = 3 + arm, phase = rate * cycle * 1e-3;
  return {.position = {side * size, 0.3 * size * std::sin(phase)},
          .velocity = {0, 0.3 * size * rate * std::cos(phase)},
          .acceleration = {0, -0.3 * size * rate * rate * std::sin(phase)},
          .effort = {0.1 * arm, -0.01 * arm}};
}

/// Eight loops of one arm, and the loops of packs of these.
template <template <class, class> class C, class R>
struct Arms {
  using PackLoop = ControlLoop<Simulator<R, Pack>, C<R, Pack>>;
  using SingleLoop = ControlLoop<Simulator<R>, C<R, double>>;

  Arms(const C<R, double>& single, const C<R, Pack>& packed) {
    for (int first = 0; first < arms; first += Pack::lanes) {
      Simulator<R, Pack> together;
      EffortCommand<2, Pack> command;
      for (int k = 0; k < Pack::lanes; ++k) set_lane(command.effort, k, push(first + k));
      for (int cycle = 0; cycle < 200; ++cycle) REQUIRE(together.write(command) == Status::ok);
      packs.emplace_back(together, packed);
    }
    for (int arm = 0; arm < arms; ++arm) {
      Simulator<R> own;
      for (int cycle = 0; cycle < 200; ++cycle) {
        REQUIRE(own.write(EffortCommand<2>{push(arm)}) == Status::ok);
      }
      alone.emplace_back(own, single);
    }
  }

  void ask(int arm, const JointReference<2>& reference) {
    alone[static_cast<std::size_t>(arm)].reference() = reference;
    auto& packed = packs[static_cast<std::size_t>(arm / Pack::lanes)].reference();
    const int k = arm % Pack::lanes;
    set_lane(packed.position, k, reference.position);
    set_lane(packed.velocity, k, reference.velocity);
    set_lane(packed.acceleration, k, reference.acceleration);
    set_lane(packed.effort, k, reference.effort);
  }

  void update(Status expected = Status::ok) {
    for (PackLoop& loop : packs) REQUIRE(loop.update() == expected);
    for (SingleLoop& loop : alone) REQUIRE(loop.update() == expected);
  }

  void compare() const {
    for (int arm = 0; arm < arms; ++arm) {
      const SingleLoop& own = alone[static_cast<std::size_t>(arm)];
      const PackLoop& pack = packs[static_cast<std::size_t>(arm / Pack::lanes)];
      const int k = arm % Pack::lanes;
      CAPTURE(arm, own.time());
      REQUIRE(agree(lane_of(pack.state().position, k), own.state().position));
      REQUIRE(agree(lane_of(pack.state().velocity, k), own.state().velocity));
      REQUIRE(agree(lane_of(pack.command(), k).effort, own.command().effort));
    }
  }

  [[nodiscard]] bool at_limit(int arm, int joint) const {
    const double effort = alone[static_cast<std::size_t>(arm)].command().effort[joint];
    return std::abs(effort) == effort_limits(R())[joint];
  }

  std::vector<PackLoop> packs;
  std::vector<SingleLoop> alone;
};

/// Runs all loops for two seconds. The lanes part ways: in many cycles some arms of a pack
/// saturate, and others do not.
/// @param look  called with all after each cycle
template <template <class, class> class C, class R>
void run(Arms<C, R>& all, const auto& look) {
  int parted = 0;
  for (int cycle = 0; cycle < 2000; ++cycle) {
    for (int arm = 0; arm < arms; ++arm) all.ask(arm, asked(arm, cycle));
    all.update();
    all.compare();
    look(all);
    for (int first = 0; first < arms; first += Pack::lanes) {
      int saturated = 0;
      for (int k = 0; k < Pack::lanes; ++k) saturated += all.at_limit(first + k, 0) ? 1 : 0;
      if (saturated > 0 && saturated < Pack::lanes) ++parted;
    }
  }
  CAPTURE(parted);
  CHECK(parted > 100);
}
template <template <class, class> class C, class R>
void run(Arms<C, R>& all) {
  run(all, [](const auto&) {});
}

/// Gains whose integrals reach their clamps in some arms.
template <class R>
JointPidGains<2> gains(AntiWindup anti_windup) {
  JointPidGains<2> all = R::pid_gains;
  for (PidGains& g : all) {
    g.integral = 40;
    g.integral_clamp_min = -0.5;
    g.integral_clamp_max = 0.5;
    g.anti_windup = anti_windup;
    g.error_deadband = 1e-3;
  }
  all[1].derivative_of = DerivativeOf::error;
  all[1].derivative_filter_time = 5e-3;
  all[1].position_weight = 0.8;
  all[1].output_clamp_max = 5;
  return all;
}

constexpr AntiWindup ways[] = {AntiWindup::none, AntiWindup::back_calculation,
                               AntiWindup::conditional_integration};

}  // namespace

TEST_CASE("Each arm of a pack under PID moves as it would alone") {
  for (const AntiWindup way : ways) {
    CAPTURE(static_cast<int>(way));
    Arms all(Pid<Q2d>(gains<Q2d>(way)), Pid<Q2d, Pack>(gains<Q2d>(way)));
    int clamped = 0;  // cycles in which the integrals of some arms are at their clamps
    run(all, [&](const auto& loops) {
      int at_clamp = 0;
      for (const auto& loop : loops.alone) {
        const double integral = loop.controller().template part<PidLaw<2>>().integral()[0];
        if (std::abs(integral) == 0.5) ++at_clamp;
      }
      if (at_clamp > 0 && at_clamp < arms) ++clamped;
    });
    CAPTURE(clamped);
    if (way == AntiWindup::none) CHECK(clamped > 100);
  }
}

TEST_CASE("Each arm of a pack under PID plus gravity moves as it would alone") {
  for (const AntiWindup way : ways) {
    CAPTURE(static_cast<int>(way));
    Arms all(PidPlusGravity<TiltedQ2d>(gains<TiltedQ2d>(way)),
             PidPlusGravity<TiltedQ2d, Pack>(gains<TiltedQ2d>(way)));
    run(all);
  }
}

TEST_CASE("Each arm of a pack under computed torque moves as it would alone") {
  for (const AntiWindup way : ways) {
    CAPTURE(static_cast<int>(way));
    auto all_gains = ComputedTorque<TiltedQ2d>::critically_damped(20);
    for (PidGains& g : all_gains) {
      g.integral = 500;
      g.integral_clamp_min = -20;
      g.integral_clamp_max = 20;
      g.anti_windup = way;
    }
    Arms all{ComputedTorque<TiltedQ2d>(all_gains), ComputedTorque<TiltedQ2d, Pack>(all_gains)};
    run(all);
  }
}

TEST_CASE("A cut of one arm's effort takes nothing from the integrals of the others") {
  auto all_gains = ComputedTorque<Panda>::critically_damped(20);
  for (PidGains& g : all_gains) g.integral = 500;
  const Panda robot;
  ComputedTorqueLaw<Panda, Pack> together(robot, all_gains);
  std::vector<ComputedTorqueLaw<Panda>> alone(Pack::lanes, {robot, all_gains});
  JointState<7, Pack> states;
  JointReference<7, Pack> references;
  JointVector<7, Pack> cut = JointVector<7, Pack>::Zero();
  cut[3].set(0, 2.0);
  for (int cycle = 0; cycle < 20; ++cycle) {
    for (int k = 0; k < Pack::lanes; ++k) {
      const auto wave = [&](double phase) {
        return for_each_joint<7>([&](int j) { return std::sin(phase + 0.1 * cycle + j + k); });
      };
      set_lane(states.position, k, wave(0));
      set_lane(references.position, k, wave(0.1));
    }
    const JointVector<7, Pack> output = together.output({states, references, 1e-3, {}, cut});
    for (int k = 0; k < Pack::lanes; ++k) {
      const JointState<7> state = lane_of(states, k);
      const JointReference<7> reference{.position = lane_of(references.position, k)};
      const JointVector<7> own =
          alone[static_cast<std::size_t>(k)].output({state, reference, 1e-3, {}, lane_of(cut, k)});
      CAPTURE(k, cycle);
      CHECK((lane_of(output, k) - own).norm() <= 1e-9);
    }
  }
}

TEST_CASE("A reference that is not finite for one arm makes the cycle bad for its pack") {
  const auto way = AntiWindup::conditional_integration;
  Arms all(PidPlusGravity<TiltedQ2d>(gains<TiltedQ2d>(way)),
           PidPlusGravity<TiltedQ2d, Pack>(gains<TiltedQ2d>(way)));
  for (int cycle = 0; cycle < 900; ++cycle) {
    for (int arm = 0; arm < arms; ++arm) all.ask(arm, asked(arm, cycle));
    // Each arm alone holds in the same cycles as its pack. Two cycles are borne, eight are not.
    const bool bad = (cycle >= 300 && cycle < 302) || (cycle >= 600 && cycle < 608);
    if (bad) {
      for (auto& loop : all.alone) loop.reference().position[1] = not_a_number;
      for (auto& loop : all.packs) loop.reference().position[1].set(Pack::lanes - 1, not_a_number);
    }
    all.update(bad ? Status::non_finite_reference : Status::ok);
    all.compare();
    if (!bad) continue;
    for (auto& loop : all.packs) {
      const auto weight = gravity(TiltedQ2d(), loop.state().position);
      for (int k = 0; k < Pack::lanes; ++k) {
        REQUIRE(agree(lane_of(loop.command(), k).effort, lane_of(weight, k)));
      }
    }
  }
}

TEST_CASE("A command that is not finite for one arm fails the cycle of its pack, and all hold") {
  bool fails = false;
  Loop loop{Simulator<TiltedQ2d, Pack>(), [&fails](const ControlInput<2, Pack>& in) noexcept {
              EffortCommand<2, Pack> command{in.reference.position - in.state.position};
              if (fails) command.effort[0].set(0, not_a_number);
              return command;
            }};
  REQUIRE(loop.update() == Status::ok);
  fails = true;
  CHECK(loop.update() == Status::non_finite_command);
  const auto weight = gravity(TiltedQ2d(), loop.state().position);
  for (int k = 0; k < Pack::lanes; ++k) {
    CHECK(agree(lane_of(loop.command(), k).effort, lane_of(weight, k)));
  }
  fails = false;
  CHECK(loop.update() == Status::ok);
}

TEST_CASE("The safe command of each arm of a pack is that of the arm alone") {
  const TiltedQ2d robot;
  JointVector<2, Pack> position;
  for (int k = 0; k < Pack::lanes; ++k) set_lane(position, k, JointVector<2>(0.3 * k, -0.2));
  position[1].set(0, not_a_number);
  const auto check = [&](auto last) {
    const auto safe = safe_command(robot, position, last);
    for (int k = 0; k < Pack::lanes; ++k) {
      const auto own = safe_command(robot, lane_of(position, k), lane_of(last, k));
      for (std::size_t part = 0; part < parts_of(own).size(); ++part) {
        const auto of_lane = lane_of(safe, k);
        CAPTURE(k, part);
        CHECK(agree(*parts_of(of_lane)[part].values, *parts_of(own)[part].values));
      }
    }
  };
  check(EffortCommand<2, Pack>{JointVector<2, Pack>::Constant(3)});
  check(PositionCommand<2, Pack>{JointVector<2, Pack>::Constant(0.4)});
  check(VelocityCommand<2, Pack>{JointVector<2, Pack>::Constant(0.4)});
  const auto full = JointVector<2, Pack>::Constant(7);
  check(MultiModeCommand<2, Pack>{full, full, full, full, full});
}

TEST_CASE("The other controllers command each arm of a pack as it would be alone") {
  JointState<2, Pack> states;
  JointReference<2, Pack> references;
  for (int k = 0; k < Pack::lanes; ++k) {
    set_lane(states.position, k, JointVector<2>(0.3 * k, -0.2));
    set_lane(states.velocity, k, JointVector<2>(-0.1, 0.2 * k));
    const JointReference<2> own = asked(k, 17);
    set_lane(references.position, k, own.position);
    set_lane(references.velocity, k, own.velocity);
    set_lane(references.effort, k, own.effort);
  }
  const auto check = [&](auto single, auto packed) {
    start_controller(packed, ControlInput<2, Pack>{states, references, 1e-3});
    const auto together =
        update_controller(packed, ControlInput<2, Pack>{states, references, 1e-3});
    CHECK(together.verdict == Verdict::fine);
    for (int k = 0; k < Pack::lanes; ++k) {
      const JointState<2> state = lane_of(states, k);
      const JointReference<2> reference{.position = lane_of(references.position, k),
                                        .velocity = lane_of(references.velocity, k),
                                        .effort = lane_of(references.effort, k)};
      start_controller(single, ControlInput<2>{state, reference, 1e-3});
      const auto own = update_controller(single, ControlInput<2>{state, reference, 1e-3});
      const auto of_lane = lane_of(together.command, k);
      for (std::size_t part = 0; part < parts_of(of_lane).size(); ++part) {
        CAPTURE(k, part);
        CHECK(agree(*parts_of(of_lane)[part].values, *parts_of(own.command)[part].values));
      }
    }
  };
  JointPidGains<2> slow{};
  for (PidGains& g : slow) g.proportional = 3, g.integral = 1;
  const JointImpedanceGains<2> springs{{{20, 2}, {10, 1}}};
  check(Bypass<TiltedQ2d>(), Bypass<TiltedQ2d, Pack>());
  check(ForwardPosition<TiltedQ2d>(), ForwardPosition<TiltedQ2d, Pack>());
  check(ForwardVelocity<TiltedQ2d>(), ForwardVelocity<TiltedQ2d, Pack>());
  check(PositionByVelocity<TiltedQ2d>(slow), PositionByVelocity<TiltedQ2d, Pack>(slow));
  check(VelocityByEffort<TiltedQ2d>(slow), VelocityByEffort<TiltedQ2d, Pack>(slow));
  check(JointImpedance<TiltedQ2d>(springs), JointImpedance<TiltedQ2d, Pack>(springs));
  check(DriveImpedance<TiltedQ2d>(springs), DriveImpedance<TiltedQ2d, Pack>(springs));
}

TEST_CASE("A loop of a pack is written as that of one arm") {
  Loop<Simulator<Q2d, Pack>, PidPlusGravity> loop;
  for (int k = 0; k < Pack::lanes; ++k) {
    set_lane(loop.reference().position, k, JointVector<2>(-1.0 + 0.1 * k, 1.0));
  }
  for (int k = 0; k < 2000; ++k) REQUIRE(loop.update() == Status::ok);
  for (int k = 0; k < Pack::lanes; ++k) {
    const JointVector<2> there = lane_of(loop.state().position, k);
    CHECK((there - JointVector<2>(-1.0 + 0.1 * k, 1.0)).norm() < 1e-3);
  }
}

// SPDX-License-Identifier: Apache-2.0
// Loops of eight arms in packs against eight loops of one arm each. Both do the same operations for
// each arm, in the same order, so they give the same bits. Where the processor fuses
// multiplications and additions, compilers fuse other ones in packs. The rounding then differs by
// some 1e-16 in each cycle, which the closed loops keep from growing: 1e-9 in two seconds.
#include "catch.hpp"
#include "robots/test_robots.hpp"

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
// Fused operations round otherwise. Within 1200 cycles states part by up to 2e-11, which gains of
// 2310 N m/rad and their derivatives make 1e-9 N m; ten times that.
constexpr double tolerance = 1e-8;
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

namespace {

template <class R, class S>
using Careful = Limited<R, PidPlusGravity<R, S>>;
template <class R, class S>
using Modes = Switch<R, PidPlusGravity<R, S>, ComputedTorque<R, S>, JointImpedance<R, S>>;

CommandLimits<2> tight_limits() {
  CommandLimits<2> limits = command_limits(TiltedQ2d());
  limits.lower = {-0.6, -0.4};
  limits.upper = {0.6, 0.4};
  limits.velocity = {1.5, 2};
  limits.acceleration = {20, 40};
  limits.jerk = {2000, 4000};
  limits.effort_rate = {2000, 500};
  return limits;
}

/// Lets a controller of a pack and controllers of single arms follow measured arms whose motion
/// does not depend on them, which serves every kind of command.
template <class Single, class Packed>
void follow(const Single& single, Packed together, const auto& disturb) {
  std::vector<Single> alone(Pack::lanes, single);
  JointState<2, Pack> states;
  JointReference<2, Pack> references;
  Applied<2, Pack> applied;
  int changed = 0;  // cycles in which the limits or the transfer change the command of an arm
  for (int cycle = 0; cycle < 400; ++cycle) {
    for (int k = 0; k < Pack::lanes; ++k) {
      const double phase = 4e-3 * (k + 2) * cycle;
      const JointVector<2> rate(4.0 * (k + 2), -4.0 * (k + 2));
      set_lane(states.position, k, JointVector<2>(0.2 * std::sin(phase), 0.3 * std::cos(phase)));
      set_lane(states.velocity, k,
               JointVector<2>(0.2 * rate[0] * std::cos(phase), 0.3 * rate[1] * std::sin(phase)));
      const JointReference<2> own = asked(k + 2, 7 * cycle);
      set_lane(references.position, k, own.position);
      set_lane(references.velocity, k, own.velocity);
      set_lane(references.effort, k, own.effort);
    }
    disturb(together, cycle);
    for (Single& own : alone) disturb(own, cycle);
    const ControlInput<2, Pack> in{states, references, 1e-3, applied};
    if (cycle == 0) start_controller(together, in);
    const auto outcome = update_controller(together, in);
    const JointVector<2, Pack> numbers = numbers_of(outcome.command, states);
    bool any = false;
    for_each_lane(in, [&](int k, const ControlInput<2>& own_in) {
      Single& own_controller = alone[static_cast<std::size_t>(k)];
      if (cycle == 0) start_controller(own_controller, own_in);
      const auto own = update_controller(own_controller, own_in);
      CAPTURE(cycle, k);
      CHECK(own.verdict == outcome.verdict);
      const auto of_lane = lane_of(outcome.command, k);
      for (std::size_t part = 0; part < parts_of(own.command).size(); ++part) {
        CAPTURE(part);
        REQUIRE(agree(*parts_of(of_lane)[part].values, *parts_of(own.command)[part].values));
      }
      if constexpr (requires { own_controller.report(); }) {
        for (int j = 0; j < 2; ++j) {
          const JointLimitReport& report = own_controller.report()[j];
          CHECK(together.report(k)[j].position == report.position);
          CHECK(together.report(k)[j].any() == report.any());
          CHECK(std::abs(together.report(k)[j].asked - report.asked) <= tolerance);
        }
        any = any || own_controller.report()[0].any();
      } else if constexpr (requires { own_controller.carried(); }) {
        any = any || own_controller.carried()[0] != 0;
      } else {
        any = true;
      }
    });
    if (any) ++changed;
    applied = {numbers, Held::load};
  }
  CHECK(changed > 10);
}

}  // namespace

TEST_CASE("Each arm of a pack within limits of motion moves as it would alone") {
  const auto own = gains<TiltedQ2d>(AntiWindup::conditional_integration);
  Arms<Careful, TiltedQ2d> all({tight_limits(), PidPlusGravity<TiltedQ2d>(own)},
                               {tight_limits(), PidPlusGravity<TiltedQ2d, Pack>(own)});
  int parted = 0;  // cycles in which the limits hold some arms back, and others not
  for (int cycle = 0; cycle < 1200; ++cycle) {
    for (int arm = 0; arm < arms; ++arm) all.ask(arm, asked(arm, cycle));
    const bool bad = cycle >= 700 && cycle < 720;  // the arm brakes within its limits
    if (bad) {
      for (auto& loop : all.alone) loop.reference().position[1] = not_a_number;
      for (auto& loop : all.packs) loop.reference().position[1].set(Pack::lanes - 1, not_a_number);
    }
    all.update(bad ? Status::non_finite_reference : Status::ok);
    all.compare();
    int held = 0;
    for (auto& loop : all.alone) held += loop.controller().report()[0].any() ? 1 : 0;
    if (held > 0 && held < arms) ++parted;
  }
  CHECK(parted > 100);
}

TEST_CASE("Each arm of a pack moves as it would alone when its controllers switch") {
  const auto own = gains<TiltedQ2d>(AntiWindup::back_calculation);
  const auto stiff = ComputedTorque<TiltedQ2d>::critically_damped(20);
  const JointImpedanceGains<2> springs{{{20, 2}, {10, 1}}};
  const SwitchOptions<2> options{.fallbacks = {{"computed_torque", {"joint_impedance"}}}};
  const auto modes = [&]<class S>(S) {
    return Modes<TiltedQ2d, S>(options, PidPlusGravity<TiltedQ2d, S>(own),
                               ComputedTorque<TiltedQ2d, S>(stiff),
                               JointImpedance<TiltedQ2d, S>(springs));
  };
  Arms<Modes, TiltedQ2d> all(modes(0.0), modes(Pack(0)));
  int carrying = 0;
  for (int cycle = 0; cycle < 1200; ++cycle) {
    SwitchRequest request{.replace = true};
    if (cycle == 200) request.start = {"computed_torque"};
    if (cycle == 250) request.start = {"joint_impedance"};
    if (cycle == 600) request.stop = {"joint_impedance"};  // none is active: standby
    if (cycle == 800) request.start = {"pid_plus_gravity"};
    for (auto& loop : all.alone) {
      CHECK(loop.controller().request(request).answer == SwitchAnswer::done);
    }
    for (auto& loop : all.packs) {
      CHECK(loop.controller().request(request).answer == SwitchAnswer::done);
    }
    for (int arm = 0; arm < arms; ++arm) all.ask(arm, asked(arm, cycle));
    all.update();
    all.compare();
    for (int arm = 0; arm < arms; ++arm) {
      const auto& single = all.alone[static_cast<std::size_t>(arm)].controller();
      const auto& packed = all.packs[static_cast<std::size_t>(arm / Pack::lanes)].controller();
      REQUIRE(packed.active() == single.active());
      REQUIRE(agree(lane_of(packed.carried(), arm % Pack::lanes), single.carried()));
      if (single.carried()[0] != 0) ++carrying;
    }
  }
  CHECK(carrying > 100);
}

TEST_CASE(
    "Limits and switches of the other commands treat each arm of a pack as they would alone") {
  const CommandLimits<2> limits = tight_limits();
  const JointImpedanceGains<2> springs{{{20, 2}, {10, 1}}}, stiffer{{{90, 4}, {60, 2}}};
  using R = TiltedQ2d;
  const auto leave = [](auto&, int) {};
  follow(Limited(R(), limits, ForwardPosition<R>()),
         Limited(R(), limits, ForwardPosition<R, Pack>()), leave);
  follow(Limited(R(), limits, ForwardVelocity<R>()),
         Limited(R(), limits, ForwardVelocity<R, Pack>()), leave);
  follow(Limited(R(), limits, DriveImpedance<R>(springs)),
         Limited(R(), limits, DriveImpedance<R, Pack>(springs)), leave);
  const auto toggle = [](auto& controllers, int cycle) {
    if (cycle % 50 != 49) return;
    const bool first = controllers.active() == controllers.name_of(0);
    const Name next = controllers.name_of(first ? 1 : 0);
    CHECK(controllers.request({.start = {next}, .replace = true}).started == 1);
  };
  const auto both = [&]<class S>(S) {
    return Switch<R, DriveImpedance<R, S>, DriveImpedance<R, S>>(
        SwitchOptions<2>{}, DriveImpedance<R, S>(springs), DriveImpedance<R, S>(stiffer));
  };
  follow(both(0.0), both(Pack(0)), toggle);
}

TEST_CASE("Groups of joints command each arm of a pack as it would be alone") {
  using R = TiltedQ2d;
  const auto parts = std::array{JointGroup{"upper", {"shoulder_active_joint"}},
                                JointGroup{"lower", {"elbow_active_joint"}, 3}};
  const JointImpedanceGains<2> springs{{{20, 2}, {10, 1}}};
  const auto own = gains<R>(AntiWindup::conditional_integration);
  follow(Groups(R(), parts, PidPlusGravity<R>(own), JointImpedance<R>(springs)),
         Groups(R(), parts, PidPlusGravity<R, Pack>(own), JointImpedance<R, Pack>(springs)),
         [](auto&, int) {});
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

// SPDX-License-Identifier: Apache-2.0
#include <articula/articula.hpp>
#include <articula/hardware/mock/mock_hardware.hpp>
#include <articula/loop/run.hpp>
#include <articula/loop/simulated_clock.hpp>
#include <articula/loop/supervision/supervised_loop.hpp>

#include <memory>
#include <stdexcept>
#include <vector>

#include "catch.hpp"
#include "numbers.hpp"
#include "robots/test_robots.hpp"
#include "test_controllers.hpp"

using namespace articula;
using support::TiltedQ2d, support::not_a_number;
using Kind = MockFaultKind;

namespace {

using Mock = MockHardware<TiltedQ2d>;
using MockLoop = SupervisedLoop<Mock, PidPlusGravity>;

JointState<2> state_at(double shoulder, double elbow) {
  JointState<2> state;
  state.position = {shoulder, elbow};
  return state;
}

JointReference<2> reference_at(double shoulder, double elbow) {
  JointReference<2> reference;
  reference.position = {shoulder, elbow};
  return reference;
}

template <class AnyLoop>
void cycles(AnyLoop& loop, int count) {
  for (int k = 0; k < count; ++k) static_cast<void>(loop.update());
}

/// From inactive until the second good cycle, after which references are taken.
template <class AnyLoop>
void activate(AnyLoop& loop) {
  loop.request_activation();
  CHECK(loop.update() == Status::inactive);
  REQUIRE(loop.mode() == LoopMode::active);
  REQUIRE(loop.update() == Status::ok);
}

template <class>
struct FollowVelocity {
  VelocityCommand<2> update(const ControlInput<2>& in) noexcept { return {in.reference.velocity}; }
};

// The mock stands still, so what a PD holds it with is the weight.
EffortCommand<2> weight_at(const JointState<2>& state) {
  return {gravity(TiltedQ2d(), state.position)};
}

}  // namespace

TEST_CASE("nothing is written and the hardware is not active before activation") {
  MockLoop loop;
  CHECK(loop.mode() == LoopMode::inactive);
  for (int k = 0; k < 10; ++k) {
    loop.post(reference_at(1, 1));
    CHECK(loop.update() == Status::inactive);
  }
  CHECK_FALSE(loop.hardware().active());
  CHECK(loop.hardware().writes() == 0);
  CHECK(loop.hardware().readings() == 11);  // one by the constructor: it watches
}

TEST_CASE("at activation nothing jumps: the reference is where the arm is by then") {
  MockLoop loop;
  cycles(loop, 3);
  loop.post(reference_at(1, -1));  // before activation: dropped
  const JointState<2> moved = state_at(0.5, -0.25);
  loop.hardware().set_state(moved);
  loop.request_activation();
  CHECK(loop.update() == Status::inactive);
  CHECK(loop.hardware().active());
  CHECK(loop.hardware().written().effort == weight_at(moved).effort);
  CHECK(loop.reference().position == moved.position);
  loop.post(reference_at(1, -1));  // before the first cycle under control: dropped
  CHECK(loop.update() == Status::ok);
  CHECK(loop.reference().position == moved.position);
  CHECK(loop.command().effort == weight_at(moved).effort);
  loop.post(reference_at(0.4, -0.2));
  CHECK(loop.update() == Status::ok);
  CHECK(loop.reference().position == reference_at(0.4, -0.2).position);
}

TEST_CASE("the simulated arm goes where it is told under supervision, as under Loop alone") {
  Loop<Q2dSim, PidPlusGravity> alone;
  SupervisedLoop<Q2dSim, PidPlusGravity> loop;
  activate(loop);
  const JointReference<2> reference = reference_at(-1, 1);
  loop.post(reference);
  static_cast<void>(alone.update());
  alone.reference() = reference;
  for (int k = 0; k < 1000; ++k) {
    REQUIRE(loop.update() == Status::ok);
    REQUIRE(alone.update() == Status::ok);
  }
  CHECK(loop.state().position == alone.state().position);
  CHECK(loop.command().effort == alone.command().effort);
}

TEST_CASE("few bad cycles are borne with, one more is a fault") {
  struct Row {
    Kind kind;
    int joint;
    double value;
    Status status;
  };
  const std::vector<Row> rows{
      {Kind::fails_to_read, -1, 0, Status::hardware_fault},
      {Kind::fails_to_write, -1, 0, Status::hardware_fault},
      {Kind::goes_silent, 1, 0, Status::stale_state},
      {Kind::measures_nan, 0, 0, Status::non_finite_state},
      {Kind::measures_position, 0, 2.0, Status::limit_exceeded},
      {Kind::measures_velocity, 1, -30.0, Status::limit_exceeded},
  };
  for (const Row& row : rows) {
    CAPTURE(static_cast<int>(row.kind), row.joint);
    const int tolerated = 2;
    // Reading 0 is the constructor's, 1 and 2 are those of activate().
    for (const std::uint64_t bad : {2U, 3U}) {
      MockLoop loop(Mock({{row.kind, 5, bad, row.joint, row.value}}), {.bad_cycles = tolerated});
      activate(loop);
      cycles(loop, 2);
      for (std::uint64_t k = 0; k < bad; ++k) CHECK(loop.update() == row.status);
      if (bad == 2U) {
        CHECK(loop.mode() == LoopMode::active);
        CHECK(loop.update() == Status::ok);
      } else {
        CHECK(loop.mode() == LoopMode::fault);
        CHECK(loop.fault() == row.status);
        CHECK(loop.update() == row.status);  // also when all is well again
        CHECK(loop.mode() == LoopMode::fault);
      }
    }
  }
}

TEST_CASE("a controller that computes NaN is a fault, and its command never arrives") {
  SupervisedLoop<Mock, support::ConstantEffort> loop;
  activate(loop);
  loop.controller().effort = not_a_number;
  for (int k = 0; k < 4; ++k) CHECK(loop.update() == Status::non_finite_command);
  CHECK(loop.mode() == LoopMode::fault);
  CHECK(is_finite(loop.hardware().written()));
}

TEST_CASE("a reference that is not finite is a fault") {
  MockLoop loop;
  activate(loop);
  loop.post(reference_at(not_a_number, 0));
  for (int k = 0; k < 4; ++k) CHECK(loop.update() == Status::non_finite_reference);
  CHECK(loop.mode() == LoopMode::fault);
  CHECK(is_finite(loop.hardware().written()));
}

TEST_CASE("a reference that outlives its lifetime is a fault, and its successors are dropped") {
  MockLoop loop(Mock(), {.reference_lifetime = 0.0105});
  activate(loop);
  for (int k = 0; k < 20; ++k) {
    loop.post(reference_at(0.01, 0));
    REQUIRE(loop.update() == Status::ok);
  }
  for (int k = 0; k < 10; ++k) REQUIRE(loop.update() == Status::ok);
  CHECK(loop.update() == Status::stale_reference);
  CHECK(loop.mode() == LoopMode::fault);

  // What was sent meanwhile is not replayed, whatever happens then.
  loop.post(reference_at(1, 1));
  cycles(loop, 3);
  loop.post(reference_at(1, 1));
  loop.acknowledge_fault();
  CHECK(loop.update() == Status::inactive);
  CHECK(loop.mode() == LoopMode::inactive);
  CHECK_FALSE(loop.hardware().active());
  loop.post(reference_at(1, 1));
  activate(loop);
  CHECK(loop.reference().position == loop.state().position);
  CHECK(loop.command().effort == weight_at(loop.state()).effort);
}

TEST_CASE("only an acknowledged fault can be left") {
  MockLoop loop(Mock({{Kind::fails_to_read, 4, 4}}), {.bad_cycles = 0});
  activate(loop);
  cycles(loop, 3);
  REQUIRE(loop.mode() == LoopMode::fault);
  loop.request_activation();
  cycles(loop, 10);
  CHECK(loop.mode() == LoopMode::fault);
  loop.request_deactivation();
  cycles(loop, 10);
  CHECK(loop.mode() == LoopMode::fault);
  loop.acknowledge_fault();
  cycles(loop, 1);
  CHECK(loop.mode() == LoopMode::inactive);
  activate(loop);
}

TEST_CASE("an acknowledgement without a fault does nothing") {
  MockLoop loop;
  loop.acknowledge_fault();
  cycles(loop, 1);
  CHECK(loop.mode() == LoopMode::inactive);
  activate(loop);
  loop.acknowledge_fault();
  cycles(loop, 1);
  CHECK(loop.mode() == LoopMode::active);
}

TEST_CASE("hardware that refuses activation is written nothing") {
  MockLoop loop(Mock({{Kind::refuses_activation, 0, 3}}));
  loop.request_activation();
  CHECK(loop.update() == Status::hardware_fault);
  CHECK(loop.mode() == LoopMode::fault);
  cycles(loop, 5);
  CHECK(loop.hardware().writes() == 0);
  loop.acknowledge_fault();
  cycles(loop, 1);
  activate(loop);
}

TEST_CASE("a good state must come within the start time") {
  MockLoop loop(Mock({{Kind::goes_silent, 0, 1000}}), {.start_time = 0.0205});
  loop.request_activation();
  for (int k = 0; k < 20; ++k) {
    CHECK(loop.update() == Status::inactive);
    CHECK(loop.mode() == LoopMode::starting);
    CHECK(loop.command().effort == weight_at(loop.state()).effort);
  }
  cycles(loop, 2);
  CHECK(loop.mode() == LoopMode::fault);
  CHECK(loop.fault() == Status::stale_state);
}

TEST_CASE("overruns are borne with so far") {
  MockLoop loop(Mock(), {.overruns = 2});
  loop.missed_periods(1);
  loop.missed_periods(1);
  loop.missed_periods(1);  // while inactive they do not count
  activate(loop);
  loop.missed_periods(1);
  loop.missed_periods(5);
  CHECK(loop.mode() == LoopMode::active);
  cycles(loop, 1001);  // a second later they are forgotten
  loop.missed_periods(1);
  loop.missed_periods(1);
  CHECK(loop.mode() == LoopMode::active);
  loop.missed_periods(1);
  CHECK(loop.mode() == LoopMode::fault);
  CHECK(loop.update() == Status::overrun);
}

TEST_CASE("missed periods make references older") {
  MockLoop loop(Mock(), {.reference_lifetime = 0.01});
  activate(loop);
  loop.missed_periods(20);
  CHECK(loop.update() == Status::stale_reference);
}

TEST_CASE("the behaviours: the controller holds, the motion is damped, the drives give nothing") {
  // The tilted arm on its way; then its references stop.
  const auto faulty = [](SafeBehaviour behaviour) {
    auto loop = std::make_unique<SupervisedLoop<Simulator<TiltedQ2d>, PidPlusGravity>>(
        SupervisionOptions{.behaviour = behaviour, .reference_lifetime = 0.05});
    activate(*loop);
    loop->post(reference_at(-1, 1));
    while (loop->mode() == LoopMode::active) static_cast<void>(loop->update());
    REQUIRE(loop->fault() == Status::stale_reference);
    return loop;
  };
  SECTION("hold") {
    auto loop = faulty(SafeBehaviour::hold);
    const JointVector<2> there = loop->reference().position;
    cycles(*loop, 3000);
    CHECK((loop->state().position - there).norm() < 1e-4);  // what the integral has left of it
    CHECK(loop->state().velocity.norm() < 1e-3);
  }
  SECTION("damp") {
    auto loop = faulty(SafeBehaviour::damp);
    const JointVector<2> there = loop->state().position;
    cycles(*loop, 3000);
    CHECK(loop->state().velocity.norm() < 1e-6);  // e^-30 of what it was, and damping helps
    CHECK((loop->state().position - there).norm() < 0.2);
    const auto weight = gravity(TiltedQ2d(), loop->state().position);
    CHECK((loop->command().effort - weight).norm() < 1e-3);
  }
  SECTION("zero effort") {
    auto loop = faulty(SafeBehaviour::zero_effort);
    cycles(*loop, 10);
    CHECK(loop->command().effort.isZero(0));
  }
}

TEST_CASE("a state that cannot be trusted gets no effort built on it") {
  for (const SafeBehaviour behaviour : {SafeBehaviour::hold, SafeBehaviour::damp}) {
    MockLoop loop(Mock({{Kind::fails_to_read, 4, 100}}), {.behaviour = behaviour, .bad_cycles = 1});
    loop.hardware().set_state(state_at(0.3, 0.3));
    activate(loop);
    cycles(loop, 5);
    CHECK(loop.mode() == LoopMode::fault);
    CHECK(loop.command().effort.isZero(0));
  }
}

TEST_CASE("a controller that holds in a fault and cannot any more gives way to damping") {
  MockLoop loop(Mock({{Kind::measures_velocity, 20, 1, 1, 100.0}}),
                {.behaviour = SafeBehaviour::hold, .reference_lifetime = 0.005});
  activate(loop);
  cycles(loop, 10);
  REQUIRE(loop.fault() == Status::stale_reference);
  JointState<2> pushed = loop.state();
  pushed.velocity = {0.5, 0.5};
  cycles(loop, 30);
  loop.hardware().set_state(pushed);
  cycles(loop, 1);
  const auto damping = damping_effort(TiltedQ2d(), pushed.position, pushed.velocity, 0.1);
  CHECK((loop.command().effort - damping).norm() < 1e-12);
}

TEST_CASE("position and velocity drives stay where they were commanded last, or stop") {
  SECTION("position") {
    using PositionMock = MockHardware<TiltedQ2d, PositionCommand<2>>;
    SupervisedLoop<PositionMock, support::PositionForward> loop(PositionMock(),
                                                                {.reference_lifetime = 0.01});
    activate(loop);
    loop.post(reference_at(0.1, 0.2));
    cycles(loop, 5);
    CHECK(loop.command().position == reference_at(0.1, 0.2).position);
    cycles(loop, 20);
    CHECK(loop.mode() == LoopMode::fault);
    loop.hardware().set_state(state_at(0.09, 0.19));  // sagging a little
    cycles(loop, 5);
    CHECK(loop.command().position == reference_at(0.1, 0.2).position);
  }
  SECTION("velocity") {
    using VelocityMock = MockHardware<TiltedQ2d, VelocityCommand<2>>;
    SupervisedLoop<VelocityMock, FollowVelocity> loop(VelocityMock(), {.reference_lifetime = 0.01});
    activate(loop);
    JointReference<2> reference;
    reference.velocity = {0.1, 0.2};
    loop.post(reference);
    cycles(loop, 5);
    CHECK(loop.command().velocity == reference.velocity);
    cycles(loop, 20);
    CHECK(loop.mode() == LoopMode::fault);
    CHECK(loop.command().velocity.isZero(0));
  }
}

namespace {

template <class R>
struct Springs : DriveImpedance<R> {
  Springs() : DriveImpedance<R>({{{100, 10}, {100, 10}}}) {}
};

}  // namespace

TEST_CASE("drives with springs hold where the joints are, or give nothing") {
  using SpringMock = MockHardware<TiltedQ2d, MultiModeCommand<2>>;
  for (const SafeBehaviour behaviour : {SafeBehaviour::damp, SafeBehaviour::zero_effort}) {
    SupervisedLoop<SpringMock, Springs> loop(SpringMock(),
                                             {.behaviour = behaviour, .reference_lifetime = 0.01});
    activate(loop);
    loop.post(reference_at(0.1, 0.2));
    cycles(loop, 5);
    CHECK(loop.command().stiffness == JointVector<2>(100, 100));
    cycles(loop, 20);
    CHECK(loop.mode() == LoopMode::fault);
    const bool holds = behaviour == SafeBehaviour::damp;
    CHECK(loop.command().stiffness == JointVector<2>::Constant(holds ? 100 : 0));
    CHECK(loop.command().damping == JointVector<2>::Constant(holds ? 10 : 0));
    CHECK(loop.command().effort.isZero(0) == !holds);  // it carries the weight
    if (holds) CHECK(loop.command().position == loop.state().position);
  }
}

TEST_CASE("deactivation writes a safe command, then the hardware is inactive") {
  MockLoop loop;
  loop.hardware().set_state(state_at(0.2, 0.2));
  activate(loop);
  const auto writes = loop.hardware().writes();
  loop.request_deactivation();
  CHECK(loop.update() == Status::inactive);
  CHECK(loop.mode() == LoopMode::inactive);
  CHECK(loop.hardware().writes() == writes + 1);
  CHECK(loop.hardware().written().effort == weight_at(loop.state()).effort);
  CHECK_FALSE(loop.hardware().active());
  cycles(loop, 3);
  CHECK(loop.hardware().writes() == writes + 1);
}

TEST_CASE("options that make no sense are refused by name") {
  using Catch::Matchers::Contains;
  CHECK_THROWS_WITH(MockLoop(SupervisionOptions{.bad_cycles = -1}), Contains("bad_cycles -1"));
  CHECK_THROWS_WITH(MockLoop(SupervisionOptions{.overruns = -1}), Contains("overruns -1"));
  CHECK_THROWS_WITH(MockLoop(SupervisionOptions{.reference_lifetime = not_a_number}),
                    Contains("reference_lifetime nan"));
  CHECK_THROWS_WITH(MockLoop(SupervisionOptions{.position_margin = -1}),
                    Contains("position_margin"));
  CHECK_THROWS_WITH(MockLoop(SupervisionOptions{.velocity_margin = -1}),
                    Contains("velocity_margin"));
  CHECK_THROWS_WITH(MockLoop(SupervisionOptions{.start_time = -1}), Contains("start_time"));
  CHECK_THROWS_WITH(MockLoop(SupervisionOptions{.damping_time = 0.001}),
                    Contains("damping_time 0.001 is not at least 0.002"));
}

TEST_CASE("the runner stops a supervised loop and tells it of missed periods") {
  SupervisedLoop<Q2dSim, PidPlusGravity> loop(SupervisionOptions{.overruns = 3});
  loop.request_activation();
  SimulatedClock clock;
  const RunReport report = run(loop, clock, {.cycles = 1000}, [&](auto& l, const RunReport& r) {
    if (r.cycles > 100) clock.advance(std::chrono::milliseconds(5));
    return l.mode() != LoopMode::fault;
  });
  CHECK(report.end == RunEnd::declined);
  // The fourth is the fault; the function above sees it in the cycle after, which overruns as well.
  CHECK(report.overruns == 5);
  CHECK(loop.fault() == Status::overrun);
  CHECK(loop.mode() == LoopMode::inactive);
}

TEST_CASE("a supervised loop has the period of its hardware") {
  using Simulated = SupervisedLoop<Simulator<TiltedQ2d>, PidPlusGravity>;
  Simulated loop(Simulator<TiltedQ2d>({.period = 0.01, .substeps = 8}));
  CHECK(loop.period() == 0.01);
  CHECK_THROWS_AS(Simulated(Simulator<TiltedQ2d>({.period = 0.01, .substeps = 8}),
                            PidPlusGravity<TiltedQ2d>(), {}, 1e-3),
                  std::invalid_argument);
}

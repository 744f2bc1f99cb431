// SPDX-License-Identifier: Apache-2.0
// What a loop puts into a controller's input, and which controllers it takes: functions, plain
// structs and templates, alone and within limits, switches and groups.
#include <articula/articula.hpp>
#include <articula/robots/q2d.hpp>

#include <vector>

#include "catch.hpp"
#include "hardware/fake_hardware.hpp"
#include "numbers.hpp"
#include "robots/test_robots.hpp"
#include "test_controllers.hpp"

using namespace articula;
using support::FakeHardware;
using support::infinity;
using support::not_a_number;
using Arm = support::TiltedQ2d;

namespace {

using Vector = JointVector<2>;
const std::array<JointGroup, 2> both{
    {{"s", {"shoulder_active_joint"}}, {"e", {"elbow_active_joint"}}}};

/// What a controller got in a call.
struct Call {
  bool starts = false;
  Applied<2> applied{};
  Vector cut{};
};

/// Commands one effort and keeps its inputs.
struct Witness {
  Vector effort{1, 2};
  Verdict verdict = Verdict::fine;
  std::vector<Call> calls{};

  void start(const ControlInput<2>& in) noexcept { calls.push_back({true, in.applied, in.cut}); }
  Outcome<EffortCommand<2>> update(const ControlInput<2>& in) noexcept {
    calls.push_back({false, in.applied, in.cut});
    return {{effort}, verdict};
  }
};

/// A loop that has done some good cycles.
auto witnessed_loop() {
  FakeHardware<Arm> hardware;
  hardware.measured.position = {0.3, -0.7};
  ControlLoop loop{hardware, Witness{}};
  for (int k = 0; k < 3; ++k) REQUIRE(loop.update() == Status::ok);
  return loop;
}

/// A spring of 50 N m/rad, in three forms.
constexpr auto spring_function = [](const ControlInput<2>& in) noexcept {
  return EffortCommand<2>{50 * (in.reference.position - in.state.position)};
};
struct SpringStruct {
  EffortCommand<2> update(const ControlInput<2>& in) noexcept { return spring_function(in); }
};
template <class R>
struct SpringTemplate : SpringStruct {};

CommandLimits<2> limits() {
  CommandLimits<2> limits = command_limits(Arm());
  limits.acceleration = {20, 40};
  return limits;
}

/// The efforts of some cycles towards a position.
std::vector<Vector> efforts(auto controller) {
  ControlLoop loop{Simulator<Arm>(), controller};
  loop.reference().position = {0.2, -0.1};
  std::vector<Vector> all;
  for (int k = 0; k < 100; ++k) {
    REQUIRE(loop.update() == Status::ok);
    all.push_back(loop.command().effort);
  }
  return all;
}

}  // namespace

TEST_CASE("a function, a plain struct and a template are controllers alike") {
  const std::vector<Vector> alone = efforts(spring_function);
  CHECK(efforts(SpringStruct{}) == alone);
  CHECK(efforts(SpringTemplate<Arm>{}) == alone);
  Loop<Simulator<Arm>, SpringTemplate> loop;
  CHECK(loop.update() == Status::ok);
}

TEST_CASE("so they are within limits, in a switch and in groups") {
  const std::vector<Vector> limited = efforts(Limited(Arm(), limits(), SpringTemplate<Arm>{}));
  CHECK(efforts(Limited(Arm(), limits(), SpringStruct{})) == limited);
  CHECK(efforts(Limited(Arm(), limits(), spring_function)) == limited);
  const std::vector<Vector> alone = efforts(spring_function);
  CHECK(efforts(Switch(Arm(), {}, spring_function, SpringStruct{})) == alone);
  CHECK(efforts(Switch(Arm(), {}, SpringStruct{}, spring_function)) == alone);
  CHECK(efforts(Groups(Arm(), both, spring_function, SpringStruct{})) == alone);
  CHECK(efforts(Groups(Arm(), both, SpringTemplate<Arm>{}, spring_function)) == alone);
}

TEST_CASE("at a cold start nothing was applied; then it is what was written") {
  const auto loop = witnessed_loop();
  const std::vector<Call>& calls = loop.controller().calls;
  REQUIRE(calls.size() == 4);
  CHECK(calls[0].starts);
  for (const std::size_t k : {0U, 1U}) CHECK(calls[k].applied.held == Held::nothing);
  for (const std::size_t k : {2U, 3U}) {
    CHECK(calls[k].applied.held == Held::push);
    CHECK(calls[k].applied.numbers == Vector(1, 2));
    CHECK(calls[k].cut == Vector(0, 0));
  }
}

TEST_CASE("what the loop cuts off at the drives' limits is in the controller's next cut") {
  auto loop = witnessed_loop();
  loop.controller().effort = {30, -2};
  REQUIRE(loop.update() == Status::ok);
  CHECK(loop.command().effort == Vector(27.94, -2));
  // Borne bad cycles leave applied and cut as they are.
  loop.hardware().reading = Status::stale_state;
  for (int k = 0; k < loop.borne_cycles; ++k) CHECK(loop.update() == Status::stale_state);
  loop.hardware().reading = Status::ok;
  REQUIRE(loop.update() == Status::ok);
  const Call& last = loop.controller().calls.back();
  CHECK_FALSE(last.starts);
  CHECK(last.applied.numbers == Vector(27.94, -2));
  CHECK((last.cut - Vector(30 - 27.94, 0)).norm() < 1e-14);
}

TEST_CASE("an integral of one's own does not wind up behind the loop's limit") {
  struct Integrating {
    Vector integral{0, 0};
    EffortCommand<2> update(const ControlInput<2>& in) noexcept {
      for (int j = 0; j < 2; ++j) {
        if (in.cut[j] == 0) integral[j] += 1e4 * in.period;
      }
      return {integral};
    }
  };
  ControlLoop loop{FakeHardware<Arm>(), Integrating{}};
  for (int k = 0; k < 1000; ++k) REQUIRE(loop.update() == Status::ok);
  CHECK((loop.controller().integral - Vector(27.94, 13.62)).maxCoeff() <= 10);  // one step
}

TEST_CASE("after more bad cycles than are borne the input says what the last command has done") {
  auto loop = witnessed_loop();
  const Vector weight = gravity(Arm(), loop.state().position);
  Held expected = Held::load;
  Vector numbers = weight;
  SECTION("the reference was to blame: the joints were held") {
    loop.reference().velocity[0] = not_a_number;
    for (int k = 0; k < 10; ++k) CHECK(loop.update() == Status::non_finite_reference);
    loop.reference().velocity[0] = 0;
  }
  SECTION("the joints' state was not finite: they were lost") {
    loop.hardware().measured.velocity[0] = not_a_number;
    for (int k = 0; k < 10; ++k) CHECK(loop.update() == Status::non_finite_state);
    loop.hardware().measured.velocity[0] = 0;
    expected = Held::unsure;
  }
  SECTION("the hardware could not be read: they were lost at once") {
    loop.hardware().reading = Status::hardware_fault;
    CHECK(loop.update() == Status::hardware_fault);
    loop.hardware().reading = Status::ok;
    expected = Held::unsure;
    numbers.setZero();
  }
  SECTION("the drives were not active: nothing was applied") {
    loop.hardware().reading = Status::inactive;
    CHECK(loop.update() == Status::inactive);
    loop.hardware().reading = Status::ok;
    expected = Held::nothing;
    numbers.setZero();
  }
  const std::size_t before = loop.controller().calls.size();
  REQUIRE(loop.update() == Status::ok);
  const std::vector<Call>& calls = loop.controller().calls;
  REQUIRE(calls.size() == before + 2);
  CHECK(calls[before].starts);
  for (const std::size_t k : {before, before + 1}) {
    CHECK(calls[k].applied.held == expected);
    CHECK(calls[k].applied.numbers == numbers);
    CHECK(calls[k].cut == Vector(0, 0));
  }
}

TEST_CASE("the verdict decides what is written, and the status reports it") {
  auto loop = witnessed_loop();
  const Vector weight = gravity(Arm(), loop.state().position);
  loop.controller().verdict = Verdict::degraded;
  CHECK(loop.update() == Status::non_finite_command);
  CHECK(loop.command().effort == Vector(1, 2));
  loop.controller().verdict = Verdict::failed;
  CHECK(loop.update() == Status::non_finite_command);
  CHECK(loop.command().effort == weight);
  loop.controller().verdict = Verdict::fine;
  CHECK(loop.update() == Status::ok);
  const Call& after = loop.controller().calls.back();
  CHECK(after.applied.numbers == weight);  // which was written in place of the failed one
  CHECK(after.cut == Vector(0, 0));
  CHECK(loop.command().effort == Vector(1, 2));
}

TEST_CASE(
    "a wrong measurement never reaches limits, and no command that is not finite is written") {
  for (const double wrong : {not_a_number, infinity, -infinity}) {
    const auto survives = [&](auto hardware, auto controller) {
      ControlLoop loop{hardware, Limited(Arm(), limits(), controller)};
      for (auto member :
           {&JointState<2>::position, &JointState<2>::velocity, &JointState<2>::effort}) {
        CHECK(loop.update() == Status::ok);
        (loop.hardware().measured.*member)[0] = wrong;
        CHECK(loop.update() == Status::non_finite_state);
        CHECK_FALSE(loop.controller().report()[0].non_finite);
        loop.hardware().measured = {};
      }
      CHECK(loop.update() == Status::ok);
      CHECK_FALSE(loop.hardware().was_given_non_finite);
      return loop;
    };
    CAPTURE(wrong);
    survives(FakeHardware<Arm>(), PidPlusGravity<Arm>(Q2d::pid_gains));
    survives(FakeHardware<Arm, PositionCommand<2>>(), ForwardPosition<Arm>());
    const auto velocities =
        survives(FakeHardware<Arm, VelocityCommand<2>>(), ForwardVelocity<Arm>());
    CHECK(velocities.command().velocity == Vector(0, 0));
    survives(FakeHardware<Arm, MultiModeCommand<2>>(), DriveImpedance<Arm>({{{9, 1}, {9, 1}}}));
  }
}

TEST_CASE("before any position is known limits command none, and no velocity") {
  FakeHardware<Arm, PositionCommand<2>> hardware;
  hardware.measured.position.setConstant(not_a_number);
  ControlLoop positions{hardware, Limited(Arm(), limits(), ForwardPosition<Arm>())};
  CHECK(positions.update() == Status::non_finite_state);
  CHECK(positions.hardware().writes == 0);
  FakeHardware<Arm, VelocityCommand<2>> drives;
  drives.measured.position.setConstant(not_a_number);
  ControlLoop velocities{drives, Limited(Arm(), limits(), ForwardVelocity<Arm>())};
  velocities.reference().velocity = {1, 1};
  CHECK(velocities.update() == Status::non_finite_state);
  CHECK(velocities.hardware().written.velocity == Vector(0, 0));
}

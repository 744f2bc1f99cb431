// SPDX-License-Identifier: Apache-2.0
#include <articula/control/computed_torque.hpp>
#include <articula/control/laws/pid_gains.hpp>
#include <articula/control/pid.hpp>
#include <articula/control/pid_plus_gravity.hpp>
#include <articula/robots/q2d.hpp>

#include <string>
#include <vector>

#include "catch.hpp"
#include "numbers.hpp"

using namespace articula;
using Catch::Matchers::Contains;
using support::infinity;
using support::not_a_number;

namespace {

struct BadGain {
  double PidGains::* member;
  double value;
  std::string gain;  // what the message must name
  std::string text;  // how it writes the value
};

const std::vector<BadGain> bad_gains{
    {&PidGains::proportional, not_a_number, "proportional", "nan"},
    {&PidGains::proportional, infinity, "proportional", "inf"},
    {&PidGains::proportional, -infinity, "proportional", "-inf"},
    {&PidGains::integral, not_a_number, "integral ", "nan"},
    {&PidGains::integral, infinity, "integral ", "inf"},
    {&PidGains::integral, -infinity, "integral ", "-inf"},
    {&PidGains::derivative, not_a_number, "derivative", "nan"},
    {&PidGains::derivative, infinity, "derivative", "inf"},
    {&PidGains::derivative, -infinity, "derivative", "-inf"},
    {&PidGains::proportional, -1500, "proportional", "-1500"},
    {&PidGains::integral, -1e-9, "integral ", "-1e-09"},
    {&PidGains::derivative, -0.5, "derivative", "-0.5"},
    {&PidGains::integral_clamp_min, not_a_number, "integral_clamp_min", "nan"},
    {&PidGains::integral_clamp_max, not_a_number, "integral_clamp_max", "nan"},
    {&PidGains::integral_clamp_min, 14, "integral_clamp_min", "14"},        // above the max, 13.62
    {&PidGains::integral_clamp_max, -14.5, "integral_clamp_max", "-14.5"},  // below the min
    // A sign forgotten: in order, but a full effort at rest.
    {&PidGains::integral_clamp_min, 13.62, "integral_clamp_min", "13.62"},
    {&PidGains::integral_clamp_max, -1e-9, "integral_clamp_max", "-1e-09"},
    {&PidGains::output_clamp_min, 1, "output_clamp_min", "1"},
    {&PidGains::output_clamp_max, -1, "output_clamp_max", "-1"}};

template <class Controller>
void refuses(const JointPidGains<2>& gains, const BadGain& bad) {
  REQUIRE_THROWS_AS(Controller(gains), std::invalid_argument);
  CHECK_THROWS_WITH(Controller(gains),
                    Contains("'elbow_active_joint'") && Contains(bad.gain) && Contains(bad.text));
}

}  // namespace

TEST_CASE("bad gains are refused by every controller, naming joint, gain and value") {
  for (const BadGain& bad : bad_gains) {
    CAPTURE(bad.gain, bad.text);
    JointPidGains<2> gains = Q2d::pid_gains;
    gains[1].*bad.member = bad.value;
    refuses<Pid<Q2d>>(gains, bad);
    refuses<PidPlusGravity<Q2d>>(gains, bad);
    refuses<ComputedTorque<Q2d>>(gains, bad);
  }
}

TEST_CASE("the message names the first bad joint") {
  JointPidGains<2> gains = Q2d::pid_gains;
  gains[0].proportional = gains[1].proportional = not_a_number;
  CHECK_THROWS_WITH(Pid<Q2d>(gains), Contains("'shoulder_active_joint'"));
}

TEST_CASE("a value that no enumerator has is named together with those that exist") {
  CHECK_THROWS_WITH(
      Pid<Q2d>({PidGains{.anti_windup = static_cast<AntiWindup>(7)}, PidGains{}}),
      Contains("anti_windup 7 is no value of AntiWindup: write none, back_calculation or"));
  CHECK_THROWS_WITH(
      Pid<Q2d>({PidGains{.derivative_of = static_cast<DerivativeOf>(2)}, PidGains{}}),
      Contains("derivative_of 2 is no value of DerivativeOf: write measured_velocity"));
}

TEST_CASE("gains that look odd but work are accepted") {
  CHECK_NOTHROW(Pid<Q2d>({PidGains{}, PidGains{}}));  // clamps at -inf, inf: none
  CHECK_NOTHROW(Pid<Q2d>({PidGains{.proportional = 0.0, .integral_clamp_max = 0},
                          PidGains{.integral_clamp_min = 0, .integral_clamp_max = 0}}));
}

TEST_CASE("back-calculation without a time to compute is refused where it has an integral") {
  PidGains alone{.integral = 5, .anti_windup = AntiWindup::back_calculation};
  CHECK_THROWS_WITH(Pid<Q2d>({alone, PidGains{}}),
                    Contains("'shoulder_active_joint': tracking_time 0 with back_calculation") &&
                        Contains("Set a tracking_time > 0 [s]"));
  PidGains told = alone;
  told.tracking_time = 0.1;
  CHECK_NOTHROW(Pid<Q2d>({told, PidGains{}}));
  alone.integral = 0;
  CHECK_NOTHROW(Pid<Q2d>({alone, PidGains{}}));
}

// The integral lies between its clamps, so it would be infinite from the first cycle on.
TEST_CASE("clamps that leave no finite integral are refused") {
  for (const double clamp : {infinity, -infinity}) {
    CAPTURE(clamp);
    CHECK_THROWS_AS(
        Pid<Q2d>({PidGains{.integral_clamp_min = clamp, .integral_clamp_max = clamp}, PidGains{}}),
        std::invalid_argument);
  }
}

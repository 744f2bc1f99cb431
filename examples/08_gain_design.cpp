// SPDX-License-Identifier: Apache-2.0
// Gain design for the Q2D. The program checks a course's gains, shows a slip in its inertia, and
// designs gains for the correct one. The plant is (1/I)/(s (s + 1/T)), the crossover
// 2 pi/(10.97 T), and the phase margin 60 degrees.
#include <articula/articula.hpp>
#include <articula/robots/q2d.hpp>

#include <cstdio>
#include <numbers>

using namespace articula;

constexpr double degree = std::numbers::pi / 180;

/// Prints the loop of these gains on a joint with this inertia [kg m^2] and time constant [s].
void judge(const char* what, double inertia, double time_constant, const PidGains& gains) {
  const JointPlant plant{.inertia = inertia, .time_constant = time_constant};
  const double crossover = 2 * std::numbers::pi / 10.97 / time_constant;
  const LoopGain loop(plant, gains);
  const StepMetrics step = step_metrics(plant, gains, {.duration = 3});
  std::printf("%s, I %.6f: p %.0f i %.0f d %.3f\n", what, inertia, gains.proportional,
              gains.integral, gains.derivative);
  std::printf(
      "  |L| %.3f, margin %.1f deg; |L| 1 at %.1f rad/s; overshoot %.1f %%, settled %.0f ms\n",
      loop.magnitude(crossover), 180 + loop.phase(crossover) / degree,
      stability_margins(loop).crossovers.back().frequency, 100 * *step.overshoot(),
      1e3 * *step.settling_time());
}

int main() {
  // The course uses inertias about centres of mass, of each joint with its whole load.
  const JointVector<2> stretched(0, 0);
  const CarriedBody shoulder = carried_body(Q2d(), stretched, "shoulder_active_joint");
  const CarriedBody elbow = carried_body(Q2d(), stretched, "elbow_active_joint");
  // The slip: the shoulder's mass already contains the elbow's, but the sum of all moments is
  // divided by both. The reference point of the inertia is then not the centre of mass.
  const double wrong = shoulder.mass * shoulder.lever / (shoulder.mass + elbow.mass);
  const double off = shoulder.lever - wrong;
  const double slip = shoulder.about_center + shoulder.mass * off * off;
  std::printf("centre of mass at %.4f m, by the slip at %.4f m\n", shoulder.lever, wrong);

  judge("elbow, course", elbow.about_center, 0.004, Q2d::pid_gains[1]);
  judge("shoulder, course", slip, 0.005, Q2d::pid_gains[0]);
  judge("shoulder, without the slip", shoulder.about_center, 0.005, Q2d::pid_gains[0]);

  // A drive turns its load about the joint's axis: this is the diagonal of the mass matrix.
  const double axis = equivalent_inertia(Q2d(), stretched, "shoulder_active_joint");
  judge("shoulder, about its axis", axis, 0.005, Q2d::pid_gains[0]);
  const LoopTarget target{.crossover = 2 * std::numbers::pi / 10.97 / 0.005,
                          .phase_margin = 60 * degree};
  constexpr double little_integral = 1000;  // p/i over d/p; the course's shoulder has 3800
  judge("shoulder, designed", axis, 0.005,
        design_pid({.inertia = axis, .time_constant = 0.005}, target, little_integral));
}
// centre of mass at 0.2399 m, by the slip at 0.1746 m
// elbow, course, I 0.008201: p 339 i 851 d 0.351
//   |L| 1.010, margin 67.6 deg; |L| 1 at 144.4 rad/s; overshoot 7.6 %, settled 35 ms
// shoulder, course, I 0.087388: p 2310 i 4640 d 0.299
//   |L| 1.001, margin 60.0 deg; |L| 1 at 114.7 rad/s; overshoot 11.7 %, settled 38 ms
// shoulder, without the slip, I 0.077445: p 2310 i 4640 d 0.299
//   |L| 1.130, margin 60.0 deg; |L| 1 at 126.1 rad/s; overshoot 14.2 %, settled 35 ms
// shoulder, about its axis, I 0.211797: p 2310 i 4640 d 0.299
//   |L| 0.413, margin 60.0 deg; |L| 1 at 52.8 rad/s; overshoot 1.2 %, settled 45 ms
// shoulder, designed, I 0.211797: p 5592 i 21391 d 1.462
//   |L| 1.000, margin 60.0 deg; |L| 1 at 114.6 rad/s; overshoot 13.2 %, settled 119 ms
//
// The slip matters less than the choice of the centre of mass: about its axis the shoulder's
// inertia is 2.7 times as large. The course's gains give half of the planned crossover. The correct
// gains reach the drive's 27.94 N m in steps above 5 mrad.

// SPDX-License-Identifier: Apache-2.0
// The algorithms run in the compiler. Compiling is passing.
#include "robots/faulty_robots.hpp"

#include <articula/dynamics/dynamics.hpp>

#include <numbers>

using namespace articula;

namespace {

struct Swing {
  static constexpr auto description = support::double_pendulum;
};

// A double pendulum that swings about y: rod of 2 kg, centre 0.5 m below the pivot, 0.2 kg m^2; bob
// of 1 kg and 0.01 kg m^2, 1 m below the pivot on the knee's axis. Hence by hand, hanging straight
// or at any angle of the knee, because the bob's centre is on that axis:
//   M = [0.2 + 2 0.5^2 + 1 + 0.01, 0.01; 0.01, 0.01], no Coriolis effort,
//   gravity about the pivot at a right angle: 9.81 (2 0.5 + 1), about the knee: 0.
constexpr const Mechanism<2>& mechanism = model_of(Swing{}).mechanism;
using Array = JointArray<double, 2>;

/// Both joints at right angles.
constexpr double right_angle = std::numbers::pi / 2;
constexpr Configuration<double, 2> raised =
    configuration_of<double, 2>(mechanism, Array{right_angle, right_angle});

/// Within a few roundings of numbers up to 20.
constexpr bool close(double a, double b) { return a - b < 1e-14 && b - a < 1e-14; }
constexpr bool close(const Array& a, const Array& b) {
  return close(a[0], b[0]) && close(a[1], b[1]);
}

constexpr auto mass = MassMatrix::evaluate<double, 2>(mechanism, raised);
static_assert(close(mass[0], {1.71, 0.01}) && close(mass[1], {0.01, 0.01}));
// A positive turn about y carries what hangs along -z to -x; weight pulls it back.
static_assert(close(Gravity::evaluate<double, 2>(mechanism, raised), {19.62, 0}));
static_assert(close(NonlinearEffects::evaluate<double, 2>(mechanism, raised, {1, 2}), {19.62, 0}));
static_assert(close(InverseDynamics::evaluate<double, 2>(mechanism, raised, {1, 2}, {3, 4}),
                    {19.62 + 1.71 * 3 + 0.01 * 4, 0.01 * 3 + 0.01 * 4}));
static_assert(close(ForwardDynamics::evaluate<double, 2>(mechanism, raised, {1, 2},
                                                         {19.62 + 1.71 * 3 + 0.01 * 4,
                                                          0.01 * 3 + 0.01 * 4}),
                    {3, 4}));
static_assert(close(KineticEnergy::evaluate<double, 2>(mechanism, raised, {1, 2}),
                    (1.71 + 2 * 0.01 * 2 + 0.01 * 4) / 2));
// The rod lies level, and so does the bob beyond it: no height. Hanging they have -2 0.5 - 1 m kg.
static_assert(close(PotentialEnergy::evaluate<double, 2>(mechanism, raised), 0));
static_assert(close(PotentialEnergy::evaluate<double, 2>(
                        mechanism, configuration_of<double, 2>(mechanism, Array{0, 0})),
                    -19.62));
constexpr Placement<double> bob = BodyPlacements::evaluate<double, 2>(mechanism, raised)[1];
static_assert(close(bob.translation.x, -1) && bob.translation.y == 0 &&
              close(bob.translation.z, 0));

}  // namespace

// SPDX-License-Identifier: Apache-2.0
#include <articula/motion/cube_root.hpp>

#include <cmath>
#include <limits>

#include "catch.hpp"
#include "random.hpp"

using namespace articula;

TEST_CASE(
    "a cube root is within two units in the last place, from the smallest number to the largest") {
  using Limits = std::numeric_limits<double>;
  support::Random random(1);
  double worst = 0;  // relative error; 2.2e-16 is a unit of a mantissa of 1
  const auto look = [&](double x) {
    const long double exact = std::cbrt(static_cast<long double>(x));
    worst = std::fmax(worst, static_cast<double>(
                                 std::abs(static_cast<long double>(cube_root(x)) - exact) / exact));
  };
  for (int k = 0; k < 100000; ++k) look(std::exp2(random.number(-1070, 1023)));
  for (int k = 1; k < 1000; ++k) look(k * 1.0 * k * k);
  for (const double x : {Limits::denorm_min(), Limits::min(), Limits::max(), 0.5, 1.0, 4.0})
    look(x);
  CHECK(worst < 4.5e-16);
  CHECK(cube_root(0) == 0);
  CHECK(cube_root(Limits::infinity()) == Limits::infinity());
  CHECK(std::isnan(cube_root(Limits::quiet_NaN())));
  CHECK(cube_root(8) == 2);
}

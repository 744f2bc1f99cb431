// SPDX-License-Identifier: Apache-2.0
#include "catch.hpp"
#include "random.hpp"

#include <articula/core/constant_math.hpp>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

using namespace articula;
using constant_math::sine_cosine;
using constant_math::square_root;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double smallest = std::numeric_limits<double>::denorm_min();
constexpr double largest = std::numeric_limits<double>::max();

// The compiler knows them.
static_assert(square_root(2) == std::numbers::sqrt2);
static_assert(square_root(0) == 0 && square_root(1) == 1 && square_root(1e200) == 1e100);
static_assert(square_root(smallest) > 0 && square_root(largest) < 1.4e154);
static_assert(sine_cosine(0).sine == 0 && sine_cosine(0).cosine == 1);
static_assert(!is_finite(square_root(-1)) && !is_finite(sine_cosine(infinity).sine));

/// How many numbers of type double lie between two, plus one; 0 for equal ones.
std::int64_t units_apart(double a, double b) {
  const auto place = [](double x) {
    const auto bits = std::bit_cast<std::int64_t>(x);
    return bits < 0 ? std::numeric_limits<std::int64_t>::min() - bits : bits;
  };
  return std::isnan(a) || std::isnan(b) ? std::numeric_limits<std::int64_t>::max()
                                        : std::abs(place(a) - place(b));
}

/// Compares with <cmath> in extended precision, which is right but for the last rounding. So one
/// unit apart is what the functions promise.
void check_angle(double angle) {
  const auto [sine, cosine] = sine_cosine(angle);
  const auto wide = static_cast<long double>(angle);
  INFO(std::hexfloat << "angle " << angle << ": " << sine << ", " << cosine);
  CHECK(units_apart(sine, static_cast<double>(std::sin(wide))) <= 1);
  CHECK(units_apart(cosine, static_cast<double>(std::cos(wide))) <= 1);
}

}  // namespace

TEST_CASE("square_root agrees with <cmath> at every size of number") {
  const unsigned seed = 101;
  CAPTURE(seed);
  support::Random random(seed);
  for (int k = 0; k < 5000; ++k) {
    const double a = std::ldexp(random.number(1, 2), random.integer(-1074, 1023));
    CAPTURE(a);
    CHECK(units_apart(square_root(a), std::sqrt(a)) <= 1);  // one unit is what it promises
  }
  for (double a : {smallest, 2 * smallest, std::numeric_limits<double>::min(), largest, 1.0,
                   std::nextafter(1.0, 0.0), std::nextafter(1.0, 2.0)}) {
    CAPTURE(a);
    CHECK(units_apart(square_root(a), std::sqrt(a)) <= 1);
  }
}

TEST_CASE("square_root of squares is exact") {
  for (int k = 0; k < 2000; ++k) CHECK(square_root(1.0 * k * k) == k);
}

TEST_CASE("square_root of what has none") {
  CHECK(std::isnan(square_root(-smallest)));
  CHECK(std::isnan(square_root(-infinity)));
  CHECK(std::isnan(square_root(not_a_number)));
  CHECK(square_root(infinity) == infinity);
}

TEST_CASE("sine_cosine agrees with <cmath> in the range it promises") {
  const unsigned seed = 102;
  CAPTURE(seed);
  support::Random random(seed);
  for (double size : {1e-300, 1e-9, 1e-3, 1.0, 10.0, 1e4}) {
    for (int k = 0; k < 1000; ++k) check_angle(random.number(-size, size));
  }
  for (double angle : {0.0, smallest, -smallest, 1e-160, 1e4, -1e4}) check_angle(angle);
}

TEST_CASE("sine_cosine agrees with <cmath> next to the multiples of a right angle") {
  for (int k = -6366; k <= 6366; k += k > -20 && k < 20 ? 1 : 17) {  // 6366 are nearly 1e4 rad
    const double angle = k * (std::numbers::pi / 2);
    for (double a : {angle, std::nextafter(angle, infinity), std::nextafter(angle, -infinity)}) {
      check_angle(a);
    }
  }
}

TEST_CASE("sine_cosine of half a right angle, where the reduction changes sides") {
  for (int k = -9; k <= 9; k += 2) {
    const double angle = k * (std::numbers::pi / 4);
    for (double a : {angle, std::nextafter(angle, infinity), std::nextafter(angle, -infinity)}) {
      check_angle(a);
    }
  }
}

TEST_CASE("sine_cosine of an absurd angle is a point on the unit circle, or NaN") {
  for (double angle : {1e5, 1e10, 1e15, 1e18, 1e19, 1e20, 1e25, 1e100, 1e300, largest}) {
    for (double a : {angle, -angle}) {
      const auto [sine, cosine] = sine_cosine(a);
      CAPTURE(a, sine, cosine);
      const double radius = std::hypot(sine, cosine);
      // Two numbers off by a unit or so of 1.1e-16 each.
      CHECK((std::isnan(radius) || std::abs(radius - 1) < 1e-15));
    }
  }
  CHECK(std::isnan(sine_cosine(infinity).sine));
  CHECK(std::isnan(sine_cosine(-infinity).cosine));
  CHECK(std::isnan(sine_cosine(not_a_number).sine));
}

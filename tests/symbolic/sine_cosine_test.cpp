// SPDX-License-Identifier: Apache-2.0
#include "articula/symbolic/sine_cosine.hpp"

#include "catch.hpp"
#include "numbers.hpp"
#include "random.hpp"

#include <cmath>
#include <numbers>

using namespace articula::symbolic;  // NOLINT
using support::infinity, support::not_a_number;

namespace {

/// How far a double is off, in units of its last place or of that of the smallest normal number.
double units_off(double result, long double truth) {
  const double size = std::max(std::abs(result), 2.3e-308);
  const auto unit = static_cast<long double>(std::nextafter(size, infinity) - size);
  return static_cast<double>(std::abs(static_cast<long double>(result) - truth) / unit);
}

/// What is promised. The long double's own error is 2^-11 of it.
constexpr double promised_units = 3;

template <std::size_t K>
void check(const std::array<double, K>& angle) {
  std::array<double, K> sine, cosine;
  sine_cosine(angle, sine, cosine);
  for (std::size_t i = 0; i < K; ++i) {
    CAPTURE(K, i, angle[i]);
    const auto exact = static_cast<long double>(angle[i]);
    CHECK(units_off(sine[i], std::sin(exact)) <= promised_units);
    CHECK(units_off(cosine[i], std::cos(exact)) <= promised_units);
  }
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("Sines and cosines of any number of angles are right", "",
                       ((std::size_t K), K), 1, 2, 3, 4, 5, 6, 7, 8, 9, 17) {
  const unsigned seed = 431;
  CAPTURE(seed);
  support::Random random(seed);
  for (const double size : {1e-300, 1e-8, 0.7, 3.2, 100.0, 9e4, 1e8, 1e300}) {
    for (int k = 0; k < 300; ++k) {
      std::array<double, K> angle;
      for (double& x : angle) x = random.number(-size, size);
      check(angle);
    }
  }
}

TEST_CASE("Sines near multiples of a right angle keep their digits") {
  for (int k = -2000; k <= 2000; ++k) {
    const double angle = k * (std::numbers::pi / 2);
    check(std::array{angle, std::nextafter(angle, infinity), std::nextafter(angle, -infinity)});
    check(std::array{angle});
  }
  // Up to where they go to <cmath>, and beyond.
  const unsigned seed = 77;
  CAPTURE(seed);
  support::Random random(seed);
  for (int k = 0; k < 100'000; ++k) {
    const double angle = random.integer(-140'000, 140'000) * (std::numbers::pi / 2);
    check(std::array{angle, std::nextafter(angle, infinity)});
  }
}

TEST_CASE("Sines and cosines of zero are exact, with the sign of zero") {
  std::array<double, 1> sine, cosine;
  sine_cosine(std::array{0.0}, sine, cosine);
  CHECK((sine[0] == 0 && cosine[0] == 1));
  sine_cosine(std::array{-0.0}, sine, cosine);
  CHECK((sine[0] == 0 && cosine[0] == 1));
}

TEST_CASE("An angle that is not finite has no sine, and its neighbours keep theirs") {
  for (const double bad : {not_a_number, infinity, -infinity}) {
    std::array<double, 5> angle{0.5, bad, -1.0, 2.0, 3.0}, sine, cosine;
    sine_cosine(angle, sine, cosine);
    for (std::size_t i = 0; i < angle.size(); ++i) {
      CAPTURE(bad, i);
      CHECK(std::isnan(sine[i]) == (i == 1));
      CHECK(std::isnan(cosine[i]) == (i == 1));
      if (i != 1) CHECK(sine[i] == Approx(std::sin(angle[i])).epsilon(1e-15));
    }
    const auto pack = Pack<2>::load(angle.data());
    CHECK(std::isnan(sincos(pack).sine[1]));
    CHECK(sincos(pack).cosine[0] == Approx(std::cos(0.5)).epsilon(1e-15));
  }
}

TEST_CASE("A large angle in one pack leaves the others right") {
  const double large = 1e12;
  const std::array<double, 6> numbers{0.5, -1.0, large, 2.0, 3.0, not_a_number};
  std::array<Pack<2>, 3> angle, sine, cosine;
  for (std::size_t i = 0; i < 3; ++i) angle[i] = Pack<2>::load(&numbers[2 * i]);
  sine_cosine(angle, sine, cosine);
  for (std::size_t i = 0; i < 5; ++i) {
    CAPTURE(i);
    const int lane = static_cast<int>(i % 2);
    CHECK(sine[i / 2][lane] == std::sin(numbers[i]));
    CHECK(cosine[i / 2][lane] == std::cos(numbers[i]));
  }
  CHECK(std::isnan(sine[2][1]));
}

TEMPLATE_TEST_CASE_SIG("Packs compute lane by lane", "", ((int Lanes), Lanes), 2,
                       lanes_of_a_register) {
  using P = Pack<Lanes>;
  std::array<double, std::size_t{Lanes}> a, b, c;
  for (std::size_t i = 0; i < a.size(); ++i) {
    a[i] = 0.3 * static_cast<double>(i) + 0.1;
    b[i] = 1.7 - 0.4 * static_cast<double>(i);
  }
  const P x = P::load(a.data()), y = P::load(b.data());
  (x * y + P(2.0) / x - y).store(c.data());
  const SineAndCosine<P> both = sincos(y);
  for (int lane = 0; lane < Lanes; ++lane) {
    CAPTURE(lane);
    const auto i = static_cast<std::size_t>(lane);
    CHECK(c[i] == Approx(a[i] * b[i] + 2.0 / a[i] - b[i]).epsilon(1e-15));
    CHECK((-x)[lane] == -a[i]);
    CHECK(sqrt(x)[lane] == std::sqrt(a[i]));
    CHECK(P(-0.0)[lane] == 0.0);
    CHECK(std::signbit(P(-0.0)[lane]));
    CHECK(units_off(both.sine[lane], std::sin(static_cast<long double>(b[i]))) <= promised_units);
    CHECK(sin(y)[lane] == both.sine[lane]);
    CHECK(cos(y)[lane] == both.cosine[lane]);
  }
}

// SPDX-License-Identifier: Apache-2.0
#include "articula/sim/crossing.hpp"

#include "catch.hpp"
#include "random.hpp"

#include <cmath>
#include <limits>

using namespace articula;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

struct Search {
  double place;
  int calls;
};

/// Searches [0, 1] to the last bits.
template <class Function>
Search search(const Function& function) {
  int calls = 0;
  const double place =
      locate_crossing({0, function(0.0)}, {1, function(1.0)}, epsilon, [&](double x) {
        ++calls;
        return function(x);
      });
  return {place, calls};
}

/// Halving 1 down to epsilon takes 52 steps; the method may take one more, and rounding another.
constexpr int most_calls = 54;

}  // namespace

TEST_CASE("smooth functions take few calls") {
  constexpr unsigned seed = 1;
  CAPTURE(seed);
  support::Random random(seed);
  int calls = 0;
  constexpr int trials = 1000;
  for (int trial = 0; trial < trials; ++trial) {
    // The way of a joint under a steady effort, and something of third order.
    const double zero = random.number(0.01, 1), speed = random.number(0.1, 10);
    const double bend = random.number(0, 10), jerk = random.number(0, 5);
    const auto way = [&](double t) {
      const auto past = [&](double x) { return speed * x + bend * x * x + jerk * x * x * x; };
      return past(t) - past(zero);
    };
    const Search found = search(way);
    CAPTURE(zero, speed, bend, jerk);
    // A unit in the last place of the function's terms, over its slope, which is at least `speed`.
    CHECK(std::abs(found.place - zero) <= epsilon * (1 + 4 * (speed + bend + jerk) / speed));
    CHECK(found.calls <= most_calls);
    calls += found.calls;
  }
  CHECK(calls < 15 * trials);
}

TEST_CASE("no function takes more calls than halving, but for one or two") {
  constexpr unsigned seed = 2;
  CAPTURE(seed);
  support::Random random(seed);
  for (int trial = 0; trial < 1000; ++trial) {
    const double edge = random.number(1e-6, 1), low = -std::pow(10, random.number(-300, 300)),
                 high = std::pow(10, random.number(-300, 300));
    CAPTURE(edge, low, high);
    const Search found = search([&](double x) { return x > edge ? high : low; });
    CHECK(found.place > edge);
    CHECK(found.place <= edge + epsilon);
    CHECK(found.calls <= most_calls);
  }
}

TEST_CASE("values that are 0, infinite or no numbers do not stop it") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
  for (const double low : {0.0, -infinity, no_number}) {
    for (const double high : {infinity, 1.0}) {
      CAPTURE(low, high);
      const Search found = search([&](double x) { return x > 0.3 ? high : low; });
      CHECK(found.place > 0.3);
      CHECK(found.place <= 0.3 + epsilon);
      CHECK(found.calls <= most_calls);
    }
  }
}

TEST_CASE("an interval that is narrow enough is left alone") {
  const double place = locate_crossing({1, -1}, {1 + epsilon, 1}, epsilon, [](double) {
    FAIL("called");
    return 0.0;
  });
  CHECK(place == 1 + epsilon);
}

TEST_CASE("it ends where there is no number left between") {
  for (const double width : {0.0, 1e-300}) {
    int calls = 0;
    const double place = locate_crossing({0.25, -1}, {1, 1}, width, [&](double x) {
      ++calls;
      return x - 0.75000001;
    });
    CHECK(std::abs(place - 0.75000001) <= epsilon);
    CHECK(calls < 2 * most_calls);
  }
}

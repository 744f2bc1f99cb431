// SPDX-License-Identifier: Apache-2.0
#include <articula/sweep/search_gains.hpp>

#include "catch.hpp"

#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <vector>

using namespace articula;

namespace {

/// A law whose gain must suit arms of any inertia: each run's error is |log(gain inertia)|.
struct Arms {
  double gain = 1;
  [[nodiscard]] std::vector<SweepParameter> parameters() const {
    return {{"inertia", "1", 0.5, 2, Spacing::logarithmic}};
  }
  [[nodiscard]] std::vector<SweepMetric> metrics() const { return {{"error", "1"}}; }
  [[nodiscard]] SimulationEnd run(const SweepRun& run, std::span<double> metrics) const {
    metrics[0] = std::abs(std::log(gain * run.parameters[0]));
    return SimulationEnd::stable;
  }
};

}  // namespace

TEST_CASE("a search minimises a quantile over a sweep") {
  // By symmetry, the best gain for inertias from 1/2 to 2 is 1; the share p of the errors is then
  // below p log 2.
  const SearchResult best = search_gains(
      {.parameters = {{"gain", "1", 0.01, 1000, Spacing::logarithmic}}, .evaluations = 120},
      [](const std::vector<double>& gains) {
        const SweepOptions options{.sampling = {.method = SamplingMethod::sobol, .runs = 256}};
        return sweep(Arms{gains[0]}, options).summary("error").quantile(0.9);
      });
  CHECK(best.evaluations <= 120);
  CHECK(best.parameters[0] == Approx(1).epsilon(0.05));
  CHECK(best.cost == Approx(0.9 * std::log(2)).epsilon(0.02));
}

TEST_CASE("a search finds the least of two valleys, around a region without cost") {
  const SearchResult best =
      search_gains({.parameters = {{"x", "1", -3, 3}, {"y", "1", -3, 3}}, .evaluations = 400},
                   [](const std::vector<double>& at) {
                     const double x = at[0], y = at[1];
                     if (x * x + y * y < 0.5) return std::numeric_limits<double>::infinity();
                     const double valley = std::pow(x - 2, 2) + std::pow(y - 1, 2);
                     const double shallow = 0.5 + std::pow(x + 2, 2) + std::pow(y + 1, 2);
                     return std::fmin(valley, shallow);
                   });
  CHECK(best.cost < 1e-3);
  CHECK(best.parameters[0] == Approx(2).epsilon(0.03));
  CHECK(best.parameters[1] == Approx(1).epsilon(0.03));
}

TEST_CASE("the second part of a search refines the best point of the first") {
  // DIRECT-L alone comes within 1.4e-3 of the least cost, 0, in 40 evaluations, 1.7e-5 in 100.
  const SearchResult best =
      search_gains({.parameters = {{"x", "1", -3, 3}, {"y", "1", -3, 3}}, .evaluations = 60},
                   [](const std::vector<double>& at) {
                     const double x = at[0] - std::sqrt(2.0), y = at[1] + 1 / 3.14;
                     return x * x + 3 * y * y + x * y;
                   });
  CHECK(best.cost < 1e-7);
  CHECK(best.evaluations <= 60);
}

TEST_CASE("a search refuses what it cannot search, and passes exceptions on") {
  const auto cost = [](const std::vector<double>&) -> double { throw std::logic_error("no cost"); };
  CHECK_THROWS_WITH(search_gains({}, cost), Catch::Contains("no parameters"));
  CHECK_THROWS_WITH(search_gains({.parameters = {{"x", "1", 0, 1}}, .evaluations = 0}, cost),
                    Catch::Contains("evaluations 0"));
  CHECK_THROWS_WITH(search_gains({.parameters = {{"x", "1", 2, 1}}}, cost),
                    Catch::Contains("above its high end"));
  CHECK_THROWS_WITH(search_gains({.parameters = {{"x", "1", 0, 1}}}, cost),
                    Catch::Contains("no cost"));
}

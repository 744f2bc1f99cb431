// SPDX-License-Identifier: Apache-2.0
#include <articula/sim/random_draw.hpp>
#include <articula/sweep/statistics/metric_summary.hpp>

#include "catch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

using namespace articula;

namespace {

/// Numbers of both signs over many orders of magnitude.
std::vector<double> numbers(int count, double lowest_exponent, double highest_exponent) {
  std::vector<double> all;
  for (std::uint64_t k = 0; k < static_cast<std::uint64_t>(count); ++k) {
    const double share = detail::share_of_bits(detail::random_bits(7, k));
    const double size = std::exp2(std::lerp(lowest_exponent, highest_exponent, share));
    all.push_back(detail::random_bits(8, k) % 3 == 0 ? -size : size);
  }
  return all;
}

}  // namespace

TEST_CASE("a quantile of the sketch is within its error of the exact one") {
  std::vector<double> all = numbers(20000, -30, 30);
  all.insert(all.end(), 500, 0.0);
  MetricSummary summary;
  for (const double x : all) summary.add(x);
  std::sort(all.begin(), all.end());
  for (int percent = 0; percent <= 100; ++percent) {
    const double share = percent / 100.0;
    const double exact = all[static_cast<std::size_t>(share * static_cast<double>(all.size() - 1))];
    REQUIRE(std::abs(summary.quantile(share) - exact) <=
            QuantileSketch::accuracy * (1 + 1e-9) * std::abs(exact));
  }
  CHECK(summary.quantile(0) == all.front());
  CHECK(summary.quantile(1) == all.back());
  CHECK(summary.sketch.positive().size() < 4200);  // 60 powers of two in classes of 1 %
}

TEST_CASE("summaries merge to the same bits in any order and any parts") {
  const std::vector<double> all = numbers(3000, -1074, 1000);
  MetricSummary whole;
  for (const double x : all) whole.add(x);
  MetricSummary backwards;
  for (std::size_t part = 10; part-- > 0;) {
    MetricSummary some;
    for (std::size_t k = 300; k-- > 0;) some.add(all[300 * part + k]);
    backwards.merge(some);
  }
  CHECK(whole.sum.digits() == backwards.sum.digits());
  CHECK(whole.mean() == backwards.mean());
  CHECK(whole.lowest == backwards.lowest);
  CHECK(whole.highest == backwards.highest);
  CHECK(whole.sketch.positive() == backwards.sketch.positive());
  CHECK(whole.sketch.negative() == backwards.sketch.negative());
  for (const double share : {0.0, 0.25, 0.5, 0.99, 1.0}) {
    CHECK(whole.quantile(share) == backwards.quantile(share));
  }
}

TEST_CASE("an exact sum loses nothing") {
  ExactSum sum;
  for (const double x : {1e300, 1.0, 5e-324, -1e300, 2.5e-310, -1.0, -2.5e-310}) sum.add(x);
  CHECK(sum.value() == 5e-324);
  sum.add(-1e-323);
  CHECK(sum.value() == -5e-324);
  ExactSum tenths;
  for (int k = 0; k < 1000; ++k) tenths.add(0.1);
  CHECK(tenths.value() == Approx(100).epsilon(1e-15));
  ExactSum large;
  for (int k = 0; k < 3; ++k) large.add(std::numeric_limits<double>::max());
  CHECK(std::isinf(large.value()));
  large.add(-std::numeric_limits<double>::max());
  large.add(-std::numeric_limits<double>::max());
  CHECK(large.value() == std::numeric_limits<double>::max());
}

TEST_CASE("undefined values count as above all others") {
  MetricSummary summary;
  for (int k = 1; k <= 90; ++k) summary.add(k);
  for (int k = 0; k < 10; ++k)
    summary.add(k % 2 == 0 ? std::nan("") : std::numeric_limits<double>::infinity());
  CHECK(summary.undefined == 10);
  CHECK(summary.mean() == 45.5);
  CHECK(summary.quantile(0.5) == Approx(50).epsilon(0.005));
  CHECK(summary.quantile(0.89) == Approx(89).epsilon(0.005));
  CHECK(std::isinf(summary.quantile(0.95)));
  CHECK_THROWS_WITH(summary.quantile(1.5), Catch::Contains("1.5"));
  CHECK(std::isnan(MetricSummary().quantile(0.5)));
  CHECK(std::isnan(MetricSummary().mean()));
}

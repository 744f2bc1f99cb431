// SPDX-License-Identifier: Apache-2.0
#include <articula/loop/duration_histogram.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "catch.hpp"
#include "random.hpp"

using namespace articula;
using std::chrono::nanoseconds;

TEST_CASE("an empty histogram has zeros only") {
  const DurationHistogram histogram;
  CHECK(histogram.count() == 0);
  CHECK(histogram.min().count() == 0);
  CHECK(histogram.mean().count() == 0);
  CHECK(histogram.max().count() == 0);
  CHECK(histogram.percentile(0.5).count() == 0);
}

TEST_CASE("count, minimum, mean and maximum are exact") {
  DurationHistogram histogram;
  for (const long value : {5, 1'000'003, 17, 3}) histogram.add(nanoseconds(value));
  CHECK(histogram.count() == 4);
  CHECK(histogram.min().count() == 3);
  CHECK(histogram.mean().count() == 250'007);
  CHECK(histogram.max().count() == 1'000'003);
}

TEST_CASE("short durations have a bucket each, negative ones count as 0") {
  DurationHistogram histogram;
  for (int k = 0; k < 32; ++k) histogram.add(nanoseconds(k));
  for (int k = 1; k <= 32; ++k) CHECK(histogram.percentile(k / 32.0).count() == k - 1);
  histogram.add(nanoseconds(-5));
  CHECK(histogram.percentile(0).count() == 0);
  CHECK(histogram.min().count() == 0);
}

TEST_CASE("a percentile is not below the exact one and at most 1/16 above") {
  constexpr unsigned seed = 11;
  CAPTURE(seed);
  support::Random random(seed);
  DurationHistogram histogram;
  std::vector<double> values;
  for (int k = 0; k < 5000; ++k) {
    const auto value = static_cast<long>(std::exp(random.number(0, 40)));
    histogram.add(nanoseconds(value));
    values.push_back(static_cast<double>(value));
  }
  std::sort(values.begin(), values.end());
  for (const double share : {0.01, 0.25, 0.5, 0.9, 0.99, 0.999, 1.0}) {
    CAPTURE(share);
    const auto rank = static_cast<std::size_t>(std::ceil(share * 5000)) - 1;
    const auto measured = static_cast<double>(histogram.percentile(share).count());
    CHECK(measured >= values[rank]);
    CHECK(measured <= values[rank] * (1 + 1.0 / 16));
  }
}

TEST_CASE("the longest duration that there is has a bucket") {
  DurationHistogram histogram;
  histogram.add(nanoseconds(std::numeric_limits<nanoseconds::rep>::max()));
  CHECK(histogram.percentile(1) == histogram.max());
  CHECK(histogram.max().count() == std::numeric_limits<nanoseconds::rep>::max());
}

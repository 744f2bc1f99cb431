// SPDX-License-Identifier: Apache-2.0
// Samples can be added to step metrics in the control loop.
#include <articula/tuning/step_metrics.hpp>

#include "allocation_guard.hpp"
#include "catch.hpp"
#include "numbers.hpp"

using articula::StepMetrics;
using articula::testing::heap_calls_in;

TEST_CASE("adding to step metrics does not touch the heap, whatever is added") {
  StepMetrics metrics(0, 1), broken(0, 1);
  static_assert(noexcept(metrics.add(0, 0)) && noexcept(metrics.overshoot()));
  double volatile seen = 0;
  const std::size_t calls = heap_calls_in([&] {
    for (int k = 0; k < 1000; ++k) {
      metrics.add(1e-3 * k, 2e-3 * k);
      broken.add(1e-3 * k, k == 500 ? support::not_a_number : 1);
      seen = metrics.rise_time().value_or(0) + metrics.overshoot().value_or(0) +
             metrics.peak().value_or(0) + metrics.peak_time().value_or(0) +
             metrics.settling_time().value_or(0) + metrics.steady_error().value_or(0);
    }
  });
  CHECK(calls == 0);
  CHECK(seen > 1);
}

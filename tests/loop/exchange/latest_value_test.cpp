// SPDX-License-Identifier: Apache-2.0
#include <articula/core/joint_reference.hpp>
#include <articula/loop/exchange/latest_value.hpp>

#include <atomic>
#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

#include "catch.hpp"
#include "interleavings.hpp"

using namespace articula;
using support::Interleavings;
using support::Watched;

static_assert(std::atomic<unsigned>::is_always_lock_free);

TEST_CASE("the latest value is read once and kept") {
  LatestValue<int> latest(7);
  CHECK(latest.value() == 7);
  CHECK_FALSE(latest.update());
  latest.write(1);
  CHECK(latest.value() == 7);
  CHECK(latest.update());
  CHECK(latest.value() == 1);
  CHECK_FALSE(latest.update());
  CHECK(latest.value() == 1);
}

TEST_CASE("values that nobody read are replaced") {
  LatestValue<int> latest;
  for (int k = 1; k <= 10; ++k) latest.write(k);
  CHECK(latest.update());
  CHECK(latest.value() == 10);
  for (int k = 11; k <= 20; ++k) {
    latest.write(k);
    CHECK(latest.update());
    CHECK(latest.value() == k);
  }
}

namespace {

struct Findings {
  std::size_t orders = 0;
  std::size_t races = 0;
  std::size_t disorders = 0;    ///< a value older than the one before, or none that was written
  std::size_t lost = 0;         ///< the last value was not there in the end
  std::size_t overtakings = 0;  ///< orders in which a value was skipped
};

/// A writer that publishes 1 .. writes and a reader that updates `reads` times.
template <template <class> class Atomic>
Findings explore(int writes, int reads) {
  Interleavings explorer;
  Findings findings;
  std::unique_ptr<LatestValue<Watched, Atomic>> latest;
  std::vector<int> seen;
  findings.orders = explorer.explore(
      [&] {
        latest = std::make_unique<LatestValue<Watched, Atomic>>();
        seen.clear();
        return std::array<std::function<void()>, 2>{
            [&] {
              for (int k = 1; k <= writes; ++k) latest->write(Watched(k));
            },
            [&] {
              for (int k = 0; k < reads; ++k) {
                const bool updated = latest->update();
                const int number = latest->value().number();
                const int before = seen.empty() ? 0 : seen.back();
                if (updated ? number <= before : number != before) ++findings.disorders;
                if (number > before + 1) ++findings.overtakings;
                seen.push_back(number);
              }
            }};
      },
      [&] {
        latest->update();
        if (latest->value().number() != writes) ++findings.lost;
      });
  findings.races = explorer.races();
  return findings;
}

}  // namespace

TEST_CASE("the triple buffer is right in every order of its atomic operations") {
  const Findings findings = explore<support::ObedientAtomic>(4, 3);
  CAPTURE(findings.orders);
  CHECK(findings.orders > 100);
  CHECK(findings.races == 0);
  CHECK(findings.disorders == 0);
  CHECK(findings.lost == 0);
  CHECK(findings.overtakings > 0);  // else the orders were not worth going through
}

TEST_CASE("the explorer finds the races of a triple buffer whose memory orders are relaxed") {
  CHECK(explore<support::RelaxedAtomic>(2, 2).races > 0);
}

TEST_CASE("a value that another thread writes is never torn and never goes back") {
  LatestValue<JointReference<7>> latest;
  constexpr int writes = 20000;
  std::atomic<bool> done = false;
  std::thread writer([&] {
    JointReference<7> reference;
    for (int k = 1; k <= writes; ++k) {
      reference.position.setConstant(k);
      reference.effort.setConstant(k);
      latest.write(reference);
    }
    done = true;
  });
  double last = 0;
  bool torn = false, back = false;
  for (bool end = false; !end;) {
    end = done;
    latest.update();
    const auto& r = latest.value();
    torn = torn || (r.position.array() != r.position[0]).any() ||
           (r.effort.array() != r.position[0]).any();
    back = back || r.position[0] < last;
    last = r.position[0];
  }
  writer.join();
  CHECK_FALSE(torn);
  CHECK_FALSE(back);
  CHECK(last == writes);
}

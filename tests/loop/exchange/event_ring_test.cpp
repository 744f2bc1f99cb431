// SPDX-License-Identifier: Apache-2.0
#include <articula/loop/exchange/event_ring.hpp>

#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

#include "catch.hpp"
#include "interleavings.hpp"

using namespace articula;
using support::Interleavings;
using support::Watched;

TEST_CASE("the ring hands on in order, and drops and counts what finds it full") {
  EventRing<int, 4> ring;
  int value = -1;
  CHECK_FALSE(ring.pop(value));
  CHECK(value == -1);
  for (int k = 0; k < 6; ++k) CHECK(ring.push(k) == (k < 4));
  CHECK(ring.dropped() == 2);
  for (int k = 0; k < 4; ++k) {
    CHECK(ring.pop(value));
    CHECK(value == k);
  }
  CHECK_FALSE(ring.pop(value));
  for (int k = 10; k < 30; ++k) {
    CHECK(ring.push(k));
    CHECK(ring.pop(value));
    CHECK(value == k);
  }
  CHECK(ring.dropped() == 2);
}

namespace {

struct Findings {
  std::size_t orders = 0;
  std::size_t races = 0;
  std::size_t wrong = 0;  ///< orders whose values are not those accepted, one by one
  std::size_t full = 0;   ///< orders in which something was dropped
};

/// A writer that pushes 1 .. pushes into a ring of two and a reader that pops `pops` times.
template <template <class> class Atomic>
Findings explore(int pushes, int pops) {
  using Ring = EventRing<Watched, 2, Atomic>;
  Interleavings explorer;
  Findings findings;
  std::unique_ptr<Ring> ring;
  std::vector<int> accepted, received;
  findings.orders = explorer.explore(
      [&] {
        ring = std::make_unique<Ring>();
        accepted.clear();
        received.clear();
        return std::array<std::function<void()>, 2>{[&] {
                                                      for (int k = 1; k <= pushes; ++k) {
                                                        if (ring->push(Watched(k)))
                                                          accepted.push_back(k);
                                                      }
                                                    },
                                                    [&] {
                                                      Watched value;
                                                      for (int k = 0; k < pops; ++k) {
                                                        if (ring->pop(value))
                                                          received.push_back(value.number());
                                                      }
                                                    }};
      },
      [&] {
        for (Watched value; ring->pop(value);) received.push_back(value.number());
        if (received != accepted) ++findings.wrong;
        if (ring->dropped() > 0) ++findings.full;
      });
  findings.races = explorer.races();
  return findings;
}

}  // namespace

TEST_CASE("the ring is right in every order of its atomic operations") {
  const Findings findings = explore<support::ObedientAtomic>(3, 1);
  CAPTURE(findings.orders);
  CHECK(findings.orders > 100);
  CHECK(findings.races == 0);
  CHECK(findings.wrong == 0);
  CHECK(findings.full > 0);
  CHECK(findings.full < findings.orders);
}

TEST_CASE("the explorer finds the races of a ring whose memory orders are relaxed") {
  CHECK(explore<support::RelaxedAtomic>(1, 1).races > 0);
}

TEST_CASE("what another thread pushes arrives complete, in order and counted") {
  EventRing<std::uint64_t, 64> ring;
  constexpr std::uint64_t pushes = 50000;
  std::uint64_t accepted = 0;
  std::thread writer([&] {
    for (std::uint64_t k = 1; k <= pushes; ++k) accepted += ring.push(k) ? 1U : 0U;
    while (!ring.push(pushes + 1)) std::this_thread::yield();
  });
  std::uint64_t received = 0, last = 0, value = 0;
  bool ordered = true;
  while (value != pushes + 1) {
    if (!ring.pop(value)) {
      std::this_thread::yield();
      continue;
    }
    ordered = ordered && value > last;
    last = value;
    ++received;
  }
  writer.join();
  CHECK(ordered);
  CHECK(received == accepted + 1);
  CHECK(ring.dropped() >= pushes - accepted);  // and those of the last value's attempts
}

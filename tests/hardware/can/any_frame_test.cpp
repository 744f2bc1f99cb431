// SPDX-License-Identifier: Apache-2.0
// Every decoder is total: whatever is on the bus gives a value or an error, and no state that is
// not finite. tests/fuzz does the same with frames that a fuzzer makes up.
#include "hardware/any_frames.hpp"

#include "catch.hpp"
#include "random.hpp"

#include <vector>

TEST_CASE("any frames are survived by both ends of the bus") {
  const unsigned seed = 20;
  CAPTURE(seed);
  support::Random random(seed);
  std::vector<std::uint8_t> bytes(13 * 64);
  for (int round = 0; round < 2000; ++round) {
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.integer(0, 255));
    // Every other frame gets an identifier that somebody listens to.
    for (std::size_t k = 0; k < bytes.size(); k += 26)
      support::aim(&bytes[k], random.integer(0, 999));
    REQUIRE(support::survives(bytes.data(), bytes.size()));
  }
}

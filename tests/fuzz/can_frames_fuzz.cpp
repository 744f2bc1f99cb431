// SPDX-License-Identifier: Apache-2.0
// Frames that a fuzzer makes up, for both ends of the bus.
#include "hardware/any_frames.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

// libFuzzer wants this name.
// NOLINTNEXTLINE(readability-identifier-naming)
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (!support::survives(data, size)) std::abort();
  // The same once more with identifiers that somebody listens to: the first byte chooses.
  std::vector<std::uint8_t> aimed(data, data + size);
  for (std::size_t at = 0; at + support::bytes_per_frame <= size; at += support::bytes_per_frame) {
    support::aim(&aimed[at], data[at] + 256 * (data[at + 1] % 4));
  }
  if (!support::survives(aimed.data(), aimed.size())) std::abort();
  return 0;
}

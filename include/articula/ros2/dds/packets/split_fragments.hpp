// SPDX-License-Identifier: Apache-2.0
/// @file Fragments of messages, each in a part of its own.
#pragma once

#include "articula/ros2/dds/packets/packet_check.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace articula::ros2::dds {

namespace detail {

/// Several fragments in one part.
struct FragmentRun {
  std::uint32_t first = 0, count = 0;
  std::size_t size = 0;    ///< of each fragment but the message's last one [bytes]
  std::size_t begin = 0;   ///< of the first fragment in the part
  std::size_t length = 0;  ///< of all of them
};

/// The fragments in a part, if there are several of a message, with all their bytes.
[[nodiscard]] constexpr std::optional<FragmentRun> fragment_run_in(std::uint32_t flags,
                                                                   Packet part) noexcept {
  constexpr std::size_t least = 64, most_heads = 1 << 16;  // bytes
  const bool little = (flags & 1U) != 0;
  const auto body = body_of(part, flags, 32);
  if (!body || is_builtin(writer_of(part))) return std::nullopt;
  FragmentRun run;
  run.first = number_at(part, 20, 4, little);
  run.count = number_at(part, 24, 2, little);
  run.size = number_at(part, 26, 2, little);
  run.begin = part.size() - body->payload.size();
  const std::uint64_t total = number_at(part, 28, 4, little);
  if (run.first == 0 || run.count < 2 || run.size < least) return std::nullopt;
  const std::uint64_t before = (std::uint64_t{run.first} - 1) * run.size;
  const std::uint64_t all_but_last = (std::uint64_t{run.count} - 1) * run.size;
  if (before + all_but_last >= total || run.count * run.begin > most_heads) return std::nullopt;
  run.length = std::min<std::uint64_t>(all_but_last + run.size, total - before);
  if (body->payload.size() < run.length) return std::nullopt;
  return run;
}

}  // namespace detail

/// A packet with one fragment in a part. Cyclone DDS puts ten into one. Fast DDS 2.9.1 understands
/// them, but believes each part that its message is as long as it says; see is_good_fragment.
/// @param packet  from the network
/// @return        nothing if no part has several fragments that can be split
/// Real-time: no (allocates). A packet of UDP becomes at most some 1 MiB longer.
[[nodiscard]] inline std::optional<std::vector<std::byte>> split_fragments(Packet packet) {
  if (packet.size() < packet_header) return std::nullopt;
  std::vector<std::byte> all(packet.begin(), packet.begin() + packet_header);
  bool is_split = false;
  const auto append = [&](Packet bytes) { all.insert(all.end(), bytes.begin(), bytes.end()); };
  const bool is_whole = for_each_part(packet, [&](std::uint32_t kind, std::uint32_t flags,
                                                  Packet part) {
    const bool little = (flags & 1U) != 0;
    const auto put = [&](std::size_t at, std::size_t size, std::uint32_t value) {
      for (std::size_t k = 0; k < size; ++k) {
        all[at + (little ? k : size - 1 - k)] = static_cast<std::byte>(value >> (8 * k) & 0xffU);
      }
    };
    const auto run =
        kind == detail::fragment_part ? detail::fragment_run_in(flags, part) : std::nullopt;
    if (!run) {
      append({part.data() - 4, part.size() + 4});
      return true;
    }
    is_split = true;
    for (std::uint32_t k = 0; k < run->count; ++k) {
      const std::size_t begin = k * run->size;
      const Packet own = part.subspan(run->begin + begin, std::min(run->size, run->length - begin));
      const std::size_t head = all.size();
      append({part.data() - 4, 4 + run->begin});
      append(own);
      all.resize((all.size() - packet_header + 3) / 4 * 4 + packet_header);
      put(head + 2, 2, static_cast<std::uint32_t>(all.size() - head - 4));
      put(head + 4 + 20, 4, run->first + k);
      put(head + 4 + 24, 2, 1);
    }
    return true;
  });
  if (!is_whole || !is_split) return std::nullopt;
  return all;
}

}  // namespace articula::ros2::dds

// SPDX-License-Identifier: Apache-2.0
/// @file A limit on how many new participants of a domain are heard in a time.
#pragma once

#include "articula/ros2/dds/packets/packet_check.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>

namespace articula::ros2::dds {

/// Decides which announcements of participants Fast DDS gets to see. Fast DDS 2.9.1 keeps some 80
/// bytes for ever of each participant that has ever announced itself, also of those for which it
/// has no room. Under a storm of announcements its memory would grow without end.
///
/// So many participants may be new at once, and then one per second. Those that are known may
/// announce themselves as often as they like. All other packets pass. Participants repeat their
/// announcements, so one that was not let in comes in later. For one thread at a time.
class ParticipantGate {
 public:
  using Time = std::chrono::steady_clock::time_point;

  static constexpr int most_at_once = 256;
  static constexpr std::size_t most_known = 1024;

  /// Whether to hand a packet on.
  /// @param packet  well-formed
  /// @param now     not before the last one
  /// Real-time: no (allocates).
  [[nodiscard]] bool admits(Packet packet, Time now) {
    Prefix source{};
    const auto read_source = [&](Packet bytes, std::size_t at) {
      std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), source.size(), source.begin());
    };
    read_source(packet, 8);
    return for_each_part(packet, [&](std::uint32_t kind, std::uint32_t, Packet part) {
      constexpr std::uint32_t info_source = 0x0c, data = 0x15, fragment = 0x16;
      constexpr std::uint32_t participant_writer = 0x000100c2;  // [RTPS], table 9.2
      if (kind == info_source) read_source(part, 8);
      const bool announces = (kind == data || kind == fragment) &&
                             detail::number_at(part, 8, 4, false) == participant_writer;
      return !announces || admits(source, now);
    });
  }

 private:
  using Prefix = std::array<std::byte, 12>;  ///< of the identity of all that a participant has

  [[nodiscard]] bool admits(const Prefix& source, Time now) {
    if (const auto known = last_seen_.find(source); known != last_seen_.end()) {
      known->second = now;
      return true;
    }
    const double seconds = std::chrono::duration<double>(now - last_newcomer_).count();
    const double places = std::min<double>(most_at_once, places_ + seconds);
    if (places < 1) return false;
    places_ = places - 1;
    last_newcomer_ = now;
    if (last_seen_.size() >= most_known) {
      last_seen_.erase(std::min_element(
          last_seen_.begin(), last_seen_.end(),
          [](const auto& one, const auto& other) { return one.second < other.second; }));
    }
    last_seen_.emplace(source, now);
    return true;
  }

  std::map<Prefix, Time> last_seen_{};
  double places_ = most_at_once;  ///< for newcomers, at the last one
  Time last_newcomer_{};
};

}  // namespace articula::ros2::dds

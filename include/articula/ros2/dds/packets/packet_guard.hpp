// SPDX-License-Identifier: Apache-2.0
/// @file What Fast DDS gets of a packet from the network.
#pragma once

#include "articula/ros2/dds/packets/discovery_filter.hpp"
#include "articula/ros2/dds/packets/packet_check.hpp"
#include "articula/ros2/dds/packets/participant_gate.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

namespace articula::ros2::dds {

/// Stands between the network and Fast DDS. It drops packets that would harm Fast DDS, and changes
/// others: see is_well_formed, filter_discovery, ParticipantGate and WriterNumbers. For any
/// threads. Real-time: no (allocates, locks).
class PacketGuard {
 public:
  using Time = ParticipantGate::Time;
  using Guid = std::array<std::byte, 16>;

  /// Notes a socket of one participant. Those for discovery have even ports ([RTPS], 9.6.1.1).
  void add_socket(std::uint32_t port) noexcept { (port % 2 == 0 ? discovers_ : listens_) = true; }
  /// Whether there are sockets for discovery and for messages.
  [[nodiscard]] bool has_sockets() const noexcept { return discovers_ && listens_; }
  /// Whether to hand on a packet that has come.
  /// @param[in,out] packet  from the network
  [[nodiscard]] bool receive(std::span<std::byte> packet, Time now) {
    if (!is_well_formed(packet)) return false;
    filter_discovery(packet);
    const std::lock_guard lock(mutex_);
    if (!gate_.admits(packet, now)) return false;
    number(packet, now);
    return true;
  }
  /// What Fast DDS gets for participants whose leases have ended.
  [[nodiscard]] std::vector<std::vector<std::byte>> farewells() {
    const std::lock_guard lock(mutex_);
    return gate_.farewells();
  }
  /// Whether a packet has a participant's announcement.
  [[nodiscard]] static bool has_announcement(Packet packet) {
    bool has = false;
    for_each_part(packet, [&](std::uint32_t kind, std::uint32_t, Packet part) {
      has = has ||
            (kind == detail::message_part && detail::writer_of(part) == detail::participant_writer);
      return true;
    });
    return has;
  }
  /// Changes a packet of Fast DDS such that its receivers understand it.
  /// @param[in,out] packet  to the network
  void send(std::span<std::byte> packet) {
    if (packet.size() < packet_header) return;
    const std::lock_guard lock(mutex_);
    Prefix receiver{};
    for_each_part(packet, [&](std::uint32_t kind, std::uint32_t flags, Packet part) {
      if (kind == detail::destination_part) receiver = prefix_at(part, 0);
      if (!acknowledges(kind)) return true;
      const bool little = (flags & 1U) != 0;
      constexpr std::size_t writer = 4, number = 8;
      WriterNumbers* const numbers =
          numbers_of(receiver, detail::number_at(part, writer, 4, false));
      if (numbers == nullptr) return true;
      const std::uint64_t own = detail::sequence_at(part, number, little);
      const bool is_all = kind == detail::acknowledgement_part;
      const std::uint64_t theirs = is_all ? numbers->acknowledge(own) : numbers->original(own);
      detail::put_sequence(detail::mutable_part(packet, part), number, little, theirs);
      return true;
    });
  }
  /// Whether `send` has to see a packet.
  [[nodiscard]] static bool has_acknowledgement(Packet packet) {
    bool has = false;
    if (packet.size() < packet_header) return false;
    for_each_part(packet, [&](std::uint32_t kind, std::uint32_t, Packet) {
      has = has || acknowledges(kind);
      return true;
    });
    return has;
  }
  /// The number of a message that the sender knows.
  /// @param number  as Fast DDS has got it
  [[nodiscard]] std::uint64_t original(const Guid& writer, std::uint64_t number) {
    const std::lock_guard lock(mutex_);
    const WriterNumbers* const numbers = numbers_of(writer);
    return numbers == nullptr ? number : numbers->original(number);
  }

 private:
  static constexpr bool acknowledges(std::uint32_t kind) {
    return kind == detail::acknowledgement_part || kind == detail::fragments_missing_part;
  }

  [[nodiscard]] WriterNumbers* numbers_of(const Prefix& source, std::uint32_t writer) {
    KnownEndpoints* const known = gate_.endpoints_of(source);
    return known == nullptr ? nullptr : known->numbers_of(writer);
  }

  [[nodiscard]] WriterNumbers* numbers_of(const Guid& writer) {
    constexpr std::size_t entity = Prefix{}.size();
    return numbers_of(prefix_at(writer, 0), detail::number_at(writer, entity, 4, false));
  }

  /// Puts the numbers of WriterNumbers into the parts of a packet. Hides those that have none.
  void number(std::span<std::byte> packet, Time now) {
    Prefix source = prefix_at(packet, 8);
    for_each_part(packet, [&](std::uint32_t kind, std::uint32_t flags, Packet part) {
      if (kind == detail::source_part) source = prefix_at(part, 8);
      const bool is_message = kind == detail::message_part || kind == detail::fragment_part;
      const bool has_numbers = is_message || kind == detail::gap_part ||
                               kind == detail::heartbeat_part ||
                               kind == detail::fragments_heartbeat_part;
      if (!has_numbers) return true;
      const std::uint32_t writer = detail::number_at(part, is_message ? 8 : 4, 4, false);
      WriterNumbers* const numbers = numbers_of(source, writer);
      if (numbers == nullptr) return true;  // Fast DDS does not know the writer, either
      const Place place{detail::mutable_part(packet, part), (flags & 1U) != 0};
      if (kind == detail::heartbeat_part) {
        place.put(8, numbers->of_beginning(place.at(8), budget_, now));
        place.put(16, numbers->of_end(place.at(16)));
        return true;
      }
      if (kind == detail::gap_part) {
        if (!number_gap(*numbers, place, now)) detail::hide_part(packet, part, flags);
        return true;
      }
      const std::size_t at = is_message ? 12 : 8;
      const auto own = numbers->of_message(place.at(at), budget_, now);
      if (!own || (detail::is_builtin(writer) && !numbers->is_near(*own))) {
        detail::hide_part(packet, part, flags);
      } else {
        place.put(at, *own);
      }
      return true;
    });
  }

  /// A part of a packet with numbers.
  struct Place {
    std::span<std::byte> part{};
    bool little = false;
    [[nodiscard]] std::uint64_t at(std::size_t byte) const {
      return detail::sequence_at(part, byte, little);
    }
    void put(std::size_t byte, std::uint64_t value) const {
      detail::put_sequence(part, byte, little, value);
    }
  };

  bool number_gap(WriterNumbers& numbers, const Place& place, Time now) {
    const std::uint64_t end = place.at(16);
    const auto gap = numbers.of_gap(place.at(8), end, budget_, now);
    if (!gap) return false;
    const bool is_whole = numbers.original(gap->end) == end;
    if (!is_whole) std::fill_n(place.part.begin() + 24, 4, std::byte{0});  // no further numbers
    place.put(8, gap->begin);
    place.put(16, gap->end);
    return true;
  }

  std::atomic<bool> discovers_ = false, listens_ = false;
  std::mutex mutex_{};
  ParticipantGate gate_{};
  // Fast DDS 2.9.1 takes some 1.2 us for each step: a third of a core.
  Budget budget_{WriterNumbers::longest, WriterNumbers::longest};
};

}  // namespace articula::ros2::dds

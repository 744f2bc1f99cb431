// SPDX-License-Identifier: Apache-2.0
/// @file A limit on how many new participants of a domain are heard in a time.
#pragma once

#include "articula/ros2/dds/packets/budget.hpp"
#include "articula/ros2/dds/packets/discovery_filter.hpp"
#include "articula/ros2/dds/packets/known_endpoints.hpp"
#include "articula/ros2/dds/packets/packet_check.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <initializer_list>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace articula::ros2::dds {

namespace detail {

/// What a participant sends at its end: inline its key and a status, then its identity.
/// @param number  of this message, larger than those of its announcements
[[nodiscard]] inline std::vector<std::byte> farewell(const Prefix& prefix, std::uint64_t number) {
  std::vector<std::byte> packet;
  const auto put = [&](std::initializer_list<unsigned> bytes) {
    for (const unsigned byte : bytes) packet.push_back(static_cast<std::byte>(byte));
  };
  const auto put_identity = [&] {
    packet.insert(packet.end(), prefix.begin(), prefix.end());
    put({0, 0, 1, 0xc1});
  };
  put({'R', 'T', 'P', 'S', 2, 3, 1, 15});
  packet.insert(packet.end(), prefix.begin(), prefix.end());
  // Little endian, with an inline list and a key; 80 bytes. The list begins after 16 bytes.
  put({message_part, 0x0b, 80, 0, 0, 0, 16, 0, 0, 1, 0, 0xc7, 0, 1, 0, 0xc2});
  const std::size_t at = packet.size();
  packet.resize(at + 8);
  put_sequence(std::span(packet), at, true, number);
  put({0x70, 0, 16, 0});
  put_identity();
  put({0x71, 0, 4, 0, 0, 0, 0, 3, 1, 0, 0, 0});  // disposed and unregistered
  put({0, 3, 0, 0, 0x50, 0, 16, 0});
  put_identity();
  put({1, 0, 0, 0});
  return packet;
}

}  // namespace detail

/// Decides which announcements of participants Fast DDS gets to see. Fast DDS 2.9.1 keeps some 80
/// bytes for ever of each participant that has ever announced itself, also of those for which it
/// has no room. Under a storm of announcements its memory would grow without end.
///
/// So many participants may be new at once, and then one per second. As many more come in at their
/// second announcement: participants repeat theirs, and a storm of ever new ones does not. Those
/// that are known may announce themselves as often as they like.
///
/// Leases end here, and Fast DDS gets the end of the participant as if it had said so. Fast DDS
/// 2.9.1 has no leases that end: its checks of them end the program if a participant leaves at that
/// time, and stand still if a writer does.
///
/// Announcements of readers and writers pass if their participant is known. Those for which there
/// is no room, or that KnownEndpoints refuses, become gaps. All other packets pass. For one thread
/// at a time.
class ParticipantGate {
 public:
  using Time = std::chrono::steady_clock::time_point;

  static constexpr int most_at_once = 256;
  static constexpr std::size_t most_known = 4096;      ///< for longest_lease after their last sign
  static constexpr std::size_t most_memory = 1 << 28;  ///< for all announcements [bytes]
  static constexpr std::size_t most_waiting = 8192;    ///< for their second announcement
  static constexpr std::chrono::seconds longest_pause{4};  ///< of packets, in leases
  static constexpr std::chrono::seconds own_lease{20};     ///< as rmw_fastrtps

  /// Whether to hand a packet on.
  /// @param[in,out] packet  well-formed, as filter_discovery left it
  /// @param now             not before the last one
  /// Real-time: no (allocates).
  [[nodiscard]] bool admits(std::span<std::byte> packet, Time now) {
    Prefix source = prefix_at(packet, 8);
    // While this program stood still it could hear nobody: no lease ends by that. After its own
    // lease nobody knows it any more, and it must know nobody: Cyclone DDS returns only then. Peers
    // count from its last packet that they got, which is older than the last one that came.
    was_forgotten_ = was_forgotten_ || (now_ != Time{} && now - now_ > own_lease - longest_pause);
    heard_ += std::clamp(now - now_, Time::duration{}, Time::duration(longest_pause));
    now_ = now;
    note_sign(source, now);
    return for_each_part(packet, [&](std::uint32_t kind, std::uint32_t flags, Packet part) {
      if (kind == detail::source_part) note_sign(source = prefix_at(part, 8), now);
      if (kind != detail::message_part) return true;
      const auto discovery = detail::discovery_of(part, flags);
      if (!discovery) return true;
      const bool is_participant = discovery->writer == detail::participant_writer;
      if (!KnownEndpoints::is_of(source, *discovery)) return false;
      if (is_participant && !discovery->ends) {
        if (!can_end(*discovery) || !admits(source, now)) return false;
      }
      const auto known = known_.find(source);
      if (known == known_.end()) return false;
      if (!admits(known->second.endpoints, *discovery)) {
        if (is_participant) return false;
        detail::make_gap(packet, flags, part);
      } else if (is_participant) {
        note_lease(packet, known->second, *discovery);
      }
      return true;
    });
  }

  /// The ends of participants whose leases have ended, or of all after a long standstill. They are
  /// as the participants would have announced them.
  [[nodiscard]] std::vector<std::vector<std::byte>> farewells() {
    std::vector<std::vector<std::byte>> all;
    if (!was_forgotten_ && heard_ - checked_ < std::chrono::milliseconds(100)) return all;
    checked_ = heard_;
    const bool ends_all = std::exchange(was_forgotten_, false);
    for (auto& [prefix, known] : known_) {
      // A peer may have been silent for most of its lease when this program stood still.
      const bool is_late = heard_ - known.heard > known.lease + longest_pause;
      if (!known.lives || (!ends_all && !is_late)) continue;
      known.lives = false;
      known.endpoints.end();
      all.push_back(detail::farewell(prefix, known.number + 1));
    }
    return all;
  }

  /// What a participant has announced; null if it is not known.
  [[nodiscard]] KnownEndpoints* endpoints_of(const Prefix& source) {
    const auto known = known_.find(source);
    return known == known_.end() ? nullptr : &known->second.endpoints;
  }

 private:
  struct Known {
    Time last{};             ///< sign
    Time::duration heard{};  ///< likewise, by heard_
    bool lives = false;      ///< Fast DDS has it, if there was room
    bool has_left = false;   ///< said so itself
    std::chrono::seconds lease{};
    std::uint64_t number = 0;  ///< largest one of its announcements
    KnownEndpoints endpoints{};
  };

  [[nodiscard]] bool admits(const Prefix& source, Time now) {
    if (known_.contains(source)) return true;
    if (first_.take(1, now) == 0 && !(waiting_.contains(source) && second_.take(1, now) == 1)) {
      await(source);
      return false;
    }
    forget_silent(now);
    if (known_.size() >= most_known) return false;
    Known& known = known_[source];
    known.last = now;
    known.heard = heard_;
    return true;
  }

  /// A message of discovery of a participant that is known.
  [[nodiscard]] bool admits(KnownEndpoints& endpoints, const detail::DiscoveryMessage& message) {
    if (message.ends) endpoints.end(message);
    if (!message.list || message.ends) return true;
    const std::size_t before = endpoints.memory();
    const bool admitted = endpoints.admits(message, most_memory - memory_);
    memory_ += endpoints.memory() - before;
    return admitted;
  }

  /// Forgets participants that Fast DDS does not have any more, since their leases are over.
  void forget_silent(Time now) {
    std::erase_if(known_, [&](const auto& each) {
      const Known& own = each.second;
      const bool is_silent =
          !own.lives && now - own.last > std::chrono::seconds(detail::longest_lease);
      if (is_silent) memory_ -= own.endpoints.memory();
      return is_silent;
    });
  }
  /// A participant is kept as long as packets come from it.
  void note_sign(const Prefix& source, Time now) {
    const auto known = known_.find(source);
    if (known == known_.end()) return;
    known->second.last = now;
    known->second.heard = heard_;
  }
  /// Whether Fast DDS will end a participant at its farewell. It heeds that of one alone which has
  /// a writer of announcements. Without a lease it would check an own one, which is 0.
  [[nodiscard]] static bool can_end(const detail::DiscoveryMessage& announcement) {
    if (!announcement.list) return true;  // Fast DDS does not read it
    bool has_lease = false, has_writer = false;
    announcement.list->for_each([&](std::uint32_t id, Packet value, detail::Worth worth) {
      constexpr std::uint32_t lease = 0x02, builtin_endpoints = 0x58;
      if (worth != detail::Worth::whole) return true;
      has_lease = has_lease || id == lease;
      if (id == builtin_endpoints) {  // the last one counts
        has_writer = (detail::number_at(value, 0, 4, announcement.list->little) & 1U) != 0;
      }
      return true;
    });
    return has_lease && has_writer;
  }
  /// Takes the lease out of an announcement, and puts one that does not end.
  void note_lease(std::span<std::byte> packet, Known& known,
                  const detail::DiscoveryMessage& announcement) {
    known.number = std::max(known.number, announcement.number);
    // Fast DDS may take an end for an old message: the participant ends by its lease then.
    known.has_left = known.has_left || announcement.ends;
    if (!announcement.list || announcement.ends) return;
    const bool has_left = std::exchange(known.has_left, false);
    if (has_left || !known.lives) known.endpoints.begin_numbers();
    known.lives = true;
    const bool little = announcement.list->little;
    announcement.list->for_each([&](std::uint32_t id, Packet value, detail::Worth worth) {
      constexpr std::uint32_t lease = 0x02;
      if (id != lease || worth != detail::Worth::whole) return true;
      const std::uint32_t seconds = detail::number_at(value, 0, 4, little);
      const bool has_fraction = detail::number_at(value, 4, 4, little) != 0;
      known.lease = std::chrono::seconds(std::min(seconds, detail::longest_lease) +
                                         (has_fraction || seconds == 0 ? 1 : 0));
      const std::span<std::byte> own = detail::mutable_part(packet, value);
      std::fill(own.begin(), own.end(), std::byte{0xff});
      own[little ? 3 : 0] = std::byte{0x7f};
      return true;
    });
  }

  /// Remembers a participant until it announces itself again, or many others have come.
  void await(const Prefix& source) {
    if (!waiting_.insert(source).second) return;
    order_.push_back(source);
    if (order_.size() <= most_waiting) return;
    waiting_.erase(order_.front());
    order_.pop_front();
  }

  std::map<Prefix, Known> known_{};
  Time now_{};                  ///< of the last packet
  Time::duration heard_{};      ///< time in which packets could come
  Time::duration checked_{};    ///< heard_ when leases were checked
  bool was_forgotten_ = false;  ///< by all peers
  std::size_t memory_ = 0;      ///< of their announcements
  std::set<Prefix> waiting_{};
  std::deque<Prefix> order_{};                       ///< of those that wait, the oldest first
  Budget first_{most_at_once, 1}, second_ = first_;  ///< of first and second announcements
};

}  // namespace articula::ros2::dds

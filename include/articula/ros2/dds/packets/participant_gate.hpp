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
#include <map>
#include <set>
#include <span>

namespace articula::ros2::dds {

/// Decides which announcements of participants Fast DDS gets to see. Fast DDS 2.9.1 keeps some 80
/// bytes for ever of each participant that has ever announced itself, also of those for which it
/// has no room. Under a storm of announcements its memory would grow without end.
///
/// So many participants may be new at once, and then one per second. As many more come in at their
/// second announcement: participants repeat theirs, and a storm of ever new ones does not. Those
/// that are known may announce themselves as often as they like.
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

  /// Whether to hand a packet on.
  /// @param[in,out] packet  well-formed, as filter_discovery left it
  /// @param now             not before the last one
  /// Real-time: no (allocates).
  [[nodiscard]] bool admits(std::span<std::byte> packet, Time now) {
    Prefix source = prefix_at(packet, 8);
    note_sign(source, now);
    return for_each_part(packet, [&](std::uint32_t kind, std::uint32_t flags, Packet part) {
      if (kind == detail::source_part) note_sign(source = prefix_at(part, 8), now);
      if (kind != detail::message_part) return true;
      const auto discovery = detail::discovery_of(part, flags);
      if (!discovery) return true;
      const bool is_participant = discovery->writer == detail::participant_writer;
      if (!KnownEndpoints::is_of(source, *discovery)) return false;
      if (is_participant && !discovery->ends && !admits(source, now)) return false;
      const auto known = known_.find(source);
      if (known == known_.end()) return false;
      if (admits(known->second.endpoints, *discovery)) return true;
      if (is_participant) return false;
      detail::make_gap(packet, flags, part);
      return true;
    });
  }

  /// What a participant has announced; null if it is not known.
  [[nodiscard]] KnownEndpoints* endpoints_of(const Prefix& source) {
    const auto known = known_.find(source);
    return known == known_.end() ? nullptr : &known->second.endpoints;
  }

 private:
  struct Known {
    Time last{};  ///< sign
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
    known_[source].last = now;
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
      const bool is_silent = now - own.last > std::chrono::seconds(detail::longest_lease);
      if (is_silent) memory_ -= own.endpoints.memory();
      return is_silent;
    });
  }
  /// Fast DDS keeps a participant as long as packets come from it.
  void note_sign(const Prefix& source, Time now) {
    if (const auto known = known_.find(source); known != known_.end()) known->second.last = now;
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
  std::size_t memory_ = 0;  ///< of their announcements
  std::set<Prefix> waiting_{};
  std::deque<Prefix> order_{};                       ///< of those that wait, the oldest first
  Budget first_{most_at_once, 1}, second_ = first_;  ///< of first and second announcements
};

}  // namespace articula::ros2::dds

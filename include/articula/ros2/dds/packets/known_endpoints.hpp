// SPDX-License-Identifier: Apache-2.0
/// @file What a participant and its readers and writers have announced of themselves.
#pragma once

#include "articula/ros2/dds/packets/discovery_message.hpp"
#include "articula/ros2/dds/packets/writer_numbers.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace articula::ros2::dds {

/// The beginning of the identity of all that a participant has.
using Prefix = std::array<std::byte, 12>;

/// The prefix in some bytes, which are there.
inline Prefix prefix_at(Packet bytes, std::size_t at) {
  Prefix prefix{};
  std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), prefix.size(), prefix.begin());
  return prefix;
}

/// What a participant and its readers and writers have announced of themselves. What DDS forbids to
/// change never changes, also not after their end: names, durability, liveliness, ownership, order,
/// reliability. Nor does the lease of a participant. Fast DDS 2.9.1 ends the program if a reader
/// becomes reliable. Readers and writers of a topic are bounded, but an end that Fast DDS ignores
/// makes room here, too. Addresses are bounded.
/// For one thread at a time. Real-time: no (allocates).
class KnownEndpoints {
 public:
  static constexpr std::size_t most = 1 << 16;         ///< in the life of a participant
  static constexpr int most_of_topic = 128;            ///< readers at a time, and writers
  static constexpr std::size_t most_addresses = 64;    ///< in the life of a participant
  static constexpr std::size_t most_memory = 1 << 26;  ///< for announcements [bytes]

  /// Whether all identities in a message are one, of a participant or of something that it has.
  [[nodiscard]] static bool is_of(const Prefix& source, const detail::DiscoveryMessage& message) {
    std::optional<std::uint32_t> entity;
    if (message.writer == detail::participant_writer) entity = 0x000001c1;  // [RTPS], table 9.1
    int count = 0;
    const auto agrees = [&](Packet identity) {
      if (identity.size() != 16) return false;
      const std::uint32_t own = detail::number_at(identity, source.size(), 4, false);
      if (own == 0 || entity.value_or(own) != own) return false;
      entity = own;
      return std::equal(source.begin(), source.end(), identity.begin());
    };
    const auto check = [&](const detail::ParameterList& list, std::uint32_t id) {
      return list.for_each([&](std::uint32_t own, Packet value, detail::Worth) {
        if (own != id) return true;
        ++count;
        return agrees(value);
      });
    };
    if (message.body.has_inline_list && !check(message.body.inline_list, key)) return false;
    if (!message.list) return true;
    count = 0;
    return check(*message.list, identity_in(message)) && count == 1;
  }

  /// Whether an announcement says what others of the same thing did, and there is room for it.
  /// Fast DDS 2.9.1 may keep each number of an endpoint that is announced again.
  /// @param message  is_of, with a list
  /// @param room     for what Fast DDS keeps of it [bytes]
  [[nodiscard]] bool admits(const detail::DiscoveryMessage& message, std::size_t room) {
    const std::size_t memory = 1024 + message.list->bytes.size();  // roughly
    const Name name{message.writer, entity_in(message)};
    const auto known = said_.find(name);
    const bool is_new = known == said_.end();
    if (is_new && said_.size() >= most) return false;
    const std::size_t constants = constants_of(*message.list);
    if (!is_new && known->second.constants != constants) return false;

    const bool is_participant = message.writer == detail::participant_writer;
    const bool is_repeated = !is_new && (is_participant || message.number == known->second.number);
    const std::size_t kept = is_repeated ? std::min(memory, known->second.memory) : 0;
    const std::size_t more = memory - kept;
    if (more > std::min(room, most_memory - memory_)) return false;
    if (!has_room_for_addresses(*message.list)) return false;
    const Topic topic{message.writer, topic_in(*message.list)};
    const bool joins = !is_participant && (is_new || !known->second.lives);
    if (const auto living = living_.find(topic);
        joins && living != living_.end() && living->second >= most_of_topic) {
      return false;
    }

    Said& said = said_[name];
    said.constants = constants;
    said.number = message.number;
    said.memory += more;
    memory_ += more;
    if (joins) {
      said.lives = true;
      said.topic = topic;
      said.numbers = {};
      ++living_[topic];
    }
    return true;
  }
  /// Notes that the participant ends with all that it has.
  void end() {
    for (auto& each : said_) each.second.lives = false;
    living_.clear();
  }
  /// Notes that something ends: a reader, a writer, or the participant with all that it has.
  /// @param message  is_of, and ends
  void end(const detail::DiscoveryMessage& message) {
    if (message.writer == detail::participant_writer) {
      end();
    } else if (const auto own = said_.find({message.writer, entity_in(message)});
               own != said_.end() && own->second.lives) {
      own->second.lives = false;
      const auto living = living_.find(own->second.topic);
      if (living != living_.end() && --living->second == 0) living_.erase(living);
    }
  }
  /// Notes that the participant is found anew. Fast DDS has forgotten how far its writers were.
  void begin_numbers() { builtin_.clear(); }
  /// What Fast DDS keeps of all that was announced, at most [bytes].
  [[nodiscard]] std::size_t memory() const { return memory_; }

  /// The numbers of a writer, if it is known. Those of discovery and of liveliness are.
  [[nodiscard]] WriterNumbers* numbers_of(std::uint32_t writer) {
    constexpr std::uint32_t liveliness_writer = 0x000200c2;
    if (detail::writes_endpoints(writer) || writer == liveliness_writer) return &builtin_[writer];
    const auto known = said_.find({detail::writer_writer, writer});
    return known == said_.end() ? nullptr : &known->second.numbers;
  }

 private:
  using Name = std::pair<std::uint32_t, std::uint32_t>;  // writer of discovery, entity
  using Topic = std::pair<std::uint32_t, std::string>;   // writer of discovery, name
  static constexpr std::uint32_t topic_name = 0x05, key = 0x70;
  struct Said {
    std::size_t constants = 0, memory = 0;
    std::uint64_t number = 0;  ///< of the announcement
    bool lives = false;        ///< a reader or a writer
    Topic topic{};
    WriterNumbers numbers{};
  };

  /// The parameter with the identity of what a message announces.
  [[nodiscard]] static std::uint32_t identity_in(const detail::DiscoveryMessage& message) {
    return message.writer == detail::participant_writer ? 0x50 : 0x5a;
  }
  /// The entity that a message names: in its list, or by a key.
  [[nodiscard]] static std::uint32_t entity_in(const detail::DiscoveryMessage& message) {
    std::uint32_t entity = 0;
    const auto find = [&](const detail::ParameterList& list, std::uint32_t identity) {
      list.for_each([&](std::uint32_t id, Packet value, detail::Worth) {
        if (id == identity) entity = detail::number_at(value, Prefix{}.size(), 4, false);
        return true;
      });
    };
    if (message.body.has_inline_list) find(message.body.inline_list, key);
    if (message.list) find(*message.list, identity_in(message));
    return entity;
  }
  /// The name of a topic as Fast DDS reads it: the last one, up to its first byte that is zero.
  [[nodiscard]] static std::string topic_in(const detail::ParameterList& list) {
    std::string name;
    list.for_each([&](std::uint32_t id, Packet value, detail::Worth worth) {
      if (id != topic_name || worth != detail::Worth::whole) return true;
      name.clear();
      for (std::size_t k = 4; k < value.size() && value[k] != std::byte{0}; ++k) {
        name += static_cast<char>(value[k]);
      }
      return true;
    });
    return name;
  }
  /// A number for all that must not change, which nobody else can foresee.
  [[nodiscard]] static std::size_t constants_of(const detail::ParameterList& list) {
    static const std::uint32_t secret = std::random_device()();
    std::string text = std::to_string(secret);
    list.for_each([&](std::uint32_t id, Packet value, detail::Worth worth) {
      constexpr std::array<std::uint32_t, 9> constants{0x02, topic_name, 0x07, 0x1a, 0x1b,
                                                       0x1d, 0x1f,       0x21, 0x25};
      if (worth != detail::Worth::whole) return true;  // Fast DDS does not see it
      if (std::find(constants.begin(), constants.end(), id) == constants.end()) return true;
      text += static_cast<char>(id) + std::to_string(value.size()) + ':';
      for (const std::byte byte : value) text += static_cast<char>(byte);
      return true;
    });
    return std::hash<std::string>()(text);
  }
  /// Notes the addresses in a list. Fast DDS 2.9.1 keeps each to which it has ever sent, and goes
  /// through all of them at each packet.
  [[nodiscard]] bool has_room_for_addresses(const detail::ParameterList& list) {
    return list.for_each([&](std::uint32_t id, Packet value, detail::Worth worth) {
      constexpr std::array<std::uint32_t, 6> ids{0x2f, 0x30, 0x31, 0x32, 0x33, 0x48};
      if (worth != detail::Worth::whole) return true;
      if (std::find(ids.begin(), ids.end(), id) == ids.end()) return true;
      std::string address;
      for (const std::byte byte : value) address += static_cast<char>(byte);
      if (addresses_.contains(address)) return true;
      if (addresses_.size() >= most_addresses) return false;
      addresses_.insert(std::move(address));
      return true;
    });
  }

  std::map<Name, Said> said_{};
  std::map<Topic, int> living_{};  ///< readers and writers
  std::set<std::string> addresses_{};
  std::size_t memory_ = 0;
  std::map<std::uint32_t, WriterNumbers> builtin_{};
};

}  // namespace articula::ros2::dds

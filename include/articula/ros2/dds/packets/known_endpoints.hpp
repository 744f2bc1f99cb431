// SPDX-License-Identifier: Apache-2.0
/// @file What a participant and its readers and writers have announced of themselves.
#pragma once

#include "articula/ros2/dds/packets/discovery_message.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <utility>

namespace articula::ros2::dds {

/// The beginning of the identity of all that a participant has.
using Prefix = std::array<std::byte, 12>;

/// What a participant and its readers and writers have announced of themselves. What DDS forbids to
/// change never changes: names, durability, liveliness, ownership, order, reliability. Nor does the
/// lease of a participant. Fast DDS 2.9.1 ends the program if a reader becomes reliable.
/// For one thread at a time. Real-time: no (allocates).
class KnownEndpoints {
 public:
  static constexpr std::size_t most = 4096;  ///< of one participant at a time

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

  /// Whether an announcement says what others of the same thing did.
  /// @param message  is_of, with a list
  /// @param room     for memory_of it, if it is new [bytes]
  [[nodiscard]] bool admits(const detail::DiscoveryMessage& message, std::size_t room) {
    const Name name{message.writer, entity_in(*message.list, identity_in(message))};
    const std::size_t constants = constants_of(*message.list), memory = memory_of(message);
    if (const auto known = said_.find(name); known != said_.end()) {
      Said& said = known->second;
      if (said.constants != constants) return false;
      if (memory > said.memory + room) return false;
      if (message.number > std::max(said.announced, said.ended)) take(said, memory);
      said.announced = std::max(said.announced, message.number);
      return true;
    }
    if (said_.size() >= most) forget_ended();
    if (said_.size() >= most || memory > room) return false;
    if (message.number <= forgotten_[message.writer]) return false;
    take(said_[name] = {.constants = constants, .announced = message.number}, memory);
    return true;
  }
  /// What a message names has ended.
  /// @param message  is_of, not of a participant
  void end(const detail::DiscoveryMessage& message) {
    Name name{message.writer, 0};
    if (message.list) name.second = entity_in(*message.list, identity_in(message));
    if (name.second == 0) name.second = entity_in(message.body.inline_list, key);
    const auto known = said_.find(name);
    if (known == said_.end() || message.number <= known->second.announced) return;
    known->second.ended = std::max(known->second.ended, message.number);
    take(known->second, 0);
  }
  /// What all that has not ended takes [bytes].
  [[nodiscard]] std::size_t memory() const { return memory_; }

 private:
  static constexpr std::uint32_t key = 0x70;

  using Name = std::pair<std::uint32_t, std::uint32_t>;  // writer of discovery, entity
  struct Said {
    std::size_t constants = 0, memory = 0;       ///< no memory: it has ended
    std::uint64_t announced = 0, ended = 0;  ///< numbers of the last messages
  };

  /// What Fast DDS keeps of an announcement, roughly [bytes].
  [[nodiscard]] static std::size_t memory_of(const detail::DiscoveryMessage& message) {
    return 1024 + message.list->bytes.size();
  }
  void take(Said& said, std::size_t memory) {
    memory_ += memory - said.memory;  // modulo
    said.memory = memory;
  }

  /// Makes room. Fast DDS may see messages in another order than they come: an announcement from
  /// before the end of something that is forgotten could change what Fast DDS still knows.
  void forget_ended() {
    std::erase_if(said_, [&](const auto& each) {
      const auto& [name, said] = each;
      if (said.memory > 0) return false;
      std::uint64_t& last = forgotten_[name.first];
      last = std::max(last, said.ended);
      return true;
    });
  }
  /// The parameter with the identity of what a message announces.
  [[nodiscard]] static std::uint32_t identity_in(const detail::DiscoveryMessage& message) {
    return message.writer == detail::participant_writer ? 0x50 : 0x5a;
  }
  /// The entity in a parameter of a list; 0 if it is not there.
  [[nodiscard]] static std::uint32_t entity_in(const detail::ParameterList& list,
                                               std::uint32_t parameter) {
    std::uint32_t entity = 0;
    list.for_each([&](std::uint32_t id, Packet value, detail::Worth) {
      if (id == parameter) entity = detail::number_at(value, Prefix{}.size(), 4, false);
      return true;
    });
    return entity;
  }
  /// A number for all that must not change, which nobody else can foresee.
  [[nodiscard]] static std::size_t constants_of(const detail::ParameterList& list) {
    static const std::uint32_t secret = std::random_device()();
    std::string text = std::to_string(secret);
    list.for_each([&](std::uint32_t id, Packet value, detail::Worth worth) {
      constexpr std::array<std::uint32_t, 9> constants{0x02, 0x05, 0x07, 0x1a, 0x1b,
                                                       0x1d, 0x1f, 0x21, 0x25};
      if (worth != detail::Worth::whole) return true;  // Fast DDS does not see it
      if (std::find(constants.begin(), constants.end(), id) == constants.end()) return true;
      text += static_cast<char>(id) + std::to_string(value.size()) + ':';
      for (const std::byte byte : value) text += static_cast<char>(byte);
      return true;
    });
    return std::hash<std::string>()(text);
  }

  std::map<Name, Said> said_{};
  std::size_t memory_ = 0;
  std::map<std::uint32_t, std::uint64_t> forgotten_{};  ///< the last end, by writer of discovery
};

}  // namespace articula::ros2::dds

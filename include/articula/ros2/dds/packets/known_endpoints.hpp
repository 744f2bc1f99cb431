// SPDX-License-Identifier: Apache-2.0
/// @file What a participant and its readers and writers have announced of themselves.
#pragma once

#include "articula/ros2/dds/packets/packet_check.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <random>
#include <string>

namespace articula::ros2::dds {

/// The beginning of the identity of all that a participant has.
using Prefix = std::array<std::byte, 12>;

/// What a participant and its readers and writers have announced of themselves. What DDS forbids to
/// change never changes: names, durability, liveliness, ownership, order, reliability. Nor does the
/// lease of a participant. Fast DDS 2.9.1 ends the program if a reader becomes reliable.
/// For one thread at a time. Real-time: no (allocates).
class KnownEndpoints {
 public:
  static constexpr std::size_t most = 4096;  ///< in the life of a participant

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
    constexpr std::uint32_t key = 0x70;
    if (message.body.has_inline_list && !check(message.body.inline_list, key)) return false;
    if (!message.list) return true;
    count = 0;
    return check(*message.list, identity_in(message)) && count == 1;
  }

  /// Whether an announcement says what others of the same thing did.
  /// @pre is_of, and the message has a list
  [[nodiscard]] bool admits(const detail::DiscoveryMessage& message) {
    std::uint32_t entity = 0;
    message.list->for_each([&](std::uint32_t id, Packet value, detail::Worth) {
      if (id == identity_in(message)) entity = detail::number_at(value, 12, 4, false);
      return true;
    });
    const std::size_t said = constants_of(*message.list);
    const auto known = said_.find(entity);
    if (known != said_.end()) return known->second == said;
    return said_.size() < most && said_.emplace(entity, said).second;
  }

 private:
  /// The parameter with the identity of what a message announces.
  [[nodiscard]] static std::uint32_t identity_in(const detail::DiscoveryMessage& message) {
    return message.writer == detail::participant_writer ? 0x50 : 0x5a;
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

  std::map<std::uint32_t, std::size_t> said_{};  ///< by entity
};

}  // namespace articula::ros2::dds

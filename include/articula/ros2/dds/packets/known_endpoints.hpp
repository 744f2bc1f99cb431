// SPDX-License-Identifier: Apache-2.0
/// @file What a participant and its readers and writers have announced of themselves.
#pragma once

#include "articula/ros2/dds/packets/discovery_check.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
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
  static constexpr std::size_t most = 1024;
  static constexpr std::uint32_t participant = 0x50, endpoint = 0x5a;  ///< parameters: identities

  /// Whether a list of parameters has one identity, which is of a participant.
  /// @param id           of the parameter with the identity
  /// @param[out] entity  which of the participant's things it is
  [[nodiscard]] static bool is_of(const Prefix& source, const detail::ParameterList& list,
                                  std::uint32_t id, std::uint32_t& entity) {
    int count = 0;
    bool is_own = true;
    list.for_each([&](std::uint32_t own, Packet value, detail::Worth worth) {
      if (own != id || worth != detail::Worth::whole) return true;
      ++count;
      is_own = is_own && std::equal(source.begin(), source.end(), value.begin());
      entity = detail::number_at(value, source.size(), 4, false);
      return true;
    });
    return count == 1 && is_own && entity != 0;
  }

  /// Whether an announcement is of the participant and says what others of the same thing did.
  /// @param list  whole
  /// @param id    of the parameter with the identity
  [[nodiscard]] bool admits(const Prefix& source, const detail::ParameterList& list,
                            std::uint32_t id) {
    std::uint32_t entity = 0;
    if (!is_of(source, list, id, entity)) return false;
    const std::size_t said = constants_of(list);
    const auto known = said_.find(entity);
    if (known != said_.end()) return known->second == said;
    return said_.size() < most && said_.emplace(entity, said).second;
  }

 private:
  /// A number for all that must not change, which nobody else can foresee.
  [[nodiscard]] static std::size_t constants_of(const detail::ParameterList& list) {
    static const std::uint32_t secret = std::random_device()();
    std::string text = std::to_string(secret);
    list.for_each([&](std::uint32_t id, Packet value, detail::Worth) {
      constexpr std::array<std::uint32_t, 9> constants{0x02, 0x05, 0x07, 0x1a, 0x1b,
                                                       0x1d, 0x1f, 0x21, 0x25};
      if (std::find(constants.begin(), constants.end(), id) == constants.end()) return true;
      text += static_cast<char>(id);
      for (const std::byte byte : value) text += static_cast<char>(byte);
      return true;
    });
    return std::hash<std::string>()(text);
  }

  std::map<std::uint32_t, std::size_t> said_{};  ///< by entity
};

}  // namespace articula::ros2::dds

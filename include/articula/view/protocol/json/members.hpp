// SPDX-License-Identifier: Apache-2.0
/// @file The members that an object from a client may have, their check and their JSON schema.
#pragma once

#include "articula/view/protocol/json/json.hpp"

#include <span>
#include <string>
#include <string_view>

namespace articula::view {

/// The kinds of values in objects from clients.
enum class Kind : unsigned char {
  number,          ///< finite
  integer,         ///< from -2^31 to 2^31 - 1
  boolean,         ///< true or false
  text,            ///< at most 256 bytes
  number_by_name,  ///< object of numbers, as {"shoulder": 0.5}
  gain_by_name,    ///< likewise; "inf" and "-inf" are infinite
  numbers,         ///< array of numbers
  number_lists,    ///< array of arrays of numbers
  three_numbers,   ///< array of three numbers
  texts,           ///< array of texts
  object,          ///< whose members its reader checks
  objects,         ///< array of objects
  duration,        ///< seconds, or {"sec": .., "nanosec": ..}
  anything,        ///< accepted and not used
};

/// A member of an object.
struct Member {
  std::string_view name{};
  Kind kind = Kind::anything;
  bool required = false;
};

/// Checks an object: all its members are known and of their kind, and none that is required is
/// missing.
/// @param place  the text before a member's name in messages, as "signals[0]."
/// @return       empty if all is well, else what is wrong, where, and what was expected
[[nodiscard]] std::string fault_of(const Json& object, std::span<const Member> members,
                                   const std::string& place = {});

/// The JSON schema of an object with these members, for clients that show forms.
[[nodiscard]] Json schema_of(std::span<const Member> members);

}  // namespace articula::view

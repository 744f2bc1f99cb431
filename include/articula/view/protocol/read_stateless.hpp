// SPDX-License-Identifier: Apache-2.0
/// @file The parts of a client's messages, and the messages whose meaning does not depend on
/// earlier ones.
#pragma once

#include "articula/view/protocol/action.hpp"
#include "articula/view/protocol/json/json.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace articula::view {

/// The longest array of names, subscriptions and the like: a humanoid has some hundred gains.
inline constexpr std::size_t longest_list = 1024;
/// The longest name, topic or URI [bytes].
inline constexpr std::size_t longest_name = 1024;

/// A member of a message; nothing if it is not there or not an unsigned integer of 32 bits.
[[nodiscard]] std::optional<std::uint32_t> number_of(const Json& object, const char* member);
/// A member of a message; nothing if it is not there, not a text, or too long.
[[nodiscard]] std::optional<std::string> text_of(const Json& object, const char* member);
/// An array of a message; null if it is not there or too long.
[[nodiscard]] const Json* list_of(const Json& message, const char* member);
/// What was expected of a message and is not there.
[[nodiscard]] Complaint expected(const std::string& op, const std::string& what);

/// Takes an unsigned integer from the front of some bytes, the lowest byte first.
/// @return nothing, and takes nothing, if they are too few
[[nodiscard]] std::optional<std::uint32_t> take_number(std::string_view& bytes);

/// A message of text, but for those that subscribe and advertise.
[[nodiscard]] Action read_stateless(const std::string& op, const Json& message);
/// The bytes of a service call, behind their code.
[[nodiscard]] Action read_service_call(std::string_view bytes);

}  // namespace articula::view

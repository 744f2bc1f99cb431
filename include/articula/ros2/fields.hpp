// SPDX-License-Identifier: Apache-2.0
/// @file The fields of a message struct, by type, name and value.
#pragma once

#include "articula/ros2/layout.hpp"

#include <array>
#include <concepts>
#include <cstddef>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

namespace articula::ros2 {

/// The names of a message's fields, in the order of its members.
template <std::size_t count>
using FieldNames = std::array<std::string_view, count>;

/// A ROS message: an aggregate with the name of its type, as "std_msgs/msg/Header", and the names
/// of its fields.
template <class M>
concept Message = std::is_aggregate_v<M> && requires {
  { M::ros_type.view() } -> std::convertible_to<std::string_view>;
  std::string_view(M::ros_fields[0]);
};

/// The name of a type: package, kind and name, as "std_msgs/msg/Header".
using TypeName = InlineText<95>;

/// Two texts as one name. Real-time: yes.
constexpr TypeName joined(std::string_view first, std::string_view second) {
  std::array<char, TypeName::capacity> text{};
  std::size_t size = 0;
  for (const std::string_view part : {first, second}) {
    for (const char c : part) text.at(size++) = c;
  }
  return std::string_view(text.data(), size);
}

/// References to the members of a message, in their order. Real-time: yes.
/// @param message  an aggregate with at most 16 members
template <class M>
constexpr auto members(M& message) noexcept {
  constexpr std::size_t count = std::remove_const_t<M>::ros_fields.size();
  static_assert(count <= 16, "members() lists at most 16 members");
  // clang-format off
  if constexpr (count == 0) { return std::tie(); }
  else if constexpr (count == 1) { auto& [a] = message; return std::tie(a); }
  else if constexpr (count == 2) { auto& [a, b] = message; return std::tie(a, b); }
  else if constexpr (count == 3) { auto& [a, b, c] = message; return std::tie(a, b, c); }
  else if constexpr (count == 4) { auto& [a, b, c, d] = message; return std::tie(a, b, c, d); }
  else if constexpr (count == 5) { auto& [a, b, c, d, e] = message; return std::tie(a, b, c, d, e); }
  else if constexpr (count == 6) { auto& [a, b, c, d, e, f] = message; return std::tie(a, b, c, d, e, f); }
  else if constexpr (count == 7) { auto& [a, b, c, d, e, f, g] = message; return std::tie(a, b, c, d, e, f, g); }
  else if constexpr (count == 8) { auto& [a, b, c, d, e, f, g, h] = message; return std::tie(a, b, c, d, e, f, g, h); }
  else if constexpr (count == 9) { auto& [a, b, c, d, e, f, g, h, i] = message; return std::tie(a, b, c, d, e, f, g, h, i); }
  else if constexpr (count == 10) { auto& [a, b, c, d, e, f, g, h, i, j] = message; return std::tie(a, b, c, d, e, f, g, h, i, j); }
  else if constexpr (count == 11) { auto& [a, b, c, d, e, f, g, h, i, j, k] = message; return std::tie(a, b, c, d, e, f, g, h, i, j, k); }
  else if constexpr (count == 12) { auto& [a, b, c, d, e, f, g, h, i, j, k, l] = message; return std::tie(a, b, c, d, e, f, g, h, i, j, k, l); }
  else if constexpr (count == 13) { auto& [a, b, c, d, e, f, g, h, i, j, k, l, m] = message; return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m); }
  else if constexpr (count == 14) { auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n] = message; return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n); }
  else if constexpr (count == 15) { auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o] = message; return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o); }
  else { auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p] = message; return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p); }
  // clang-format on
}

/// A type as a value.
template <class T>
struct TypeOf {
  using Type = T;
};

/// Calls function(name, TypeOf<T>) for each field that the message has in its distribution.
template <Message M, class Function>
constexpr void for_each_field_type(Function&& function) {
  using Members = decltype(members(std::declval<M&>()));
  [&]<std::size_t... i>(std::index_sequence<i...>) {
    [[maybe_unused]] const auto visit = [&]<class T>(std::string_view name, TypeOf<T> type) {
      if constexpr (!std::is_same_v<T, Absent>) function(name, type);
    };
    (visit(M::ros_fields[i], TypeOf<std::remove_cvref_t<std::tuple_element_t<i, Members>>>()), ...);
  }(std::make_index_sequence<M::ros_fields.size()>());
}

/// The number of fields that the message has in its distribution.
template <Message M>
constexpr std::size_t field_count() {
  std::size_t count = 0;
  for_each_field_type<M>([&](std::string_view, auto) { ++count; });
  return count;
}

/// Calls function(name, value) for each field that the message has in its distribution, until one
/// call returns false. Real-time: yes, if the function is.
/// @return whether all calls returned true
template <class M, class Function>
  requires Message<std::remove_const_t<M>>
constexpr bool for_each_field(M& message, Function&& function) {
  [[maybe_unused]] const auto all = members(message);
  return [&]<std::size_t... i>(std::index_sequence<i...>) {
    [[maybe_unused]] const auto visit = [&]<class T>(std::string_view name, T& value) {
      if constexpr (std::is_same_v<std::remove_const_t<T>, Absent>) {
        return true;
      } else {
        return static_cast<bool>(function(name, value));
      }
    };
    return (visit(std::remove_const_t<M>::ros_fields[i], std::get<i>(all)) && ...);
  }(std::make_index_sequence<std::remove_const_t<M>::ros_fields.size()>());
}

}  // namespace articula::ros2

// SPDX-License-Identifier: Apache-2.0
/// @file The names of C++ types as fields of ROS messages.
#pragma once

#include "articula/ros2/fields.hpp"

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace articula::ros2 {

/// Whether a field is one value, or how many.
enum class Multiplicity : std::uint8_t { one, array, bounded_sequence, sequence };

/// The element of a field and its multiplicity.
template <class T>
struct FieldShape {
  using Element = T;
  static constexpr Multiplicity multiplicity = Multiplicity::one;
  static constexpr std::size_t capacity = 0;  ///< of an array or a bounded sequence
};
template <class T, std::size_t n>
struct FieldShape<std::array<T, n>> {
  using Element = T;
  static constexpr Multiplicity multiplicity = Multiplicity::array;
  static constexpr std::size_t capacity = n;
};
template <class T, std::size_t n>
struct FieldShape<BoundedSequence<T, n>> {
  using Element = T;
  static constexpr Multiplicity multiplicity = Multiplicity::bounded_sequence;
  static constexpr std::size_t capacity = n;
};
template <class T>
struct FieldShape<std::vector<T>> {
  using Element = T;
  static constexpr Multiplicity multiplicity = Multiplicity::sequence;
  static constexpr std::size_t capacity = 0;
};
template <class T, std::size_t n>
struct FieldShape<InlineSequence<T, n>> : FieldShape<std::vector<T>> {};

/// The most characters of a text whose ROS type has a bound, otherwise 0.
template <class T>
inline constexpr std::size_t text_bound = 0;
template <std::size_t n>
inline constexpr std::size_t text_bound<BoundedText<n>> = n;

/// A string of a message.
template <class T>
concept MessageText = std::convertible_to<const T&, std::string_view> && !Message<T>;

/// A number, bool or byte of a message.
template <class T>
concept MessageNumber = std::is_arithmetic_v<T> || std::is_same_v<T, std::byte>;

/// How .msg files and type descriptions call a type without multiplicity.
struct ElementName {
  std::string_view text;    ///< in .msg files
  std::uint8_t identifier;  ///< in type descriptions
};

/// The name of an element that is not a message. Real-time: yes.
template <class T>
constexpr ElementName element_name() {
  if constexpr (MessageText<T>) {
    return {"string", static_cast<std::uint8_t>(text_bound<T> == 0 ? 17 : 21)};
  } else if constexpr (std::is_same_v<T, bool>) {
    return {"bool", 15};
  } else if constexpr (std::is_same_v<T, std::byte>) {
    return {"byte", 16};
  } else if constexpr (std::is_same_v<T, std::int8_t>) {
    return {"int8", 2};
  } else if constexpr (std::is_same_v<T, std::uint8_t>) {
    return {"uint8", 3};
  } else if constexpr (std::is_same_v<T, std::int16_t>) {
    return {"int16", 4};
  } else if constexpr (std::is_same_v<T, std::uint16_t>) {
    return {"uint16", 5};
  } else if constexpr (std::is_same_v<T, std::int32_t>) {
    return {"int32", 6};
  } else if constexpr (std::is_same_v<T, std::uint32_t>) {
    return {"uint32", 7};
  } else if constexpr (std::is_same_v<T, std::int64_t>) {
    return {"int64", 8};
  } else if constexpr (std::is_same_v<T, std::uint64_t>) {
    return {"uint64", 9};
  } else if constexpr (std::is_same_v<T, float>) {
    return {"float32", 10};
  } else {
    static_assert(std::is_same_v<T, double>, "ROS messages have no field of this type");
    return {"float64", 11};
  }
}

}  // namespace articula::ros2

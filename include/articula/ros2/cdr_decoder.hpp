// SPDX-License-Identifier: Apache-2.0
/// @file Bytes to messages.
#pragma once

#include "articula/ros2/cdr_error.hpp"
#include "articula/ros2/field_type.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

namespace articula::ros2 {

namespace detail {

/// The bytes that every value of the type has at least, without padding.
template <class T>
constexpr std::size_t least_size() {
  if constexpr (MessageNumber<T>) {
    return sizeof(T);
  } else if constexpr (Message<T>) {
    std::size_t size = 0;
    for_each_field_type<T>(
        [&]<class Field>(std::string_view, TypeOf<Field>) { size += least_size<Field>(); });
    return size == 0 ? 1 : size;
  } else if constexpr (FieldShape<T>::multiplicity == Multiplicity::array) {
    return FieldShape<T>::capacity * least_size<typename FieldShape<T>::Element>();
  } else {
    return sizeof(std::uint32_t);
  }
}

/// Reads values from CDR. See `CdrEncoder`.
class CdrDecoder {
 public:
  explicit CdrDecoder(std::span<const std::byte> bytes) noexcept : bytes_(bytes) {}

  /// Reads the header that names the encoding. The options in its last two bytes are ignored.
  bool take_header() noexcept {
    if (bytes_.size() < 4) return fail(CdrError::no_room);
    if (bytes_[0] != std::byte{0} || bytes_[1] > std::byte{1}) {
      return fail(CdrError::unknown_header);
    }
    order_ = bytes_[1] == std::byte{1} ? std::endian::little : std::endian::big;
    bytes_ = bytes_.subspan(4);
    return true;
  }

  template <class T>
  bool take(T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      std::uint8_t byte = 0;
      if (!take_number(byte)) return false;
      if (byte > 1) return fail(CdrError::bad_bool);
      value = byte == 1;
      return true;
    } else if constexpr (MessageNumber<T>) {
      return take_number(value);
    } else if constexpr (MessageText<T>) {
      return take_text(value);
    } else if constexpr (Message<T>) {
      if constexpr (field_count<T>() == 0) {
        std::uint8_t dummy = 0;
        return take_number(dummy);
      } else {
        return for_each_field(value,
                              [this](std::string_view, auto& field) { return this->take(field); });
      }
    } else {
      return take_items(value);
    }
  }

  /// Checks that the message ends here. Senders fill payloads up to a multiple of four bytes.
  bool take_end() noexcept { return bytes_.size() - read_ < 4 || fail(CdrError::surplus); }

  [[nodiscard]] CdrError error() const noexcept { return error_; }

 private:
  bool fail(CdrError error) noexcept {
    error_ = error;
    return false;
  }

  [[nodiscard]] std::size_t left() const noexcept { return bytes_.size() - read_; }

  template <class T>
  bool take_number(T& value) noexcept {
    const std::size_t padding = (sizeof(T) - read_ % sizeof(T)) % sizeof(T);
    if (left() < padding + sizeof(T)) return fail(CdrError::no_room);
    std::array<std::byte, sizeof(T)> bytes{};
    std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(read_ + padding), sizeof(T),
                bytes.begin());
    if (order_ != std::endian::native) std::reverse(bytes.begin(), bytes.end());
    value = std::bit_cast<T>(bytes);
    read_ += padding + sizeof(T);
    return true;
  }

  template <class T>
  bool take_text(T& text) {
    std::uint32_t size = 0;
    if (!take_number(size)) return false;
    if (size > left()) return fail(CdrError::no_room);
    std::string_view characters;
    if (size > 0) {  // some senders write an empty text without its NUL
      const auto* first = reinterpret_cast<const char*>(bytes_.data() + read_);  // NOLINT: bytes
      characters = {first, size - 1};
      if (first[size - 1] != '\0' || characters.find('\0') != std::string_view::npos) {
        return fail(CdrError::bad_text);
      }
    }
    read_ += size;
    if constexpr (requires { T::capacity; }) {
      if (characters.size() > T::capacity) return fail(CdrError::long_sequence);
    }
    text.assign(characters);
    return true;
  }

  template <class T>
  bool take_items(T& items) {
    using Element = typename FieldShape<T>::Element;
    if constexpr (FieldShape<T>::multiplicity != Multiplicity::array) {
      std::uint32_t size = 0;
      if (!take_number(size)) return false;
      if (size > left() / least_size<Element>()) return fail(CdrError::long_sequence);
      if constexpr (requires { T::capacity; }) {
        if (size > T::capacity) return fail(CdrError::long_sequence);
      }
      items.resize(size);
    }
    for (std::size_t i = 0; i < items.size(); ++i) {
      if constexpr (std::is_same_v<T, std::vector<bool>>) {
        bool item = false;
        if (!take(item)) return false;
        items[i] = item;
      } else if (!take(static_cast<Element&>(items[i]))) {
        return false;
      }
    }
    return true;
  }

  std::span<const std::byte> bytes_;
  std::size_t read_ = 0;  ///< of bytes_, which begin after the header
  std::endian order_ = std::endian::little;
  CdrError error_ = CdrError::none;
};

}  // namespace detail

/// Decodes a message in plain CDR (XCDR1) of either byte order, with its header of four bytes. Any
/// bytes give a message or an error. The memory that is taken is proportional to the number of
/// bytes.
/// @param bytes    from anywhere
/// @param message  filled from them; unspecified after an error
/// @return `none`, or what is wrong with the bytes
/// @throws std::bad_alloc if the layout is on the heap, and the heap is full
/// Real-time: yes with an `InlineLayout`; otherwise no (allocates).
template <Message M>
[[nodiscard]] CdrError decode(std::span<const std::byte> bytes, M& message) {
  detail::CdrDecoder decoder(bytes);
  static_cast<void>(decoder.take_header() && decoder.take(message) && decoder.take_end());
  return decoder.error();
}

}  // namespace articula::ros2

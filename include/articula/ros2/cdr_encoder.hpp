// SPDX-License-Identifier: Apache-2.0
/// @file Messages to bytes.
#pragma once

#include "articula/ros2/cdr_error.hpp"
#include "articula/ros2/field_type.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <string_view>
#include <type_traits>

namespace articula::ros2 {

/// What became of a message that was to be encoded.
struct Encoded {
  CdrError error = CdrError::none;
  std::size_t size = 0;  ///< of the bytes with their header; 0 after an error
};

namespace detail {

/// Writes values to CDR, in which every number is aligned to its own size, counted from the end of
/// the header.
class CdrEncoder {
 public:
  static constexpr std::size_t header_size = 4;

  CdrEncoder(std::span<std::byte> bytes, std::endian order) noexcept
      : bytes_(bytes), order_(order) {}

  /// Writes the header that names the encoding: plain CDR in one of two byte orders.
  bool put_header() noexcept {
    return put_bytes(std::array{std::byte{0}, std::byte(order_ == std::endian::little ? 1 : 0),
                                std::byte{0}, std::byte{0}});
  }

  template <class T>
  bool put(const T& value) noexcept {
    if constexpr (MessageNumber<T>) {
      return put_number(value);
    } else if constexpr (MessageText<T>) {
      return put_text(value);
    } else if constexpr (Message<T>) {
      if constexpr (field_count<T>() == 0) {
        return put_number(std::uint8_t{0});  // CDR has no empty structs
      } else {
        return for_each_field(
            value, [this](std::string_view, const auto& field) { return this->put(field); });
      }
    } else {
      return put_items(value);
    }
  }

  [[nodiscard]] Encoded result() const noexcept {
    return {error_, error_ == CdrError::none ? size_ : 0};
  }

 private:
  bool fail(CdrError error) noexcept {
    error_ = error;
    return false;
  }

  bool put_bytes(std::span<const std::byte> bytes) noexcept {
    if (bytes_.size() - size_ < bytes.size()) return fail(CdrError::no_room);
    std::copy(bytes.begin(), bytes.end(), bytes_.begin() + static_cast<std::ptrdiff_t>(size_));
    size_ += bytes.size();
    return true;
  }

  template <class T>
  bool put_number(T value) noexcept {
    while ((size_ - header_size) % sizeof(T) != 0) {
      if (!put_bytes(std::array{std::byte{0}})) return false;
    }
    auto bytes = std::bit_cast<std::array<std::byte, sizeof(T)>>(value);
    if (order_ != std::endian::native) std::reverse(bytes.begin(), bytes.end());
    return put_bytes(bytes);
  }

  bool put_text(std::string_view text) noexcept {
    if (text.find('\0') != std::string_view::npos) return fail(CdrError::bad_text);
    return put_size(text.size() + 1) && put_bytes(std::as_bytes(std::span(text))) &&
           put_number(std::uint8_t{0});
  }

  bool put_size(std::size_t size) noexcept {
    if (size > std::numeric_limits<std::uint32_t>::max()) return fail(CdrError::long_sequence);
    return put_number(static_cast<std::uint32_t>(size));
  }

  template <class T>
  bool put_items(const T& items) noexcept {
    if constexpr (FieldShape<T>::multiplicity != Multiplicity::array) {
      if (!put_size(items.size())) return false;
    }
    for (const typename FieldShape<T>::Element& item : items) {
      if (!put(item)) return false;
    }
    return true;
  }

  std::span<std::byte> bytes_;
  std::size_t size_ = 0;
  std::endian order_;
  CdrError error_ = CdrError::none;
};

}  // namespace detail

/// Encodes a message in plain CDR (XCDR1), with the header of four bytes, as ROS 2 sends it.
/// @param message  any message struct
/// @param bytes    room for it; unspecified after an error
/// @param order    of the bytes of a number
/// @return error `none` and the number of bytes; or no_room, bad_text, long_sequence
/// Real-time: yes.
template <Message M>
[[nodiscard]] Encoded encode(const M& message, std::span<std::byte> bytes,
                             std::endian order = std::endian::little) noexcept {
  detail::CdrEncoder encoder(bytes, order);
  if (encoder.put_header()) encoder.put(message);
  return encoder.result();
}

}  // namespace articula::ros2

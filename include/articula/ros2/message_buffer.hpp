// SPDX-License-Identifier: Apache-2.0
/// @file Room for the bytes of messages of any size.
#pragma once

#include "articula/ros2/cdr_encoder.hpp"
#include "articula/ros2/transport.hpp"

#include <cstddef>
#include <vector>

namespace articula::ros2 {

/// Encodes messages into memory of its own, which grows with the largest one.
class MessageBuffer {
 public:
  static constexpr std::size_t most = std::size_t{1} << 26;  ///< bytes of a message

  /// The bytes of a message, valid until the next one.
  /// @return empty if a text has a NUL in it, or the message has more than `most` bytes
  /// Real-time: no (allocates).
  template <Message M>
  [[nodiscard]] Sample encode(const M& message) {
    while (true) {
      const Encoded encoded = ros2::encode(message, bytes_);
      if (encoded.error == CdrError::none) return Sample(bytes_).first(encoded.size);
      if (encoded.error != CdrError::no_room || bytes_.size() >= most) return {};
      bytes_.resize(2 * bytes_.size());
    }
  }

 private:
  std::vector<std::byte> bytes_ = std::vector<std::byte>(512);
};

}  // namespace articula::ros2

// SPDX-License-Identifier: Apache-2.0
/// @file The frames of one cycle's output, without heap memory.
#pragma once

#include "articula/hardware/can/can_frame.hpp"

#include <array>
#include <cstddef>

namespace articula {

/// Frames in the order of their sending, without heap memory.
class CanBatch {
 public:
  static constexpr std::size_t capacity = 64;  ///< the most frames

  /// Adds a frame at the end. Real-time: yes.
  /// @return false if the batch is full; the frame is not added then
  constexpr bool push_back(const CanFrame& frame) noexcept {
    if (size_ == capacity) return false;
    frames_[size_++] = frame;
    return true;
  }
  /// The last frame. The batch must not be empty. Real-time: yes.
  [[nodiscard]] constexpr CanFrame& back() noexcept { return frames_[size_ - 1]; }
  constexpr void clear() noexcept { size_ = 0; }

  [[nodiscard]] constexpr bool empty() const noexcept { return size_ == 0; }
  [[nodiscard]] constexpr std::size_t size() const noexcept { return size_; }
  [[nodiscard]] constexpr const CanFrame& operator[](std::size_t i) const noexcept {
    return frames_[i];
  }
  [[nodiscard]] constexpr const CanFrame* begin() const noexcept { return frames_.data(); }
  [[nodiscard]] constexpr const CanFrame* end() const noexcept { return frames_.data() + size_; }

 private:
  std::array<CanFrame, capacity> frames_{};
  std::size_t size_ = 0;
};

}  // namespace articula

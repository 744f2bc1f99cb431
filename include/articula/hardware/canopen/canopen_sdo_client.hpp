// SPDX-License-Identifier: Apache-2.0
/// @file The client of a CANopen node's object dictionary: one request at a time.
#pragma once

#include "articula/hardware/can/can_batch.hpp"
#include "articula/hardware/canopen/canopen.hpp"

#include <chrono>
#include <cstdint>

namespace articula::canopen {

/// The client of one node's objects: sends a request and recognizes its answer. The caller repeats
/// a request without an answer after 100 ms. That is longer than a frame waits on a bus that can
/// run a loop. A node that is slower answers a repeated request twice. The later answers do not
/// count for the next request to the same object. All functions are real-time.
class SdoClient {
 public:
  static constexpr std::chrono::milliseconds patience{100};  ///< for an answer

  /// @param node  1 .. 127
  explicit constexpr SdoClient(std::uint8_t node = 0) noexcept : node_(node) {}

  /// Cancels the request.
  constexpr void restart() noexcept {
    waiting_ = false;
    repeats_ = 0;
  }

  /// Whether a request has no answer yet.
  [[nodiscard]] constexpr bool waiting() const noexcept { return waiting_; }
  /// Whether a request has had no answer for 100 ms.
  [[nodiscard]] constexpr bool overdue(std::chrono::nanoseconds now) const noexcept {
    return waiting_ && now - sent_ >= patience;
  }
  /// The last request.
  [[nodiscard]] constexpr const Sdo& request() const noexcept { return request_; }

  /// Sends a request, which replaces the one before.
  /// @param now    time of any monotonic clock
  /// @param batch  receives the frame
  constexpr void send(const Sdo& request, std::chrono::nanoseconds now, CanBatch& batch) noexcept {
    const bool same_object = request.address == request_.address;
    if (!same_object) late_ = 0;
    repeats_ = same_object && waiting_ ? repeats_ + 1 : 0;
    request_ = request;
    waiting_ = batch.push_back(encode_request(request, node_));
    sent_ = now;
  }

  /// Processes an answer of the node.
  /// @return true if it answers the request
  [[nodiscard]] constexpr bool take(const Sdo& answer) noexcept {
    const bool matches = answer.address == request_.address &&
                         (answer.kind == request_.kind || answer.kind == SdoKind::abort);
    if (!waiting_ || !matches) return false;
    if (late_ > 0) {
      --late_;
      return false;
    }
    waiting_ = false;
    late_ = repeats_;
    return true;
  }

 private:
  std::uint8_t node_;
  bool waiting_ = false;
  int repeats_ = 0;  ///< of the request
  int late_ = 0;     ///< answers to an earlier request for the same object that may still come
  Sdo request_{};
  std::chrono::nanoseconds sent_{};
};

}  // namespace articula::canopen

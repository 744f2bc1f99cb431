// SPDX-License-Identifier: Apache-2.0
/// @file One request at a time to the object dictionary of a CANopen node.
#pragma once

#include "articula/hardware/can/can_batch.hpp"
#include "articula/hardware/canopen/canopen.hpp"

#include <chrono>
#include <cstdint>

namespace articula::canopen {

/// The host's side of the access to one node's objects: sends a request, repeats it while the node
/// does not answer, and knows the answer when it comes. A request is repeated after 100 ms, which
/// is longer than a frame waits on any bus that can run a loop.
class SdoClient {
 public:
  static constexpr std::chrono::milliseconds patience{100};  ///< for an answer

  /// @param node  1 .. 127
  explicit constexpr SdoClient(std::uint8_t node) noexcept : node_(node) {}

  /// Forgets the request. Real-time: yes.
  constexpr void restart() noexcept { waiting_ = false; }

  /// True while a request has no answer. Real-time: yes.
  [[nodiscard]] constexpr bool waiting() const noexcept { return waiting_; }
  /// True if the request was sent and has had no answer for 100 ms. Real-time: yes.
  [[nodiscard]] constexpr bool overdue(std::chrono::nanoseconds now) const noexcept {
    return waiting_ && now - asked_ >= patience;
  }
  /// The request that waits for its answer, or the last one that did. Real-time: yes.
  [[nodiscard]] constexpr const Sdo& request() const noexcept { return request_; }

  /// Sends a request, which takes the place of the one before.
  /// @param request  to read or to write an object
  /// @param now      time since any beginning
  /// @param batch    receives the frame
  /// Real-time: yes.
  constexpr void ask(const Sdo& request, std::chrono::nanoseconds now, CanBatch& batch) noexcept {
    request_ = request;
    waiting_ = batch.push_back(encode_request(request, node_));
    asked_ = now;
  }

  /// Takes in an answer of the node.
  /// @return true if it answers the request, which is over then
  /// Real-time: yes.
  [[nodiscard]] constexpr bool take(const Sdo& answer) noexcept {
    const bool matches = answer.address == request_.address &&
                         (answer.kind == request_.kind || answer.kind == SdoKind::abort);
    if (!waiting_ || !matches) return false;
    waiting_ = false;
    return true;
  }

 private:
  std::uint8_t node_;
  bool waiting_ = false;
  Sdo request_{};
  std::chrono::nanoseconds asked_{};
};

}  // namespace articula::canopen

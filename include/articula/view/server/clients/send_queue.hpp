// SPDX-License-Identifier: Apache-2.0
/// @file The queue of frames that wait to be sent to one client.
#pragma once

#include "articula/view/protocol/messages/frame.hpp"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>

namespace articula::view {

/// Frames for one client, in two lists. Answers are kept until they are sent; too many of them are
/// an overflow, which costs the client its connection. Of streams, the newest frames are kept and
/// the oldest are dropped. So a client that reads slowly gets new data, and costs bounded memory.
class SendQueue {
 public:
  static constexpr std::size_t stream_limit = 64;    ///< frames; a third of a second of all topics
  static constexpr std::size_t answer_limit = 1024;  ///< frames

  /// @param bytes  most of each list; a single frame may be longer
  explicit SendQueue(std::size_t bytes) : limit_(bytes) {}

  /// Adds a frame that is never dropped.
  void add_answer(Frame frame) {
    overflowed_ = overflowed_ || answers_.frames.size() >= answer_limit ||
                  (!answers_.frames.empty() && answers_.bytes + frame.size() > limit_);
    if (!overflowed_) answers_.add(std::move(frame));
  }

  /// Adds a frame in place of the oldest ones if there are too many.
  void add_stream(Frame frame) {
    while (!streams_.frames.empty() &&
           (streams_.frames.size() >= stream_limit || streams_.bytes + frame.size() > limit_)) {
      (void)streams_.take();
      ++dropped_;
    }
    streams_.add(std::move(frame));
  }

  /// The frame to be sent next: answers first.
  [[nodiscard]] std::optional<Frame> take() {
    if (!answers_.frames.empty()) return answers_.take();
    if (!streams_.frames.empty()) return streams_.take();
    return std::nullopt;
  }

  [[nodiscard]] bool has_answers() const noexcept { return !answers_.frames.empty(); }
  /// Whether an answer was lost: the client is to be disconnected.
  [[nodiscard]] bool overflowed() const noexcept { return overflowed_; }
  /// How many frames of streams were dropped since the last call.
  [[nodiscard]] std::uint64_t take_dropped() noexcept { return std::exchange(dropped_, 0); }

 private:
  struct List {
    std::deque<Frame> frames{};
    std::size_t bytes = 0;

    void add(Frame frame) {
      bytes += frame.size();
      frames.push_back(std::move(frame));
    }
    Frame take() {
      Frame frame = std::move(frames.front());
      frames.pop_front();
      bytes -= frame.size();
      return frame;
    }
  };

  std::size_t limit_;
  List answers_{};
  List streams_{};
  std::uint64_t dropped_ = 0;
  bool overflowed_ = false;
};

}  // namespace articula::view

// SPDX-License-Identifier: Apache-2.0
/// @file Messages from threads of Fast DDS, which wait for `poll`.
#pragma once

#include <fastdds/rtps/common/SampleIdentity.h>

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <set>
#include <vector>

namespace articula::ros2::dds {

/// A message, and what Fast DDS says beside it.
struct Arrival {
  std::vector<std::byte> bytes{};
  eprosima::fastrtps::rtps::SampleIdentity identity{};  ///< its writer and number
  eprosima::fastrtps::rtps::SampleIdentity related{};   ///< unknown, if its writer states none
};

/// Queues of messages, one for each reader. Threads of Fast DDS put; one thread takes.
class Inbox {
 public:
  using Clock = std::chrono::steady_clock;

  /// The messages of one reader. The oldest ones are dropped at the limits.
  class Queue {
   public:
    Queue(std::size_t most, std::size_t most_bytes, std::function<void(Arrival&)> deliver)
        : most_(most), most_bytes_(most_bytes), deliver_(std::move(deliver)) {}

   private:
    friend class Inbox;
    std::deque<Arrival> arrivals_{};
    std::size_t bytes_ = 0;
    std::size_t most_;
    std::size_t most_bytes_;
    std::function<void(Arrival&)> deliver_;
  };

  void put(Queue& queue, Arrival arrival);
  /// Ends a wait: a peer came or left.
  void wake();

  /// Waits for a message or a call of `wake`.
  void wait_until(Clock::time_point time);
  /// Delivers what was there when the call began, from each queue in turn.
  /// @return whether there was anything
  bool deliver();

 private:
  std::optional<std::pair<Queue*, Arrival>> take();

  std::mutex mutex_{};
  std::condition_variable changed_{};
  std::deque<Queue*> waiting_{};  ///< queues that are not empty
  std::size_t count_ = 0;         ///< of messages in them
  bool woken_ = false;
};

/// The peers' readers or writers that match one here.
class Matched {
 public:
  using Guid = eprosima::fastrtps::rtps::GUID_t;
  using Prefix = eprosima::fastrtps::rtps::GuidPrefix_t;

  void set(const Guid& peer, bool matched);
  [[nodiscard]] bool contains(const Guid& peer) const;
  [[nodiscard]] std::size_t count() const;
  /// Those of one participant.
  [[nodiscard]] std::size_t count(const Prefix& participant) const;

 private:
  mutable std::mutex mutex_{};
  std::set<Guid> peers_{};
};

}  // namespace articula::ros2::dds

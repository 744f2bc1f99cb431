// SPDX-License-Identifier: Apache-2.0
/// @file Memory of one reader's or writer's messages, with limits that no peer can exceed.
#pragma once

#include <fastdds/rtps/common/CacheChange.h>
#include <fastdds/rtps/history/IPayloadPool.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>

namespace articula::ros2::dds {

/// Refuses messages that are too large before it takes memory for them. A peer states the size of a
/// message in the first of its fragments.
class PayloadPool final : public eprosima::fastrtps::rtps::IPayloadPool {
 public:
  /// @param largest    bytes of a message
  /// @param total      bytes of all messages at a time; of whole messages that have come, a reader
  ///                   bounds those that stay
  /// @param make_room  is called if there is no room for some bytes
  PayloadPool(
      std::size_t largest, std::size_t total,
      std::function<void(std::size_t bytes)> make_room = [](std::size_t) {})
      : largest_(largest), total_(total), make_room_(std::move(make_room)) {}

  /// All messages now [bytes].
  [[nodiscard]] std::size_t used() const { return used_; }
  [[nodiscard]] bool has_room(std::size_t bytes) const { return used_ + bytes <= total_; }

  /// Takes memory for a message in fragments, or one that is written.
  bool get_payload(std::uint32_t size, eprosima::fastrtps::rtps::CacheChange_t& change) override;
  /// Takes memory for a whole message that has come.
  bool get_payload(eprosima::fastrtps::rtps::SerializedPayload_t& data,
                   eprosima::fastrtps::rtps::IPayloadPool*& owner,
                   eprosima::fastrtps::rtps::CacheChange_t& change) override;
  bool release_payload(eprosima::fastrtps::rtps::CacheChange_t& change) override;

 private:
  void take(std::uint32_t size, eprosima::fastrtps::rtps::CacheChange_t& change);

  std::size_t largest_;
  std::size_t total_;
  std::function<void(std::size_t)> make_room_;
  std::atomic<std::size_t> used_{0};
};

}  // namespace articula::ros2::dds

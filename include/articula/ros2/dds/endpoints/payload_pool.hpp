// SPDX-License-Identifier: Apache-2.0
/// @file Memory of one reader's or writer's messages, with limits that no peer can exceed.
#pragma once

#include <fastdds/rtps/common/CacheChange.h>
#include <fastdds/rtps/history/IPayloadPool.h>

#include <atomic>
#include <cstddef>
#include <cstdint>

namespace articula::ros2::dds {

/// Refuses messages that are too large before it takes memory for them. A peer states the size of a
/// message in the first of its fragments.
class PayloadPool final : public eprosima::fastrtps::rtps::IPayloadPool {
 public:
  /// @param largest  bytes of a message
  /// @param total    bytes of all messages at a time
  PayloadPool(std::size_t largest, std::size_t total) : largest_(largest), total_(total) {}

  bool get_payload(std::uint32_t size, eprosima::fastrtps::rtps::CacheChange_t& change) override;
  bool get_payload(eprosima::fastrtps::rtps::SerializedPayload_t& data,
                   eprosima::fastrtps::rtps::IPayloadPool*& owner,
                   eprosima::fastrtps::rtps::CacheChange_t& change) override;
  bool release_payload(eprosima::fastrtps::rtps::CacheChange_t& change) override;

 private:
  std::size_t largest_;
  std::size_t total_;
  std::atomic<std::size_t> used_{0};
};

}  // namespace articula::ros2::dds

// SPDX-License-Identifier: Apache-2.0
/// @file The messages of one reader that wait for others or for their fragments.
#pragma once

#include "articula/ros2/dds/endpoints/payload_pool.hpp"

#include <fastdds/rtps/history/ReaderHistory.h>

#include <cstddef>
#include <cstdint>
#include <memory>

namespace articula::ros2::dds {

/// The history of a reader whose messages leave it as soon as they have come. What stays waits for
/// messages before it, or for its fragments. All writers share its memory.
///
/// The next message of a reliable writer always finds room. Otherwise a full history would never
/// see the message that others wait for, and the reader would be deaf. So messages behind a missing
/// one get half of the memory: their writer sends the rest again. If fragments fill all of it, the
/// participant that holds most of it loses its oldest message, which comes again.
class WaitingMessages final : public eprosima::fastrtps::rtps::ReaderHistory {
 public:
  /// @param largest  bytes of a message; a larger one is passed over for good
  explicit WaitingMessages(std::size_t largest);

  /// Where the messages have their memory.
  [[nodiscard]] const std::shared_ptr<PayloadPool>& pool() const { return pool_; }

  /// Whether a message may come, asked before each message and each fragment.
  /// @param missing_before  number of messages before it that have not come
  /// @param[out] never      whether it is refused for good
  bool can_change_be_added_nts(const eprosima::fastrtps::rtps::GUID_t& writer, std::uint32_t size,
                               std::size_t missing_before, bool& never) const override;

  /// Adds a message, in the order of its writer's numbers. Fast DDS 2.9.1 itself goes by times of
  /// several writers, and then misses some.
  bool received_change(eprosima::fastrtps::rtps::CacheChange_t* change,
                       std::size_t missing_before) override;
  using ReaderHistory::received_change;

 private:
  void make_room(std::size_t bytes);

  std::size_t largest_;
  std::shared_ptr<PayloadPool> pool_;
};

}  // namespace articula::ros2::dds

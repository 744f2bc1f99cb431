// SPDX-License-Identifier: Apache-2.0
#include "articula/ros2/dds/endpoints/payload_pool.hpp"

namespace articula::ros2::dds {

namespace rtps = eprosima::fastrtps::rtps;

namespace {

// Until all fragments have come, Fast DDS keeps a list of four bytes an entry in the message's own
// memory. Its last entry may begin at the last byte, rounded up to a multiple of four.
constexpr std::uint32_t room_for_list = 8;

}  // namespace

bool PayloadPool::get_payload(std::uint32_t size, rtps::CacheChange_t& change) {
  if (size > largest_) return false;
  if (!has_room(size)) make_room_(size);
  if (!has_room(size)) return false;
  take(size, change);
  return true;
}

bool PayloadPool::get_payload(rtps::SerializedPayload_t& data, rtps::IPayloadPool*& /*owner*/,
                              rtps::CacheChange_t& change) {
  if (data.length > largest_) return false;
  take(data.length, change);
  return change.serializedPayload.copy(&data);
}

void PayloadPool::take(std::uint32_t size, rtps::CacheChange_t& change) {
  change.serializedPayload.reserve(size + room_for_list);
  change.serializedPayload.max_size = size;  // a longer message must not take its place
  used_ += size;
  change.payload_owner(this);
}

bool PayloadPool::release_payload(rtps::CacheChange_t& change) {
  used_ -= change.serializedPayload.max_size;
  change.serializedPayload.empty();
  change.payload_owner(nullptr);
  return true;
}

}  // namespace articula::ros2::dds

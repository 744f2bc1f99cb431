// SPDX-License-Identifier: Apache-2.0
#include "articula/ros2/dds/endpoints/waiting_messages.hpp"

#include <algorithm>
#include <map>

namespace articula::ros2::dds {

namespace rtps = eprosima::fastrtps::rtps;

namespace {

// Behind a missing message. Fast DDS goes through them for each message that comes.
constexpr std::size_t most_behind = 1024;

// Half of the memory: some of the largest messages, and many small ones.
constexpr std::size_t half_of_memory(std::size_t largest) {
  constexpr std::size_t messages = 4, more = std::size_t{1} << 18;
  return messages * largest + more;
}

rtps::HistoryAttributes attributes(std::size_t largest) {
  return {rtps::DYNAMIC_RESERVE_MEMORY_MODE, static_cast<std::uint32_t>(largest), 0, 0};
}

}  // namespace

WaitingMessages::WaitingMessages(std::size_t largest)
    : ReaderHistory(attributes(largest)),
      largest_(largest),
      pool_(std::make_shared<PayloadPool>(largest, 2 * half_of_memory(largest),
                                          [this](std::size_t bytes) { make_room(bytes); })) {}

bool WaitingMessages::can_change_be_added_nts(const rtps::GUID_t& /*writer*/, std::uint32_t size,
                                              std::size_t missing_before, bool& never) const {
  // Fast DDS notes each number that it never accepts: of the next message alone.
  never = size > largest_ && missing_before == 0;
  if (size > largest_) return false;
  if (missing_before == 0) return true;
  return m_changes.size() < most_behind && pool_->used() + size <= half_of_memory(largest_);
}

bool WaitingMessages::received_change(rtps::CacheChange_t* change, std::size_t /*missing_before*/) {
  const auto is_before = [](const rtps::CacheChange_t* a, const rtps::CacheChange_t* b) {
    if (a->writerGUID == b->writerGUID) return a->sequenceNumber < b->sequenceNumber;
    return a->writerGUID < b->writerGUID;
  };
  auto place = std::lower_bound(m_changes.begin(), m_changes.end(), change, is_before);
  if (place != m_changes.end() && !is_before(change, *place)) {
    place = History::remove_change_nts(place);  // fragments of what has come whole
  }
  m_changes.insert(place, change);
  return true;
}

void WaitingMessages::make_room(std::size_t bytes) {
  while (!pool_->has_room(bytes)) {
    std::map<rtps::GuidPrefix_t, std::size_t> held;  // by each participant, in fragments
    for (rtps::CacheChange_t* const change : m_changes) {
      if (change->is_fully_assembled()) continue;  // it does not come again
      held[change->writerGUID.guidPrefix] += change->serializedPayload.max_size;
    }
    if (held.empty()) return;
    const auto most = std::ranges::max_element(
        held, {}, [](const auto& participant) { return participant.second; });
    auto oldest = m_changes.end();
    for (auto change = m_changes.begin(); change != m_changes.end(); ++change) {
      if ((*change)->is_fully_assembled()) continue;
      if ((*change)->writerGUID.guidPrefix != most->first) continue;
      if (oldest == m_changes.end() ||
          (*change)->reader_info.receptionTimestamp < (*oldest)->reader_info.receptionTimestamp) {
        oldest = change;
      }
    }
    History::remove_change_nts(oldest);  // so that it can come again
  }
}

}  // namespace articula::ros2::dds

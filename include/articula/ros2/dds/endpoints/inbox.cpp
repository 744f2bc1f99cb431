// SPDX-License-Identifier: Apache-2.0
#include "articula/ros2/dds/endpoints/inbox.hpp"

#include <algorithm>
#include <utility>

namespace articula::ros2::dds {

void Inbox::put(Queue& queue, Arrival arrival) {
  const std::scoped_lock lock(mutex_);
  if (queue.arrivals_.empty()) waiting_.push_back(&queue);
  queue.bytes_ += arrival.bytes.size();
  queue.arrivals_.push_back(std::move(arrival));
  ++count_;
  while (queue.arrivals_.size() > 1 &&
         (queue.arrivals_.size() > queue.most_ || queue.bytes_ > queue.most_bytes_)) {
    queue.bytes_ -= queue.arrivals_.front().bytes.size();
    queue.arrivals_.pop_front();
    --count_;
  }
  changed_.notify_one();
}

void Inbox::wake() {
  const std::scoped_lock lock(mutex_);
  woken_ = true;
  changed_.notify_one();
}

void Inbox::wait_until(Clock::time_point time) {
  std::unique_lock lock(mutex_);
  changed_.wait_until(lock, time, [this] { return woken_ || count_ > 0; });
  woken_ = false;
}

std::optional<std::pair<Inbox::Queue*, Arrival>> Inbox::take() {
  const std::scoped_lock lock(mutex_);
  if (waiting_.empty()) return {};
  Queue* const queue = waiting_.front();
  waiting_.pop_front();
  Arrival arrival = std::move(queue->arrivals_.front());
  queue->arrivals_.pop_front();
  queue->bytes_ -= arrival.bytes.size();
  --count_;
  if (!queue->arrivals_.empty()) waiting_.push_back(queue);
  return std::pair(queue, std::move(arrival));
}

bool Inbox::deliver() {
  std::size_t count = 0;
  {
    const std::scoped_lock lock(mutex_);
    count = count_;
  }
  const bool any = count > 0;
  for (; count > 0; --count) {
    auto taken = take();
    if (!taken) break;
    taken->first->deliver_(taken->second);
  }
  return any;
}

void Matched::set(const Guid& peer, bool matched) {
  const std::scoped_lock lock(mutex_);
  if (matched) {
    peers_.insert(peer);
  } else {
    peers_.erase(peer);
  }
}

bool Matched::contains(const Guid& peer) const {
  const std::scoped_lock lock(mutex_);
  return peers_.contains(peer);
}

std::size_t Matched::count() const {
  const std::scoped_lock lock(mutex_);
  return peers_.size();
}

std::size_t Matched::count(const Prefix& participant) const {
  const std::scoped_lock lock(mutex_);
  return static_cast<std::size_t>(
      std::count_if(peers_.begin(), peers_.end(),
                    [&](const Guid& peer) { return peer.guidPrefix == participant; }));
}

}  // namespace articula::ros2::dds

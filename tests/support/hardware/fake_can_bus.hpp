// SPDX-License-Identifier: Apache-2.0
/// @file A CAN bus in memory, with simulated drives at its other end and a test in between.
#pragma once

#include <articula/hardware/can/can_transport.hpp>
#include <articula/hardware/canopen/canopen.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace support {

/// A bus in memory. Time passes only where someone waits. Shared by a transport and its test.
template <class Drives>
struct FakeCanBus {
  explicit FakeCanBus(Drives the_drives) : drives(std::move(the_drives)) {}

  Drives drives;
  std::chrono::nanoseconds time{};
  articula::CanLink link = articula::CanLink::up;
  articula::CanSending sending = articula::CanSending::sent;  ///< what the next sends come to
  bool can_open = true;                                       ///< and opening brings the link up
  int opened = 0;
  std::vector<articula::CanFrame> to_drives{};  ///< all that was on the wire
  std::deque<articula::CanFrame> to_host{};     ///< not received yet
  std::chrono::nanoseconds sync_period{};     ///< of another node that sends SYNC; 0: there is none
  std::chrono::nanoseconds next_sync{};       ///< when that one is due
  articula::CanFrame sync{};                  ///< what it sends
  std::chrono::nanoseconds feedback_delay{};  ///< after which feedback arrives
  std::chrono::nanoseconds answer_delay{};    ///< after which answers to SDO requests arrive
  /// How long a cycle's output takes to get onto the bus, if it is tracked as SocketCan does.
  std::optional<std::chrono::nanoseconds> sending_time{};
  bool awaiting = false;                 ///< the sign that it has got there was not received yet
  std::chrono::nanoseconds confirmed{};  ///< when it is there
  std::chrono::nanoseconds command_delay{};  ///< after which the host's frames reach the drives
  /// What is done to each frame of the drives: false keeps it from arriving.
  std::function<bool(articula::CanFrame&)> on_feedback = [](articula::CanFrame&) { return true; };
  /// What is done to each frame of the host.
  std::function<bool(articula::CanFrame&)> on_command = [](articula::CanFrame&) { return true; };

  /// What is done where SYNC is due: false keeps the other node from sending it.
  std::function<bool()> on_sync = [] { return true; };

  [[nodiscard]] bool delays() const {
    return feedback_delay.count() > 0 || command_delay.count() > 0 || answer_delay.count() > 0;
  }
  /// A frame of the host sets out.
  void accept(articula::CanFrame frame) {
    if (!on_command(frame)) return;
    to_drives.push_back(frame);
    if (command_delay.count() == 0) return arrive(frame);
    to_drives_on_its_way_.emplace_back(time + command_delay, frame);
  }
  void deliver(const articula::CanBatch& answers) {
    for (articula::CanFrame frame : answers) {
      if (!on_feedback(frame)) continue;
      if (answer_delay.count() > 0 && is_answer(frame)) {
        answers_on_their_way_.emplace_back(time + answer_delay, frame);
      } else if (feedback_delay.count() == 0) {
        to_host.push_back(frame);
      } else {
        on_its_way_.emplace_back(time + feedback_delay, frame);
      }
    }
  }
  /// When something happens next that time has to pass for, at most `end`.
  [[nodiscard]] std::chrono::nanoseconds next_event(std::chrono::nanoseconds end) const {
    if (sync_period.count() > 0) end = std::min(end, next_sync);
    if (sync_period.count() == 0) end = std::min(end, next_period_);
    for (const auto* way : {&on_its_way_, &answers_on_their_way_, &to_drives_on_its_way_}) {
      if (!way->empty()) end = std::min(end, way->front().first);
    }
    return std::max(end, time);
  }
  /// Lets time pass on a bus on which another node sends SYNC or frames take their time. A
  /// millisecond in which nothing reaches the drives is a period without SYNC.
  void pass(std::chrono::nanoseconds duration) {
    const auto end = time + duration;
    for (;;) {
      time = next_event(end);
      while (!to_drives_on_its_way_.empty() && to_drives_on_its_way_.front().first <= time) {
        arrive(to_drives_on_its_way_.front().second);
        to_drives_on_its_way_.pop_front();
      }
      for (auto* way : {&on_its_way_, &answers_on_their_way_}) {
        while (!way->empty() && way->front().first <= time) {
          to_host.push_back(way->front().second);
          way->pop_front();
        }
      }
      if (sync_period.count() > 0 && next_sync <= time) {
        next_sync += sync_period;
        send_sync();
      } else if (sync_period.count() == 0 && next_period_ <= time) {
        next_period_ = time + std::chrono::milliseconds(1);
        if (!std::exchange(reached_, false)) silent_period();
      } else if (time >= end) {
        return;
      }
    }
  }
  void send_sync() {
    if (!on_sync()) return silent_period();
    to_host.push_back(sync);
    articula::CanBatch answers;
    drives.receive(sync, answers);
    deliver(answers);
  }
  /// A period without SYNC.
  void silent_period() {
    articula::CanBatch answers;
    drives.pass_silent_period(answers);
    deliver(answers);
  }

 private:
  void arrive(const articula::CanFrame& frame) {
    reached_ = true;
    articula::CanBatch answers;
    drives.receive(frame, answers);
    deliver(answers);
  }

  /// Of a CANopen node, to an access to an object.
  [[nodiscard]] static bool is_answer(const articula::CanFrame& frame) {
    return (frame.identifier & 0x780) == articula::canopen::sdo_answer_base;
  }

  using Way = std::deque<std::pair<std::chrono::nanoseconds, articula::CanFrame>>;
  Way on_its_way_{};
  Way answers_on_their_way_{};
  Way to_drives_on_its_way_{};
  std::chrono::nanoseconds next_period_{};
  bool reached_ = false;  ///< something has reached the drives in this millisecond
};

/// The host's end of the bus.
template <class Drives>
class FakeCanTransport {
 public:
  explicit FakeCanTransport(std::shared_ptr<FakeCanBus<Drives>> bus) : bus_(std::move(bus)) {}

  [[nodiscard]] articula::Status open(const articula::CanSubscription&) noexcept {
    ++bus_->opened;
    bus_->to_host.clear();
    if (bus_->can_open) bus_->link = articula::CanLink::up;
    return bus_->can_open ? articula::Status::ok : articula::Status::hardware_fault;
  }
  [[nodiscard]] std::size_t receive(std::span<articula::ReceivedCanFrame> frames) noexcept {
    if (bus_->time >= bus_->confirmed) bus_->awaiting = false;
    std::size_t count = 0;
    while (count < frames.size() && !bus_->to_host.empty()) {
      frames[count++] = {bus_->to_host.front(), bus_->time};
      bus_->to_host.pop_front();
    }
    return count;
  }
  [[nodiscard]] articula::CanSending send(const articula::CanBatch& batch) noexcept {
    const bool taken = bus_->sending == articula::CanSending::sent ||
                       bus_->sending == articula::CanSending::unconfirmed;
    if (!taken) return bus_->sending;
    if (bus_->awaiting) return articula::CanSending::backlog;
    if (bus_->sending_time) {
      bus_->awaiting = true;
      bus_->confirmed = bus_->time + *bus_->sending_time;
    }
    for (const articula::CanFrame& frame : batch) bus_->accept(frame);
    return bus_->sending;
  }
  void wait(std::chrono::nanoseconds time) noexcept {
    if (!bus_->to_host.empty()) return;
    if (bus_->sync_period.count() > 0 || bus_->delays()) {
      return bus_->pass(bus_->next_event(bus_->time + time) - bus_->time);
    }
    if (bus_->awaiting && bus_->confirmed - bus_->time < time) {  // the sign comes first
      bus_->time = std::max(bus_->time, bus_->confirmed);
      return;
    }
    bus_->time += time;
    bus_->silent_period();
  }
  [[nodiscard]] std::chrono::nanoseconds now() const noexcept { return bus_->time; }
  [[nodiscard]] articula::CanLink link() const noexcept { return bus_->link; }

 private:
  std::shared_ptr<FakeCanBus<Drives>> bus_;
};

}  // namespace support

// SPDX-License-Identifier: Apache-2.0
/// @file The host's side of all CiA 402 drives of an arm.
#pragma once

#include "articula/core/joint_array.hpp"
#include "articula/hardware/can/can_codec.hpp"
#include "articula/hardware/can/can_fault.hpp"
#include "articula/hardware/cia402/cia402_channel.hpp"
#include "articula/hardware/cia402/sync_history.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace articula {

/// The channels and reports of all drives, and the cycles of their bus. The cycles are enabling,
/// release and stop, and the accesses to objects that the drives share. All functions are real-time
/// and O(N).
template <int N>
struct Cia402Channels {
  /// The most accesses to objects in a cycle. A CAN interface queues ten frames by default, and
  /// commands and SYNC need room.
  static constexpr std::size_t most_accesses = N < 7 ? 8 - N : 1;

  JointArray<Cia402Channel, N> channels{};
  JointArray<DriveReport, N> reports{};
  SyncHistory syncs{};

  void restart() noexcept {
    reports.fill({});
    syncs = {};
    next_stop_ = 0;
    for (Cia402Channel& channel : channels) {
      channel.feedback.restart();
      channel.stop.restart();
      channel.set_up.restart();
    }
  }
  void begin_cycle(bool with_sync) noexcept {
    syncs.begin_cycle(with_sync);
    for (DriveReport& report : reports) report.begin_cycle();
  }

  /// Appends the next requests that enable the drives.
  /// @return CanSetUp::done once all drives are enabled
  [[nodiscard]] CanSetUp enable(std::chrono::nanoseconds elapsed, CanBatch& batch) noexcept {
    bool all_enabled = true, all_known = true;
    all_follow_ = true;
    for (int j = 0; j < N; ++j) {
      Cia402Channel& channel = channels[j];
      const std::size_t before = batch.size();
      const CanSetUp progress = channel.set_up.advance(elapsed, batch);
      if (progress == CanSetUp::failed) return progress;
      Cia402FeedbackAge& age = channel.feedback.age();
      const auto& command = channel.set_up.command();
      if (command == canopen::NmtCommand::enter_pre_operational) age.end_feedback();
      if (command == canopen::NmtCommand::start && age.is_still_operational()) {
        channel.set_up.restart();  // the command to leave operation was lost
      } else if (command == canopen::NmtCommand::start) {
        age.begin_feedback(syncs);
      }
      // Each request is a mark as well.
      if (batch.size() != before) age.place_mark(channel.set_up.object(), syncs);
      all_enabled = all_enabled && progress == CanSetUp::done;
      constexpr std::uint32_t doubtful_age = 20;  // [cycles]
      const bool known = reports[j].age < doubtful_age && reports[j].enabled;
      if (!known) channel.set_up.check_again(elapsed, syncs.is_new());
      all_known = all_known && known;
      all_follow_ = all_follow_ && channel.feedback.has_followed();
    }
    if (!all_known) known_since_ = elapsed;
    all_known_ = all_known;
    return all_enabled ? CanSetUp::done : CanSetUp::in_progress;
  }
  /// Whether the feedback of all drives shows that they are enabled and follow their targets. A
  /// drive may follow after a moment, and some drives never report it: 100 ms are enough then.
  [[nodiscard]] bool all_ready(std::chrono::nanoseconds elapsed) const noexcept {
    const bool never_reported = elapsed - known_since_ >= canopen::SdoClient::patience;
    return all_known_ && (all_follow_ || never_reported);
  }

  /// Switches the drives' watchdogs off. A drive that may still exert effort keeps its watchdog.
  /// @param elapsed  since the release began; zero in the first call
  [[nodiscard]] CanSetUp release(std::chrono::nanoseconds elapsed, CanBatch& batch) noexcept {
    bool all_done = true;
    for (Cia402Channel& channel : channels) {
      if (elapsed.count() == 0) channel.set_up.begin_release();
      if (channel.feedback.powered()) continue;
      all_done = channel.set_up.advance(elapsed, batch) == CanSetUp::done && all_done;
    }
    return all_done ? CanSetUp::done : CanSetUp::in_progress;
  }

  /// The reason why the drives are not enabled. It is the first drive that has refused, else the
  /// first that is not ready, with the object of its current step.
  [[nodiscard]] CanFault set_up_fault() const noexcept {
    const auto first = [](auto condition) {
      int j = 0;
      while (j < N && !condition(j)) ++j;
      return j;
    };
    int j = first([this](int k) { return channels[k].set_up.failed(); });
    if (j == N) j = first([this](int k) { return !channels[k].set_up.ended(); });
    if (j == N) j = first([this](int k) { return !reports[k].enabled; });
    if (j == N) return {CanCause::no_activation};
    const Cia402SetUp& set_up = channels[j].set_up;
    return {set_up.lacks_watchdog() ? CanCause::no_watchdog : CanCause::no_activation, j,
            reports[j].fault, set_up.object(), set_up.abort_code()};
  }

  /// Whether all drives have reported that they are off.
  [[nodiscard]] bool all_off() const noexcept {
    return std::ranges::none_of(channels, [](const auto& c) { return c.feedback.powered(); });
  }

  /// Appends requests that tell lost feedback from late feedback.
  // Not inlined, as push_stops: they are rare, and would cost each cycle some registers.
  [[gnu::noinline]] void push_marks(CanBatch& batch) noexcept {
    access([&](Cia402Channel& channel) { return channel.push_mark(syncs, batch); });
  }
  /// Appends accesses that stop the drives, if they are due.
  void push_stops(CanBatch& batch) noexcept {
    if (syncs.is_missing() || syncs.cycle() >= next_stop_) push_due_stops(batch);
  }

  /// Notes that the bus did not take all frames of the last output.
  void cancel_output() noexcept {
    for (Cia402Channel& channel : channels) {
      channel.stop.cancel_request();
      channel.feedback.age().cancel_mark();
    }
    syncs.note_missing();
  }

 private:
  [[gnu::noinline]] void push_due_stops(CanBatch& batch) noexcept {
    next_stop_ = syncs.cycle() + Cia402Stop::patience;
    access([&](Cia402Channel& channel) {
      if (!channel.feedback.powered()) return std::size_t{0};
      return channel.stop.advance(channel.drive.node, syncs.cycle(), batch);
    });
  }
  /// Appends accesses to the objects of a few drives in turn.
  /// @param append_for  appends frames for a drive, and returns their number
  template <class Append>
  void access(Append append_for) noexcept {
    std::size_t frames = 0;
    for (int k = 0; k < N && frames < most_accesses; ++k) {
      frames += append_for(channels[next_drive_]);
      next_drive_ = (next_drive_ + 1) % N;
    }
    if (frames < most_accesses) syncs.forget_missing();
  }

  int next_drive_ = 0;                      ///< next in turn for an access
  std::uint64_t next_stop_ = 0;             ///< cycle of the next accesses of a stop
  std::chrono::nanoseconds known_since_{};  ///< all drives were enabled and had reported
  bool all_known_ = false;                  ///< all drives are
  bool all_follow_ = false;                 ///< all drives have reported that they follow
};

}  // namespace articula

// SPDX-License-Identifier: Apache-2.0
/// @file Simulated drives of an arm on a CAN interface.
#pragma once

#include "articula/hardware/can/socketcan.hpp"
#include "articula/loop/stop_flag.hpp"
#include "fault_script.hpp"
#include "protocols.hpp"

#include <linux/can/error.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <deque>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace articula::examples {

/// Options of the simulated drives.
struct BenchOptions {
  std::string interface = "vcan0";
  bool cia402 = false;
  bool lockstep = false;   ///< time passes only with SYNC
  double sync_period = 0;  ///< CiA 402: period of SYNC from the drives [s]; 0: from the host
  double duration = 0;     ///< by the clock [s]; 0: until stopped
  unsigned seed = 1;       ///< of the random bytes
  SimulatorOptions<2> simulator{};
  std::vector<ScriptedFault> faults{};
};

/// Counts and figures of a run.
struct BenchReport {
  std::uint64_t syncs = 0;
  std::uint64_t silent_periods = 0;
  std::uint64_t sent = 0;
  std::uint64_t not_sent = 0;
  JointVector<2> position = JointVector<2>::Zero();
  JointVector<2> highest_effort = JointVector<2>::Zero();
};

/// Simulates drives on an interface. Time passes with each SYNC, and by the clock while SYNC is
/// missing. SYNC is from the host or, by the clock, from the drives.
template <class Protocol>
class Bench {
 public:
  /// @throws std::runtime_error if the interface does not exist
  explicit Bench(const BenchOptions& options)
      : options_(options),
        drives_(Protocol::make(options.simulator)),
        socket_(options.interface),
        random_(options.seed),
        done_(options.faults.size()) {
    open();
  }

  /// Runs until the flag is raised or the duration is over.
  BenchReport play(const StopFlag& stop) {
    const auto begin = socket_.now();
    last_period_ = next_sync_ = begin;
    while (!stop.requested() && !is_over(socket_.now() - begin)) {
      socket_.wait(
          std::min<std::chrono::nanoseconds>(std::chrono::milliseconds(1), time_to_sync()));
      if (socket_.link() == CanLink::gone) open();
      std::array<ReceivedCanFrame, 32> frames;
      const std::size_t count = socket_.receive(frames);
      for (std::size_t i = 0; i < count; ++i) take(frames[i].frame);
      if (options_.sync_period > 0) send_sync();
      if (!options_.lockstep) catch_up();
      send_what_is_due();
    }
    report_.position = drives_.simulator().true_state().position;
    return report_;
  }

 private:
  [[nodiscard]] bool is_over(std::chrono::nanoseconds elapsed) const {
    return options_.duration > 0 &&
           std::chrono::duration<double>(elapsed).count() >= options_.duration;
  }
  void open() { static_cast<void>(socket_.open(Protocol::subscription())); }
  [[nodiscard]] double time() const { return drives_.simulator().time(); }

  [[nodiscard]] std::chrono::nanoseconds time_to_sync() const {
    return options_.sync_period > 0 ? next_sync_ - socket_.now() : std::chrono::seconds(1);
  }

  /// Sends SYNC to host and drives if it is due.
  void send_sync() {
    if (time_to_sync().count() > 0) return;
    const std::chrono::nanoseconds period(std::llround(options_.sync_period * 1e9));
    next_sync_ += period;
    if (time_to_sync().count() <= 0) next_sync_ = socket_.now() + period;  // not in a burst
    begin_faults();
    if (is_on(FaultKind::no_sync, 0)) return;
    CanFrame sync;
    sync.identifier = Protocol::sync;
    queue_.push_back({sync, socket_.now()});
    take(sync);
  }

  void take(const CanFrame& frame) {
    CanBatch answers;
    drives_.receive(frame, answers);
    if (frame.identifier == Protocol::sync) {
      ++report_.syncs;
      last_period_ = socket_.now();
      begin_faults();
    }
    report_.highest_effort = report_.highest_effort.cwiseMax(drives_.effort().cwiseAbs());
    post(answers);
  }

  /// Simulates the periods without SYNC.
  void catch_up() {
    const auto period = std::chrono::nanoseconds(std::llround(options_.simulator.period * 1e9));
    const auto patience = 2 * period;  // SYNC may be late
    while (socket_.now() - last_period_ > patience) {
      CanBatch answers;
      drives_.pass_silent_period(answers);
      last_period_ += period;
      ++report_.silent_periods;
      begin_faults();
      post(answers);
    }
  }

  /// Begins faults that occur once.
  void begin_faults() {
    for (std::size_t k = 0; k < options_.faults.size(); ++k) {
      const ScriptedFault& fault = options_.faults[k];
      if (done_[k] || !fault.is_on(time())) continue;
      done_[k] = true;
      if (fault.kind == FaultKind::bus_off) report_bus_off();
      for (int j = 0; j < 2; ++j) {
        if (!fault.applies_to(j)) continue;
        if (fault.kind == FaultKind::fault) Protocol::raise_fault(drives_, j);
        if (fault.kind == FaultKind::restart) drives_.restart(j);
      }
    }
  }

  /// Whether a fault is active for a joint now.
  [[nodiscard]] bool is_on(FaultKind kind, int joint) const {
    for (const ScriptedFault& fault : options_.faults) {
      if (fault.kind == kind && fault.applies_to(joint) && fault.is_on(time())) return true;
    }
    return false;
  }

  /// Queues frames, changed by the active faults.
  void post(const CanBatch& answers) {
    for (CanFrame frame : answers) {
      int joint = 0;
      while (joint < 1 && Protocol::node_of(frame) != Protocol::node(joint)) ++joint;
      if (is_on(FaultKind::silence, joint)) continue;
      if (is_on(FaultKind::garbage, joint)) {
        frame.length = static_cast<std::uint8_t>(random_() % 9);
        for (std::uint8_t& byte : frame.data) byte = static_cast<std::uint8_t>(random_() & 0xff);
      }
      const auto delay = is_on(FaultKind::delay, joint) ? std::chrono::milliseconds(5)
                                                        : std::chrono::milliseconds(0);
      queue_.push_back({frame, socket_.now() + delay});
    }
  }

  void send_what_is_due() {
    while (!queue_.empty() && queue_.front().time <= socket_.now()) {
      CanBatch batch;
      batch.push_back(queue_.front().frame);
      queue_.pop_front();
      ++(socket_.send(batch) == CanSending::sent ? report_.sent : report_.not_sent);
    }
  }

  /// Sends the error frame of a controller that has left the bus.
  void report_bus_off() {
    const int socket = ::socket(PF_CAN, SOCK_RAW, CAN_RAW);
    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = static_cast<int>(::if_nametoindex(options_.interface.c_str()));
    can_frame frame{};
    frame.can_id = CAN_ERR_FLAG | CAN_ERR_BUSOFF;
    frame.can_dlc = CAN_ERR_DLC;
    if (::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0) {
      ++(::write(socket, &frame, sizeof(frame)) > 0 ? report_.sent : report_.not_sent);
    }
    ::close(socket);
  }

  BenchOptions options_;
  typename Protocol::Drives drives_;
  SocketCan socket_;
  std::mt19937 random_;
  std::vector<bool> done_;
  std::deque<ReceivedCanFrame> queue_{};
  std::chrono::nanoseconds last_period_{};
  std::chrono::nanoseconds next_sync_{};
  BenchReport report_{};
};

}  // namespace articula::examples

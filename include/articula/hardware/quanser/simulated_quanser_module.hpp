// SPDX-License-Identifier: Apache-2.0
/// @file A simulated Quanser joint module, without the joint.
#pragma once

#include "articula/hardware/quanser/quanser_protocol.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace articula {

/// A joint module that follows efforts, latches faults and supervises its host after
/// docs/quanser_protocol.md. It has no sensors and no clock, see SimulatedQuanserDrives. All
/// functions are real-time.
class SimulatedQuanserModule {
 public:
  SimulatedQuanserModule() = default;
  /// @param effort_limit       largest effort of the module [N m]
  /// @param watchdog_periods   the most periods without a new effort
  /// @param heartbeat_periods  periods between two heartbeats
  SimulatedQuanserModule(double effort_limit, int watchdog_periods, int heartbeat_periods) noexcept
      : effort_limit_(effort_limit),
        watchdog_periods_(watchdog_periods),
        heartbeat_periods_(heartbeat_periods) {}

  /// Executes CONTROL.
  void receive(quanser::Control control) noexcept {
    switch (control) {
      case quanser::Control::enable:
        if (!enabled_ && faults_ == 0) {
          disable();  // an earlier effort does not count
          enabled_ = true;
        }
        return;
      case quanser::Control::disable:
        return disable();
      case quanser::Control::clear_faults:
        disable();
        faults_ = causes();
        return;
    }
  }
  /// Stores EFFORT until the SYNC with its counter. SYNC may have arrived already, because a
  /// sender's controller may reorder frames.
  void receive(const quanser::Effort& effort) noexcept {
    if (effort.counter == counter_) return follow(effort);
    pending_ = effort;
  }
  /// SYNC: puts the effort with its counter into force, and drops any other.
  void synchronize(std::uint8_t counter) noexcept {
    counter_ = counter;
    if (pending_ && pending_->counter == counter) follow(*pending_);
    pending_.reset();
  }
  /// Begins a period of the watchdog.
  void begin_period() noexcept {
    if (supervised_ && ++silence_ > watchdog_periods_) latch(quanser::command_timeout);
  }
  /// Ends a period.
  /// @param counts_fit  both encoders' counts are within the range of their frame
  /// @return            a heartbeat, if one is due
  [[nodiscard]] std::optional<quanser::Heartbeat> end_period(bool counts_fit) noexcept {
    out_of_range_ = !counts_fit;
    latch(causes());
    if (--until_heartbeat_ > 0) return {};
    until_heartbeat_ = heartbeat_periods_;
    const quanser::Heartbeat heartbeat{status(), faults_, heartbeats_};
    if (heartbeats_ < 0xffff) ++heartbeats_;
    return heartbeat;
  }

  /// Latches faults whose cause ends at once.
  void latch(std::uint8_t faults) noexcept {
    if (faults == 0) return;
    faults_ |= faults;
    disable();
  }
  /// Latches faults whose cause lasts until the next call.
  void hold(std::uint8_t faults) noexcept {
    held_ = faults;
    latch(faults);
  }
  /// Resets the module. The causes of faults last.
  void restart() noexcept {
    disable();
    faults_ = causes();
    until_heartbeat_ = heartbeats_ = 0;
    counter_ = -1;
  }

  [[nodiscard]] bool enabled() const noexcept { return enabled_; }
  /// The effort in force [N m].
  [[nodiscard]] double effort() const noexcept { return effort_; }
  /// quanser::FaultBit.
  [[nodiscard]] std::uint8_t faults() const noexcept { return faults_; }
  /// quanser::StatusBit.
  [[nodiscard]] std::uint8_t status() const noexcept {
    const bool at_limit = enabled_ && std::abs(effort_) >= effort_limit_;
    return static_cast<std::uint8_t>((enabled_ ? quanser::enabled : 0) |
                                     (faults_ != 0 ? quanser::faulty : 0) |
                                     (at_limit ? quanser::limited : 0));
  }

 private:
  void disable() noexcept {
    enabled_ = supervised_ = false;
    pending_.reset();
    effort_ = 0;
  }
  void follow(const quanser::Effort& effort) noexcept {
    if (!enabled_) return;
    effort_ = std::clamp(effort.millinewton_metres * 1e-3, -effort_limit_, effort_limit_);
    supervised_ = true;
    silence_ = 0;
  }
  /// Faults whose cause lasts.
  [[nodiscard]] std::uint8_t causes() const noexcept {
    return static_cast<std::uint8_t>(held_ | (out_of_range_ ? quanser::encoder : 0));
  }

  double effort_limit_ = 0;  ///< [N m]
  int watchdog_periods_ = 0;
  int heartbeat_periods_ = 0;
  bool enabled_ = false;
  bool supervised_ = false;  ///< an effort has arrived since the module was enabled
  bool out_of_range_ = false;
  std::uint8_t faults_ = 0;
  std::uint8_t held_ = 0;  ///< faults with a lasting cause
  std::optional<quanser::Effort> pending_{};
  double effort_ = 0;  ///< [N m]
  int silence_ = 0;    ///< periods since the last effort
  int counter_ = -1;   ///< of the last SYNC; none yet
  int until_heartbeat_ = 0;
  std::uint16_t heartbeats_ = 0;
};

}  // namespace articula

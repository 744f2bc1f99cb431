// SPDX-License-Identifier: Apache-2.0
/// @file The codec of the Quanser arm's joint modules.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/joint_array.hpp"
#include "articula/hardware/can/can_codec.hpp"
#include "articula/hardware/can/nearest_units.hpp"
#include "articula/hardware/quanser/quanser_module.hpp"
#include "articula/hardware/quanser/quanser_protocol.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace articula {

/// Codec of the Quanser arm's joint modules, docs/quanser_protocol.md. The position in a report is
/// that of the motor's encoder; `load_position` has the other one. If they differ by more than the
/// module's `encoder_tolerance`, the report has `encoder_mismatch`, and set-up fails. Figures are
/// updated only when both frames of a module for a cycle have arrived, so they belong together.
template <Robot R>
class QuanserCodec {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using Command = EffortCommand<joint_count>;
  static_assert(joint_count <= quanser::last_node, "the protocol has 31 nodes");

  /// @param robot    whose joints the modules move
  /// @param modules  in the order of the joints
  /// @throws std::invalid_argument as validate(robot, modules)
  QuanserCodec(const R& robot, const QuanserModules<joint_count>& modules) : modules_{modules} {
    validate(robot, modules);
    joint_of_node_.fill(joint_count);
    for (std::size_t j = 0; j < modules.size(); ++j) {
      joint_of_node_[modules[j].node] = static_cast<std::uint8_t>(j);
      scales_[j] = {modules[j].motor_scale(), modules[j].load_scale()};
    }
  }
  /// For a robot known at compile time.
  explicit QuanserCodec(const QuanserModules<joint_count>& modules)
    requires DescribedRobot<R>
      : QuanserCodec(R(), modules) {}

  /// Real-time: no (allocates).
  [[nodiscard]] CanSubscription subscription() const {
    CanSubscription subscription{.last_of_cycle = quanser::sync_identifier,
                                 .frames_per_cycle = joint_count + 1};
    for (const QuanserModule& module : modules_) {
      for (const std::uint32_t base :
           {quanser::position_base, quanser::motion_base, quanser::heartbeat_base}) {
        subscription.identifiers.push_back(base + module.node);
      }
    }
    return subscription;
  }

  /// Clears all that the modules have reported. Real-time: yes.
  void restart() noexcept {
    reports_.fill({});
    samples_.fill({});
    load_position_.setZero();
    next_request_ = {};
    enabling_ = false;
  }

  /// Clears faults, waits until all modules report that they are disabled, enables them, and waits
  /// until they report that. It repeats requests, because one may be lost. Modules that were
  /// enabled before do not count: the request that clears faults may still be on its way to them.
  /// Real-time: yes.
  [[nodiscard]] CanSetUp set_up(std::chrono::nanoseconds elapsed, CanBatch& batch) noexcept {
    const auto all = [&](auto condition) {
      return std::ranges::all_of(reports_, [&](const DriveReport& r) {
        return r.age != DriveReport::never && r.fault == 0 && condition(r);
      });
    };
    if (std::ranges::any_of(reports_, &DriveReport::encoder_mismatch)) return CanSetUp::failed;
    const bool done = enabling_ && all([](const DriveReport& r) { return r.enabled; });
    if (!done && elapsed >= next_request_) {
      const bool begun = next_request_ > std::chrono::nanoseconds{};
      next_request_ = elapsed + std::chrono::milliseconds(20);
      enabling_ = begun && all([&](const DriveReport& r) { return enabling_ || !r.enabled; });
      push_control(enabling_ ? quanser::Control::enable : quanser::Control::clear_faults, batch);
    }
    begin_cycle(batch);
    return done ? CanSetUp::done : CanSetUp::in_progress;
  }

  /// Appends an effort frame for each module, rounded to 1e-3 N m and within the range of the
  /// frame, 0 for a NaN, and SYNC. Real-time: yes. O(N).
  void encode(const Command& command, CanBatch& batch) noexcept {
    const auto counter = static_cast<std::uint8_t>(cycle_ + 1);
    for (int j = 0; j < joint_count; ++j) {
      const double effort = is_finite(command.effort[j]) ? command.effort[j] : 0;
      const auto millis = static_cast<std::int16_t>(nearest_units(effort * 1e3, 32767));
      batch.push_back(quanser::encode(quanser::Effort{millis, counter}, modules_[j].node));
    }
    begin_cycle(batch);
  }

  /// Disables all modules. Real-time: yes. O(N).
  void encode_stop(CanBatch& batch) noexcept {
    push_control(quanser::Control::disable, batch);
    begin_cycle(batch);
  }

  /// Decodes a module's frame. Real-time: yes. O(1).
  [[nodiscard]] CanDecoding decode(const CanFrame& frame) noexcept {
    const std::uint32_t node = frame.identifier % (quanser::last_node + 1);
    const int j = joint_of_node_[node];
    if (frame.extended || j == joint_count) return CanDecoding::foreign;
    switch (frame.identifier - node) {
      case quanser::position_base:
        return take_position(j, frame);
      case quanser::motion_base:
        return take_motion(j, frame);
      case quanser::heartbeat_base:
        return take_heartbeat(j, frame);
      case quanser::control_base:
      case quanser::effort_base:  // of another host
        return CanDecoding::malformed;
      default:
        return CanDecoding::foreign;
    }
  }

  /// The modules' last reports. Real-time: yes.
  [[nodiscard]] const JointArray<DriveReport, joint_count>& reports() const noexcept {
    return reports_;
  }
  /// Position of the load's encoders, of the same cycle as the report [rad], N x 1.
  /// Real-time: yes.
  [[nodiscard]] const JointVector<joint_count>& load_position() const noexcept {
    return load_position_;
  }
  /// Number of cycles begun; the counter on the bus is its lowest byte. Real-time: yes.
  [[nodiscard]] std::uint64_t cycle() const noexcept { return cycle_; }
  [[nodiscard]] const QuanserModules<joint_count>& modules() const noexcept { return modules_; }

 private:
  /// The last two frames of a module, and their cycles; there is no cycle 0.
  struct Sample {
    quanser::Position position{};
    quanser::Motion motion{};
    std::uint64_t position_cycle = 0, motion_cycle = 0;
    std::uint64_t complete_cycle = 0;  ///< of the last pair
  };
  struct Scales {
    double motor = 1, load = 1;  ///< counts per radian of the joint [1/rad]
  };

  void push_control(quanser::Control control, CanBatch& batch) const noexcept {
    for (const QuanserModule& module : modules_) {
      batch.push_back(quanser::encode(control, module.node));
    }
  }
  void begin_cycle(CanBatch& batch) noexcept {
    ++cycle_;
    for (DriveReport& report : reports_) report.begin_cycle();
    batch.push_back(quanser::encode_sync(static_cast<std::uint8_t>(cycle_)));
  }

  // Not inlined, as take_motion and take_heartbeat: together they would cost each frame registers.
  [[nodiscard, gnu::noinline]] CanDecoding take_position(int j, const CanFrame& frame) noexcept {
    return take(j, quanser::decode_position(frame), samples_[j].position,
                samples_[j].position_cycle);
  }
  [[nodiscard, gnu::noinline]] CanDecoding take_motion(int j, const CanFrame& frame) noexcept {
    return take(j, quanser::decode_motion(frame), samples_[j].motion, samples_[j].motion_cycle);
  }
  [[nodiscard, gnu::noinline]] CanDecoding take_heartbeat(int j, const CanFrame& frame) noexcept {
    const auto heartbeat = quanser::decode_heartbeat(frame);
    if (!heartbeat) return CanDecoding::malformed;
    take_condition(j, heartbeat->status, heartbeat->faults);
    return CanDecoding::accepted;
  }

  /// Stores a frame, and updates the report if the pair of its cycle is complete. A frame is
  /// outdated if its counter is of none of the last 128 cycles, or if a newer one has arrived.
  template <class Frame>
  [[nodiscard, gnu::always_inline]] inline CanDecoding take(int j, const Frame& received,
                                                            typename Frame::value_type& last,
                                                            std::uint64_t& last_cycle) noexcept {
    if (!received) return CanDecoding::malformed;
    Sample& sample = samples_[j];
    const auto age =
        static_cast<std::uint8_t>(static_cast<std::uint8_t>(cycle_) - received->counter);
    const std::uint64_t cycle = age < 128 && age < cycle_ ? cycle_ - age : 0;
    if (cycle == 0 || cycle <= sample.complete_cycle || cycle < last_cycle) {
      return CanDecoding::outdated;
    }
    last = *received;
    last_cycle = cycle;
    if (sample.position_cycle == sample.motion_cycle) complete(j);
    return CanDecoding::accepted;
  }

  [[gnu::always_inline]] inline void complete(int j) noexcept {
    Sample& sample = samples_[j];
    sample.complete_cycle = sample.position_cycle;
    const QuanserModule& module = modules_[j];
    DriveReport& report = reports_[j];
    report.position = sample.position.motor_counts / scales_[j].motor + module.position_at_zero;
    load_position_[j] = sample.position.load_counts / scales_[j].load + module.position_at_zero;
    const double difference = report.position - load_position_[j];
    report.encoder_mismatch = std::abs(difference) > module.encoder_tolerance;
    report.velocity = sample.motion.milliradians_per_second / 1e3;
    report.effort = sample.motion.millinewton_metres / 1e3;
    report.age = static_cast<std::uint32_t>(cycle_ - sample.complete_cycle);
    take_condition(j, sample.position.status, sample.motion.faults);
  }

  void take_condition(int j, std::uint8_t status, std::uint8_t faults) noexcept {
    reports_[j].enabled = (status & quanser::enabled) != 0;
    // A faulty status without a fault bit counts as an internal fault.
    const bool unnamed = (status & quanser::faulty) != 0 && faults == 0;
    reports_[j].fault = unnamed ? std::uint8_t{quanser::internal} : faults;
  }

  JointArray<QuanserModule, joint_count> modules_;
  std::array<std::uint8_t, quanser::last_node + 1> joint_of_node_{};  ///< joint_count: unknown node
  JointArray<Scales, joint_count> scales_{};
  JointArray<DriveReport, joint_count> reports_{};
  JointArray<Sample, joint_count> samples_{};
  JointVector<joint_count> load_position_ = JointVector<joint_count>::Zero();
  std::uint64_t cycle_ = 0;
  std::chrono::nanoseconds next_request_{};
  bool enabling_ = false;  ///< set-up: all modules were disabled, and are requested to follow
};

}  // namespace articula

// SPDX-License-Identifier: Apache-2.0
/// @file The language of the Quanser arm's joint modules.
#pragma once

#include "articula/core/finite.hpp"
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
#include <span>

namespace articula {

/// Codec of the Quanser arm's joint modules, docs/quanser_protocol.md. The position is that of the
/// motor's encoder; `load_position` has the other one. If they differ by more than the module's
/// `encoder_tolerance`, the report has `encoder_mismatch`, and set-up fails. A joint's figures are
/// taken over only when both of its frames for a cycle are there, so they belong together.
/// @tparam R  the robot
template <Robot R>
class QuanserCodec {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using Command = EffortCommand<joint_count>;
  static_assert(joint_count <= quanser::last_node, "the protocol has 31 nodes");

  /// @param robot    whose joints the modules move
  /// @param modules  in the order of the joints
  /// @throws std::invalid_argument as validate says
  QuanserCodec(const R& robot, const QuanserModules<joint_count>& modules) : modules_(modules) {
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
                                 .frames_per_cycle = modules_.size() + 1};
    for (const QuanserModule& module : modules_) {
      for (const std::uint32_t base :
           {quanser::position_base, quanser::motion_base, quanser::heartbeat_base}) {
        subscription.identifiers.push_back(base + module.node);
      }
    }
    return subscription;
  }

  /// Forgets what the modules have said. Real-time: yes.
  void restart() noexcept {
    reports_.fill({});
    halves_.fill({});
    load_position_.setZero();
    next_request_ = {};
    enabling_ = false;
  }

  /// Clears faults, waits until all modules report that they have let go, enables them and waits
  /// until they report that. Requests are repeated, in case one was lost. Modules that are enabled
  /// from before do not count: a request that clears faults may still be on its way to them.
  /// Real-time: yes.
  [[nodiscard]] CanSetUp set_up(std::chrono::nanoseconds elapsed, CanBatch& batch) noexcept {
    const auto all = [&](auto condition) { return std::ranges::all_of(reports_, condition); };
    if (!all([](const DriveReport& r) { return !r.encoder_mismatch; })) return CanSetUp::failed;
    const bool done = enabling_ && all([](const DriveReport& r) {
                        return r.age != DriveReport::never && r.enabled && r.fault == 0;
                      });
    if (!done && elapsed >= next_request_) {
      constexpr std::chrono::milliseconds between_requests{20};
      const bool begun = next_request_ > std::chrono::nanoseconds{};
      next_request_ = elapsed + between_requests;
      const bool calm =
          begun && all([this](const DriveReport& r) {
            return r.age != DriveReport::never && r.fault == 0 && (enabling_ || !r.enabled);
          });
      enabling_ = calm;
      const auto request = calm ? quanser::Control::enable : quanser::Control::clear_faults;
      for (const QuanserModule& module : modules_) {
        batch.push_back(quanser::encode(request, module.node));
      }
    }
    begin_cycle(batch);
    return done ? CanSetUp::done : CanSetUp::in_progress;
  }

  /// One effort frame for each module, rounded to 1e-3 N m and held within the range of the frame,
  /// 0 for a NaN, and SYNC. Real-time: yes. O(N).
  void encode(const Command& command, CanBatch& batch) noexcept {
    const auto counter = static_cast<std::uint8_t>(cycle_ + 1);
    for (std::size_t j = 0; j < modules_.size(); ++j) {
      batch.push_back(quanser::encode(
          quanser::Effort{millis(command.effort[static_cast<int>(j)]), counter}, modules_[j].node));
    }
    begin_cycle(batch);
  }

  /// Disables all modules. Real-time: yes. O(N).
  void encode_stop(CanBatch& batch) noexcept {
    for (const QuanserModule& module : modules_) {
      batch.push_back(quanser::encode(quanser::Control::disable, module.node));
    }
    begin_cycle(batch);
  }

  /// Takes in a module's frame. Real-time: yes. O(1).
  [[nodiscard]] CanDecoding decode(const CanFrame& frame) noexcept {
    const std::uint32_t node = frame.identifier % (quanser::last_node + 1);
    const std::size_t j = joint_of_node_[node];
    if (frame.extended || j == count) return CanDecoding::foreign;
    switch (frame.identifier - node) {
      case quanser::position_base:
        return take_position(j, frame);
      case quanser::motion_base:
        return take_motion(j, frame);
      case quanser::heartbeat_base:
        return take_heartbeat(j, frame);
      case quanser::control_base:
      case quanser::effort_base:  // another host's
        return CanDecoding::malformed;
      default:
        return CanDecoding::foreign;
    }
  }

  /// What the modules have said. Real-time: yes.
  [[nodiscard]] std::span<const DriveReport, static_cast<std::size_t>(joint_count)> reports()
      const noexcept {
    return reports_;
  }
  /// Position of the load's encoders, of the same cycle as the report [rad], N x 1.
  /// Real-time: yes.
  [[nodiscard]] const JointVector<joint_count>& load_position() const noexcept {
    return load_position_;
  }
  /// How many cycles were begun; the counter on the wire is its lowest byte. Real-time: yes.
  [[nodiscard]] std::uint64_t cycle() const noexcept { return cycle_; }
  [[nodiscard]] const QuanserModules<joint_count>& modules() const noexcept { return modules_; }

 private:
  /// The two frames of a module for one cycle; cycle 0 has never been.
  struct Halves {
    std::int32_t motor_counts = 0, load_counts = 0;
    std::int16_t milliradians_per_second = 0, millinewton_metres = 0;
    std::uint8_t status = 0, faults = 0;
    std::uint64_t position_cycle = 0;
    std::uint64_t motion_cycle = 0;
    std::uint64_t taken_cycle = 0;
  };

  [[nodiscard]] static std::int16_t millis(double value) noexcept {
    if (!is_finite(value)) return 0;
    return static_cast<std::int16_t>(nearest_units(value * 1e3, 32767));
  }

  void begin_cycle(CanBatch& batch) noexcept {
    ++cycle_;
    for (DriveReport& report : reports_) {
      if (report.age < DriveReport::never - 1) ++report.age;
    }
    batch.push_back(quanser::encode_sync(static_cast<std::uint8_t>(cycle_)));
  }

  /// The cycle that a counter means: one of the last 128, or 0 for none of them.
  [[nodiscard]] std::uint64_t cycle_of(std::uint8_t counter) const noexcept {
    const auto age = static_cast<std::uint8_t>(static_cast<std::uint8_t>(cycle_) - counter);
    return age < 128 && age < cycle_ ? cycle_ - age : 0;
  }

  /// A frame of no cycle, of one that is known already, or of an older one than its like has come
  /// for; that one must not displace what is newer.
  [[nodiscard]] bool is_outdated(std::size_t j, std::uint64_t cycle,
                                 std::uint64_t newest) const noexcept {
    return cycle == 0 || cycle <= halves_[j].taken_cycle || cycle < newest;
  }

  // Functions of their own: together they would cost each frame some registers.
  [[nodiscard, gnu::noinline]] CanDecoding take_position(std::size_t j,
                                                         const CanFrame& frame) noexcept {
    const auto position = quanser::decode_position(frame);
    if (!position) return CanDecoding::malformed;
    Halves& half = halves_[j];
    const std::uint64_t cycle = cycle_of(position->counter);
    if (is_outdated(j, cycle, half.position_cycle)) return CanDecoding::outdated;
    half.motor_counts = position->motor_counts;
    half.load_counts = position->load_counts;
    half.status = position->status;
    half.position_cycle = cycle;
    complete(j);
    return CanDecoding::accepted;
  }
  [[nodiscard, gnu::noinline]] CanDecoding take_motion(std::size_t j,
                                                       const CanFrame& frame) noexcept {
    const auto motion = quanser::decode_motion(frame);
    if (!motion) return CanDecoding::malformed;
    Halves& half = halves_[j];
    const std::uint64_t cycle = cycle_of(motion->counter);
    if (is_outdated(j, cycle, half.motion_cycle)) return CanDecoding::outdated;
    half.milliradians_per_second = motion->milliradians_per_second;
    half.millinewton_metres = motion->millinewton_metres;
    half.faults = motion->faults;
    half.motion_cycle = cycle;
    complete(j);
    return CanDecoding::accepted;
  }
  [[nodiscard, gnu::noinline]] CanDecoding take_heartbeat(std::size_t j,
                                                          const CanFrame& frame) noexcept {
    const auto heartbeat = quanser::decode_heartbeat(frame);
    if (!heartbeat) return CanDecoding::malformed;
    take_condition(j, heartbeat->status, heartbeat->faults);
    return CanDecoding::accepted;
  }

  [[gnu::always_inline]] inline void complete(std::size_t j) noexcept {
    Halves& half = halves_[j];
    if (half.position_cycle != half.motion_cycle) return;
    half.taken_cycle = half.position_cycle;
    const QuanserModule& module = modules_[j];
    DriveReport& report = reports_[j];
    report.position = half.motor_counts / scales_[j].motor + module.position_at_zero;
    load_position_[static_cast<int>(j)] =
        half.load_counts / scales_[j].load + module.position_at_zero;
    const double difference = report.position - load_position_[static_cast<int>(j)];
    report.encoder_mismatch = std::abs(difference) > module.encoder_tolerance;
    report.velocity = half.milliradians_per_second / 1e3;
    report.effort = half.millinewton_metres / 1e3;
    report.age = static_cast<std::uint32_t>(cycle_ - half.taken_cycle);
    take_condition(j, half.status, half.faults);
  }

  void take_condition(std::size_t j, std::uint8_t status, std::uint8_t faults) noexcept {
    reports_[j].enabled = (status & quanser::enabled) != 0;
    // A status that says faulty without telling which fault counts as internal.
    const bool nameless = (status & quanser::faulty) != 0 && faults == 0;
    reports_[j].fault = nameless ? std::uint8_t{quanser::internal} : faults;
  }

  struct Scales {
    double motor = 1, load = 1;  ///< counts per radian of the joint [1/rad]
  };

  static constexpr auto count = static_cast<std::size_t>(joint_count);

  QuanserModules<joint_count> modules_;
  /// joint_count for those of nobody; node 0 is nobody's.
  std::array<std::uint8_t, quanser::last_node + 1> joint_of_node_{};
  std::array<Scales, static_cast<std::size_t>(joint_count)> scales_{};
  std::array<DriveReport, static_cast<std::size_t>(joint_count)> reports_{};
  std::array<Halves, static_cast<std::size_t>(joint_count)> halves_{};
  JointVector<joint_count> load_position_ = JointVector<joint_count>::Zero();
  std::uint64_t cycle_ = 0;
  std::chrono::nanoseconds next_request_{};
  bool enabling_ = false;  ///< of set-up: all have let go, and are requested to follow
};

}  // namespace articula

// SPDX-License-Identifier: Apache-2.0
/// @file The concept of a codec: commands to CAN frames, and CAN frames to reports.
#pragma once

#include "articula/core/joint_command.hpp"
#include "articula/hardware/can/can_batch.hpp"
#include "articula/hardware/can/can_fault.hpp"

#include <chrono>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace articula {

/// The frames that a codec receives, and the output of a cycle. All identifiers have 11 bits.
struct CanSubscription {
  std::vector<std::uint32_t> identifiers{};  ///< of the drives' frames
  std::uint32_t last_of_cycle = 0;           ///< identifier of the last frame of a cycle's output
  std::size_t frames_per_cycle = 0;          ///< the most frames of that output
};

/// The last report of a drive and its joint.
struct DriveReport {
  static constexpr std::uint32_t never = std::numeric_limits<std::uint32_t>::max();

  double position = 0;            ///< q [rad or m]
  double velocity = 0;            ///< v [rad/s or m/s]
  double effort = 0;              ///< measured effort [N m or N]
  std::uint32_t age = never;      ///< cycles begun since the cycle of the figures above
  bool enabled = false;           ///< follows commands
  bool encoder_mismatch = false;  ///< two encoders of the joint differ by more than is allowed
  std::uint16_t fault = 0;        ///< the protocol's own fault code, 0 if there is none

  /// Adds a cycle to the age. Real-time: yes.
  constexpr void begin_cycle() noexcept {
    if (age < never - 1) ++age;
  }
};

/// The sender of the frame that begins a cycle of the drives.
enum class SyncProducer : unsigned char {
  host,          ///< The codec, at the end of each cycle's commands: the loop paces the bus.
  another_node,  ///< A drive or a master clock: the bus paces the loop, see PacedCanCodec.
};

/// The result of decoding a frame.
enum class [[nodiscard]] CanDecoding : unsigned char {
  accepted,   ///< A drive's frame, entered into its report.
  outdated,   ///< A drive's well-formed frame that is too old to be of use.
  foreign,    ///< A frame with an identifier that the codec does not know.
  malformed,  ///< A frame with a drive's identifier and invalid content.
};

/// The progress of the drives' set-up.
enum class [[nodiscard]] CanSetUp : unsigned char {
  in_progress,  ///< More steps follow.
  done,    ///< All drives have reported that they are enabled, at zero effort or where they stand.
  failed,  ///< A drive has refused.
};

/// The protocol of an arm's drives: turns commands into frames and frames into reports. It has no
/// clock, no bus and no threads.
///
/// - `subscription()` lists the frames that it receives.
/// - `restart()` clears its state: the condition of the drives is unknown from then on.
/// - `set_up(elapsed, batch)` appends the frames of the next step towards enabled drives. The
///   driver calls it about once a cycle, with the time since `restart`, until it returns
///   CanSetUp::done and the reports are young enough. Once all drives are enabled, each call begins
///   a cycle.
/// - `encode(command, batch)` begins a cycle: appends the frames of the commands.
/// - `encode_stop(batch)` begins a cycle that disables all drives.
/// - `decode(frame)` enters a frame into the reports. It accepts any frame.
/// - `reports()` are the last reports of the drives, in the order of the joints.
///
/// A codec may have four more functions:
///
/// - `cancel_output()`: the bus did not take all frames of the last `set_up`, `encode` or
///   `encode_stop`. For codecs that count the frames that they expect in return.
/// - `all_off()`: whether all drives have reported that they exert no effort, where they report
///   that by other means than feedback. Without this function, the reports decide.
/// - `release(elapsed, batch)` appends the frames that switch off watchdogs, which would report a
///   fault after a clean end. The driver calls it once the drives are disabled, about once a cycle,
///   with `elapsed` from zero on, until it returns CanSetUp::done.
/// - `set_up_fault()` is the CanFault that explains why the set-up has not succeeded.
///
/// All functions but `subscription` are noexcept and real-time. Examples: QuanserCodec,
/// Cia402Codec.
/// @tparam C  the codec
template <class C>
concept CanCodec =
    JointCommand<typename C::Command, C::joint_count> &&
    requires(C codec, const C& constant, const typename C::Command& command, const CanFrame& frame,
             std::chrono::nanoseconds elapsed, CanBatch& batch) {
      { constant.subscription() } -> std::same_as<CanSubscription>;
      { codec.restart() } noexcept;
      { codec.set_up(elapsed, batch) } noexcept -> std::same_as<CanSetUp>;
      { codec.encode(command, batch) } noexcept;
      { codec.encode_stop(batch) } noexcept;
      { codec.decode(frame) } noexcept -> std::same_as<CanDecoding>;
      {
        constant.reports()
      } noexcept -> std::convertible_to<
          std::span<const DriveReport, static_cast<std::size_t>(C::joint_count)>>;
    };

/// A codec for a bus on which a frame of another node begins the cycles, so that the bus can pace a
/// loop. `begun_cycles()` is the number of cycles begun so far.
///
/// `encode` and `encode_stop` do not begin cycles then. If no cycle has begun since the last
/// output, they make the reports one cycle older all the same. So a silent bus is noticed.
template <class C>
concept PacedCanCodec = CanCodec<C> && requires(const C& constant) {
  { constant.begun_cycles() } noexcept -> std::same_as<std::uint64_t>;
};

}  // namespace articula

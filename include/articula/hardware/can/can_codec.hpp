// SPDX-License-Identifier: Apache-2.0
/// @file What a codec is: the language of an arm's drives on a CAN bus, without the bus.
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

/// Which frames a codec wants to hear, and what it sends in a cycle. All in base format (11 bits).
struct CanSubscription {
  std::vector<std::uint32_t> identifiers{};  ///< the drives' frames
  std::uint32_t last_of_cycle = 0;           ///< of the frame with which each cycle's output ends
  std::size_t frames_per_cycle = 0;          ///< how many frames that output has at most
};

/// What a drive last said of itself and its joint.
struct DriveReport {
  static constexpr std::uint32_t never = std::numeric_limits<std::uint32_t>::max();

  double position = 0;            ///< q [rad or m]
  double velocity = 0;            ///< v [rad/s or m/s]
  double effort = 0;              ///< measured effort [N m or N]
  std::uint32_t age = never;      ///< cycles begun since the one that the figures above belong to
  bool enabled = false;           ///< follows commands
  bool encoder_mismatch = false;  ///< two encoders of the joint differ by more than is allowed
  std::uint16_t fault = 0;        ///< the protocol's own fault code, 0 if there is none
};

/// Who sends the frame that begins a cycle of the drives.
enum class SyncProducer : unsigned char {
  host,          ///< The codec, at the end of each cycle's commands: the loop paces the bus.
  another_node,  ///< A drive or a master clock: the bus paces the loop, see PacedCanCodec.
};

/// What a codec made of a frame.
enum class [[nodiscard]] CanDecoding : unsigned char {
  accepted,   ///< A drive's frame, taken into its report.
  outdated,   ///< A drive's well-formed frame that is too old to be of use.
  foreign,    ///< A frame of nobody that the codec knows.
  malformed,  ///< Has a drive's identifier, but the content makes no sense.
};

/// How far the set-up of the drives is.
enum class [[nodiscard]] CanSetUp : unsigned char {
  in_progress,  ///< Go on.
  done,         ///< All drives are enabled at zero effort (or where they are) and have said so.
  failed,       ///< A drive has refused.
};

/// The language of an arm's drives: turns commands into frames and frames into reports. It has no
/// clock, no bus and no threads.
///
/// - `subscription()` tells which frames matter.
/// - `restart()` forgets all: the drives' condition is unknown from here on.
/// - `set_up(elapsed, batch)` appends the frames that bring the drives a step nearer to being
///   enabled; it is called about once a cycle, `elapsed` since `restart`, until it says done and
///   the reports are young enough for the caller. Once all are enabled, each call begins a cycle.
/// - `encode(command, batch)` begins a cycle: appends the frames that hand it to the drives.
/// - `encode_stop(batch)` begins a cycle in which all drives are to let go: no effort, disabled.
/// - `decode(frame)` takes in a frame. It is total: any frame gives an answer.
/// - `reports()` tells what is known of each drive, in the order of the joints.
///
/// A codec may have two more functions:
///
/// - `withdraw()`: the bus did not take all frames of the last `set_up`, `encode` or `encode_stop`.
///   For codecs that count the frames that they wait for.
/// - `let_go()`: whether all drives have said that they exert nothing. For drives that can say so
///   in other ways than by feedback; without it, feedback has to say so.
///
/// Everything but `subscription` is noexcept and real-time.
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

/// A codec whose drives have watchdogs that would report a fault after a clean end. Once the drives
/// have let go, `release(elapsed, batch)` appends the frames that take the watchdogs off; it is
/// called about once a cycle, `elapsed` from zero on, until it says done.
template <class C>
concept ReleasingCanCodec =
    CanCodec<C> && requires(C codec, std::chrono::nanoseconds elapsed, CanBatch& batch) {
      { codec.release(elapsed, batch) } noexcept -> std::same_as<CanSetUp>;
    };

/// A codec that can tell why the set-up has not come to its end: which drive it was, and what it
/// has refused.
template <class C>
concept ExplainingCanCodec = CanCodec<C> && requires(const C& constant) {
  { constant.set_up_fault() } noexcept -> std::same_as<CanFault>;
};

/// A codec whose drives' cycles are begun by a frame of another node, which can pace a loop:
/// `heard_cycles()` tells how many have begun.
///
/// `encode` and `encode_stop` begin no cycle then. But where none has begun since the last time,
/// the reports grow older by one all the same, so that a bus that falls silent is found.
template <class C>
concept PacedCanCodec = CanCodec<C> && requires(const C& constant) {
  { constant.heard_cycles() } noexcept -> std::same_as<std::uint64_t>;
};

}  // namespace articula

// SPDX-License-Identifier: Apache-2.0
/// @file Replays a recorded run, and goes on from it in simulation.
#pragma once

#include "articula/control/switching/switch_board.hpp"
#include "articula/core/finite.hpp"
#include "articula/core/refuse.hpp"
#include "articula/loop/supervision/supervised_loop.hpp"
#include "articula/recording/recording.hpp"
#include "articula/remote/engine/loop_traits.hpp"
#include "articula/replay/gain_settings.hpp"
#include "articula/replay/recorded_hardware.hpp"
#include "articula/replay/replay_difference.hpp"

#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace articula {

/// What a replay takes over from the program that recorded.
/// @tparam C  the controller
template <class C>
struct ReplayOptions {
  C controller = detail::default_controller<C>();  ///< as it was made there
  SupervisionOptions supervision{};                ///< of a SupervisedLoop
  /// [s]; 0: that of the records, in whole nanoseconds if they begin in the middle of a run
  double period = 0;
};

/// Feeds what was recorded to a new loop of the same types, and compares what it commands with what
/// was recorded, to the last bit:
///
///     Replay<SupervisedLoop<Q2dCan, PidPlusGravity>> replay(recording);
///     if (const auto difference = replay.run()) std::puts(to_string(*difference).c_str());
///
/// Without a difference, this program would have done the same as the one that recorded, and the
/// controller has the memory that it had then. From any cycle on, a simulator can take the place of
/// the records, with other gains or references:
///
///     replay.run_until(500);                           // cycles 1 to 499
///     replay.simulate(Simulator<Q2d>());               // in the state of cycle 500
///     replay.loop().controller().set_gains(others);
///     while (replay.loop().update() == Status::ok) ...
///
/// - The recording begins with the first cycle of the loop. That of a supervised loop may also
///   begin with a cycle in which it is inactive: its activation restarts the controller. With the
///   record of cycle 0, which `record_of(loop, RunReport{})` makes before the run, it also has the
///   first measurement. Without it, bad cycles before the first good one may differ.
/// - The recording has no gap: a difference in time shows one.
/// - Changes of gains and requests to switch are in Recording::changes.
/// - Of a supervised loop only commands that drives get are compared, but for the last one before
///   it is deactivated.
/// - Both programs are compiled for the same bits (ARTICULA_SAME_BITS), unless they are the same.
/// @tparam LoopType  a Loop or SupervisedLoop, with any hardware
template <class LoopType>
class Replay {
 public:
  using RobotType = typename LoopType::RobotType;
  using ControllerType = typename LoopType::ControllerType;
  using Command = typename LoopType::Command;
  static constexpr int joint_count = LoopType::joint_count;
  using HardwareType = RecordedHardware<RobotType, Command>;
  using Record = CycleRecord<joint_count, Command>;
  /// The loop that computes once more.
  using ReplayedLoop = std::conditional_t<remote::is_supervised<LoopType>,
                                          SupervisedControlLoop<HardwareType, ControllerType>,
                                          ControlLoop<HardwareType, ControllerType>>;

  /// @param robot      whose loop was recorded
  /// @param recording  outlives this
  /// @param options    of the recorded program
  /// @throws std::invalid_argument if the recording is empty or does not begin with the loop's
  ///         first cycle, or an option makes no sense
  /// Real-time: no (allocates, throws), likewise all functions of this class.
  Replay(const RobotType& robot, const Recording<joint_count, Command>& recording,
         ReplayOptions<ControllerType> options)
      : recording_(recording),
        loop_(made(first_hardware(robot, recording, options.period), std::move(options))),
        next_(has_beginning(recording) ? 1 : 0) {
    if (next_ < recording.cycles.size()) first_period_ = periods_of(recording.cycles[next_].time);
  }
  /// For a robot known at compile time, with the default controller.
  explicit Replay(const Recording<joint_count, Command>& recording)
    requires DescribedRobot<RobotType>
      : Replay(RobotType(), recording, ReplayOptions<ControllerType>()) {}
  /// Likewise, with options.
  Replay(const Recording<joint_count, Command>& recording, ReplayOptions<ControllerType> options)
    requires DescribedRobot<RobotType>
      : Replay(RobotType(), recording, std::move(options)) {}
  Replay(const Replay&) = delete;
  Replay& operator=(const Replay&) = delete;

  /// Whether all records are replayed, or a simulator has taken their place.
  [[nodiscard]] bool is_done() const noexcept {
    return next_ >= recording_.cycles.size() || loop_.hardware().is_simulated();
  }

  /// Computes the cycle of the next record.
  /// @return what differs, if anything does
  /// @throws std::invalid_argument if a change before this cycle cannot be made
  std::optional<ReplayDifference> next() {
    const Record& record = recording_.cycles[next_++];
    make_changes(record.cycle);
    report_overruns(record.input);
    loop_.hardware().show(record);
    give_reference(record);
    request(record.input.request);
    const Status status = loop_.update();
    return compare(record, status);
  }

  /// Computes the cycles up to the end, or up to the first difference.
  std::optional<ReplayDifference> run() { return run_until(std::uint64_t(-1)); }
  /// Computes the cycles before the one of this number, up to the first difference.
  std::optional<ReplayDifference> run_until(std::uint64_t cycle) {
    while (!is_done() && recording_.cycles[next_].cycle < cycle) {
      if (auto difference = next()) return difference;
    }
    return std::nullopt;
  }

  /// A simulator takes the place of the records, in the state of the next one and with its
  /// reference. A supervised loop needs references within their lifetime from now on.
  /// @param simulator  with the recorded loop's period
  /// @throws std::invalid_argument if there is no next record, or the period is another
  void simulate(const Simulator<RobotType>& simulator)
    requires DynamicRobot<RobotType>
  {
    if (is_done()) detail::refuse({"replay: there is no record left from which to simulate"});
    if (simulator.period() != loop_.period()) {
      detail::refuse({"replay: the simulator's period is ", simulator.period(),
                      " s, but that of the recorded loop is ", loop_.period(), " s"});
    }
    const Record& record = recording_.cycles[next_];
    make_changes(record.cycle);
    loop_.hardware().show(record);
    give_reference(record);
    loop_.hardware().simulate(simulator);
  }

  /// The loop, to look at or to go on with.
  [[nodiscard]] ReplayedLoop& loop() noexcept { return loop_; }
  [[nodiscard]] const ReplayedLoop& loop() const noexcept { return loop_; }

 private:
  static constexpr bool supervised = remote::is_supervised<LoopType>;

  [[nodiscard]] static bool has_beginning(const Recording<joint_count, Command>& recording) {
    return recording.cycles.front().cycle == 0;
  }

  [[nodiscard]] static HardwareType first_hardware(const RobotType& robot,
                                                   const Recording<joint_count, Command>& recording,
                                                   double period) {
    const auto& cycles = recording.cycles;
    if (cycles.empty()) detail::refuse({"replay: the recording is empty"});
    const std::size_t first = has_beginning(recording) ? 1 : 0;
    const bool is_inactive =
        supervised && cycles[first == cycles.size() ? 0 : first].status == Status::inactive;
    if (cycles.size() > first && cycles[first].time != 0 && !is_inactive) {
      detail::refuse({"replay: the recording begins at ", cycles[first].time,
                      " s, in the middle of its run; what the controller remembered is not known"});
    }
    if (period == 0) period = cycles.size() > first + 1 ? period_of(cycles, first) : 1e-3;
    HardwareType hardware(robot, period);
    if (first == 1) hardware.show(cycles.front());
    return hardware;
  }

  /// The time is a whole number of periods, so that of the second cycle of a run is the period. In
  /// the middle of a run, where differences are rounded, the period has whole nanoseconds.
  [[nodiscard]] static double period_of(const std::vector<Record>& cycles, std::size_t first) {
    if (cycles[first].time == 0) return cycles[first + 1].time;
    return std::round((cycles[first + 1].time - cycles[first].time) * 1e9) / 1e9;
  }

  [[nodiscard]] static ReplayedLoop made(HardwareType hardware,
                                         ReplayOptions<ControllerType> options) {
    const double period = hardware.period();
    if constexpr (supervised) {
      return ReplayedLoop(std::move(hardware), std::move(options.controller), options.supervision,
                          period);
    } else {
      return ReplayedLoop(std::move(hardware), std::move(options.controller), period);
    }
  }

  /// The number of periods in a time of the loop [s].
  [[nodiscard]] long long periods_of(double time) const {
    return std::llround(time / loop_.period());
  }

  void make_changes(std::uint64_t cycle) {
    const auto& changes = recording_.changes;
    for (; next_change_ < changes.size() && changes[next_change_].cycle <= cycle; ++next_change_) {
      const LoopChange& change = changes[next_change_];
      set_gains(loop_.hardware().robot(), loop_.controller(), change.gains);
      if (is_empty(change.request)) continue;
      if constexpr (detail::switch_size<ControllerType> > 0) {
        static_cast<void>(switch_in(loop_.controller()).request(change.request));
      } else {
        detail::refuse({"replay: the recording switches controllers before cycle ", change.cycle,
                        ", but this loop has none to switch"});
      }
    }
  }

  void report_overruns([[maybe_unused]] const CycleInput& input) {
    if constexpr (supervised) {
      for (std::uint32_t k = 0; k < input.overruns; ++k) {
        loop_.missed_periods(k == 0 ? input.missed : 0);
      }
    }
  }

  void give_reference(const Record& record) {
    if constexpr (supervised) {
      if (record.input.posted) loop_.post(record.reference);
    } else {
      loop_.reference() = record.reference;
    }
  }

  void request([[maybe_unused]] LoopRequest request) {
    if constexpr (supervised) {
      if (request == LoopRequest::activation) loop_.request_activation();
      if (request == LoopRequest::deactivation) loop_.request_deactivation();
      if (request == LoopRequest::acknowledgement) loop_.acknowledge_fault();
    }
  }

  [[nodiscard]] std::optional<ReplayDifference> compare(const Record& record, Status status) const {
    ReplayDifference difference{.cycle = record.cycle, .time = record.time};
    const double time =
        static_cast<double>(first_period_ + periods_of(loop_.time())) * loop_.period();
    if (!has_same_bits(record.time, time)) {
      difference.quantity = "time";
      difference.recorded = record.time;
      difference.computed = time;
      return difference;
    }
    if (record.status != status) {
      difference.quantity = "status";
      difference.recorded = static_cast<double>(record.status);
      difference.computed = static_cast<double>(status);
      return difference;
    }
    const auto& command = loop_.command();
    if constexpr (supervised) {  // which keeps the last command where it writes none
      if (!loop_.hardware().written() && is_finite(command)) return std::nullopt;
    }
    return difference_of(loop_.hardware().robot(), difference, record.command, command);
  }

  const Recording<joint_count, Command>& recording_;
  ReplayedLoop loop_;
  std::size_t next_;             ///< index of the record that is computed next
  std::size_t next_change_ = 0;  ///< index of the change that is made next
  long long first_period_ = 0;   ///< of the recorded run, in which the replayed one begins
};

}  // namespace articula

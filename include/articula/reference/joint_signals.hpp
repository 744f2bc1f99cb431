// SPDX-License-Identifier: Apache-2.0
/// @file References from sums of signals on the joints of a robot.
#pragma once

#include "articula/core/name.hpp"
#include "articula/motion/joint_motion.hpp"
#include "articula/reference/joint_range.hpp"
#include "articula/reference/signal.hpp"
#include "articula/reference/signal_bounds.hpp"

#include <array>
#include <cstddef>
#include <initializer_list>
#include <span>
#include <variant>
#include <vector>

namespace articula {

/// The quantity to which a signal is added.
enum class SignalTarget : unsigned char {
  position,  ///< the reference's position, with its derivatives in velocity and acceleration
  effort,    ///< the reference's effort: open-loop excitation under Bypass, feed-forward elsewhere
};

/// A signal on a joint.
struct JointSignal {
  Name joint{};
  Signal signal{};
  SignalTarget target = SignalTarget::position;
};

/// The sum of any number of signals on each joint:
///
///     JointSignals<Q2d> waves({{"shoulder_active_joint", SineSignal{.amplitude = 0.5,
///                                                                   .frequency = 1}}});
///
/// Joints without a signal stay at `around`. A position outside the joint's limits is clamped to
/// the limit. Its velocity and acceleration are then 0. A time that is not finite gives NaN, which
/// a loop refuses.
/// @tparam Capacity  largest number of signals of all joints together
template <Robot R, int Capacity = 32>
class JointSignals {
 public:
  static constexpr int joint_count = articula::joint_count<R>;

  /// @param signals  in any order; those of one joint add up
  /// @param around   the reference to which they are added
  /// @throws std::invalid_argument if there are too many signals, a joint is unknown, a signal
  ///         cannot be evaluated or their sum overflows
  /// @throws std::invalid_argument if `around` is not finite or outside a joint's limits; the
  ///         messages name joint and signal where there is one
  JointSignals(const R& robot, std::span<const JointSignal> signals,
               const JointReference<joint_count>& around = {})
      : around_(around), range_(joint_range(robot)) {
    detail::check_positions(robot, "signals", around.position);
    if (!is_finite(around))
      detail::refuse({"signals: the reference to which they are added is not finite"});
    if (signals.size() > entries_.size()) {
      detail::refuse({"signals: ", signals.size(), " are more than the capacity, ", Capacity});
    }
    const auto sizes_of = [](const JointVector<joint_count>& x) {
      return for_each_joint<joint_count>([&](int j) noexcept { return std::abs(x[j]); });
    };
    JointReference<joint_count> peak{sizes_of(around.position), sizes_of(around.velocity),
                                     sizes_of(around.acceleration), sizes_of(around.effort)};
    for (const JointSignal& s : signals) {
      const auto fault = std::visit([](const auto& signal) { return signal.fault(); }, s.signal);
      if (!fault.empty()) {
        detail::refuse(
            {"signals: number ", size_ + 1, ", on joint '", s.joint.view(), "': ", fault});
      }
      const Entry entry{joint_index(robot, s.joint), s.signal, s.target};
      add(peak, entry, std::visit([](const auto& signal) { return signal.peak(); }, s.signal));
      if (!is_finite(peak)) {
        detail::refuse({"signals: number ", size_ + 1, ", on joint '", s.joint.view(),
                        "': the sum of the joint's signals overflows"});
      }
      entries_[size_++] = entry;
    }
    for (int j = 0; j < joint_count; ++j) {
      std::vector<Signal> own;
      for (const Entry& entry : std::span(entries_.data(), size_)) {
        if (entry.joint == j && entry.target == SignalTarget::position) own.push_back(entry.signal);
      }
      const ValueRange bounds = signal_bounds(own);
      lowest_[j] = bounds.lowest;
      highest_[j] = bounds.highest;
    }
  }
  JointSignals(const R& robot, std::initializer_list<JointSignal> signals,
               const JointReference<joint_count>& around = {})
      : JointSignals(robot, std::span(signals.begin(), signals.size()), around) {}
  /// For a robot known at compile time.
  explicit JointSignals(std::span<const JointSignal> signals,
                        const JointReference<joint_count>& around = {})
    requires DescribedRobot<R>
      : JointSignals(R(), signals, around) {}
  explicit JointSignals(std::initializer_list<JointSignal> signals,
                        const JointReference<joint_count>& around = {})
    requires DescribedRobot<R>
      : JointSignals(R(), signals, around) {}

  /// Adds the signals to another reference from now on.
  /// @param around  finite, within the joints' limits
  /// Real-time: yes.
  void set_around(const JointReference<joint_count>& around) noexcept { around_ = around; }
  /// The reference to which the signals are added. Real-time: yes.
  [[nodiscard]] const JointReference<joint_count>& around() const noexcept { return around_; }

  /// The least that the signals add to the positions [rad or m], N x 1; see signal_bounds.
  /// Real-time: yes.
  [[nodiscard]] const JointVector<joint_count>& lowest() const noexcept { return lowest_; }
  /// The most. Real-time: yes.
  [[nodiscard]] const JointVector<joint_count>& highest() const noexcept { return highest_; }
  /// The positions between which the signals move the joints, within the joints' limits.
  /// Real-time: yes.
  [[nodiscard]] JointRange<joint_count> range() const noexcept {
    JointRange<joint_count> range = range_;
    range.lower = range_.clamp(around_.position + lowest_);
    range.upper = range_.clamp(around_.position + highest_);
    return range;
  }

  /// The reference at a time [s]. Real-time: yes. O(N + number of signals).
  [[nodiscard]] JointReference<joint_count> sample(double time) const noexcept {
    if (!is_finite(time)) return detail::undefined_reference<joint_count>();
    JointReference<joint_count> reference = around_;
    for (std::size_t k = 0; k < size_; ++k) {
      const Entry& entry = entries_[k];
      const SignalValue x =
          std::visit([&](const auto& signal) { return signal.sample(time); }, entry.signal);
      add(reference, entry, x);
    }
    for (int j = 0; j < joint_count; ++j) {
      const double q = reference.position[j], lower = range_.lower[j], upper = range_.upper[j];
      if (!(q >= lower && q <= upper)) set_motion(reference, j, {q < lower ? lower : upper, 0, 0});
    }
    return reference;
  }

 private:
  struct Entry {
    int joint = 0;
    Signal signal{};
    SignalTarget target = SignalTarget::position;
  };

  static void add(JointReference<joint_count>& sum, const Entry& entry,
                  const SignalValue& x) noexcept {
    if (entry.target == SignalTarget::effort) {
      sum.effort[entry.joint] += x.value;
    } else {
      sum.position[entry.joint] += x.value;
      sum.velocity[entry.joint] += x.rate;
      sum.acceleration[entry.joint] += x.acceleration;
    }
  }

  JointReference<joint_count> around_;
  JointRange<joint_count> range_;
  JointVector<joint_count> lowest_ = JointVector<joint_count>::Zero(), highest_ = lowest_;
  std::array<Entry, static_cast<std::size_t>(Capacity)> entries_{};
  std::size_t size_ = 0;
};

}  // namespace articula

// SPDX-License-Identifier: Apache-2.0
/// @file Signals around a reference, for a time.
#pragma once

#include "articula/reference/joint_signals.hpp"
#include "articula/reference/joint_stops.hpp"

namespace articula::remote {

/// Signals around a reference. Joints that move stop first. In the loop's thread. Real-time: yes,
/// all functions but the constructor.
template <Robot R>
class SignalMotion {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using Reference = JointReference<joint_count>;

  /// @param limits  of the stop, as validate() accepts them
  SignalMotion(const R& robot, const MotionLimits<joint_count>& limits) noexcept
      : stop_(robot, JointVector<joint_count>::Zero(), limits) {}

  /// Begins with the stop.
  /// @param from      the present reference
  /// @param signals   valid until they have ended
  /// @param duration  of the signals [s]
  void begin(const Reference& from, JointSignals<R>& signals, double duration) noexcept {
    stop_.begin(from);
    signals_ = &signals;
    signals_->set_around({.position = from.position, .effort = from.effort});
    duration_ = duration;
    played_ = 0;
  }

  /// Moves on by a period [s].
  /// @param[out] reference  at its end; unchanged if the signals have ended
  /// @return                whether they go on
  [[nodiscard]] bool advance(double period, Reference& reference) noexcept {
    if (stop_.moves()) {
      reference = stop_.advance(period);
      signals_->set_around(reference);
      return true;
    }
    played_ += period;
    if (played_ >= duration_) return false;
    reference = signals_->sample(played_);
    return true;
  }

  /// The reference to which the signals are added. After `begin`.
  [[nodiscard]] const Reference& around() const noexcept { return signals_->around(); }
  /// Places the reference to which they are added, of a joint whose position they leave. After
  /// `begin`.
  /// @return whether they leave it
  bool place(int joint, double position) noexcept {
    const JointRange<joint_count> own = range();
    if (stop_.moves() || own.lower[joint] < own.upper[joint]) return false;
    Reference around = signals_->around();
    around.position[joint] = position;
    signals_->set_around(around);
    return true;
  }
  /// The positions between which they move the joints. After `begin`.
  [[nodiscard]] JointRange<joint_count> range() const noexcept { return signals_->range(); }

 private:
  JointStops<R> stop_;
  JointSignals<R>* signals_ = nullptr;
  double duration_ = 0;
  double played_ = 0;  ///< since the end of the stop [s]
};

}  // namespace articula::remote

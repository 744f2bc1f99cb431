// SPDX-License-Identifier: Apache-2.0
/// @file A controller as the sum of laws, within the drives' limits.
#pragma once

#include "articula/command/command_range.hpp"
#include "articula/control/composition/set_gains.hpp"
#include "articula/control/laws/control_law.hpp"
#include "articula/core/finite.hpp"
#include "articula/core/joint_command.hpp"
#include "articula/core/scalar.hpp"
#include "articula/model/robot.hpp"

#include <cstddef>
#include <limits>
#include <tuple>
#include <type_traits>
#include <utility>

namespace articula {

/// Adds up laws and limits the total: command = clamp(sum of laws), within the limits of the
/// robot's description. A controller of terms that act on the same joints is written in one line:
///
///     template <class R>
///     using PidAndFriction =
///         EffortController<R, PidLaw<joint_count<R>>, FrictionCompensation<R>>;
///
/// The laws learn in the next cycle what was cut off from the total. For limits of motion see
/// Limited, for different control modes Switch.
/// @tparam R     the robot
/// @tparam C     an EffortCommand, VelocityCommand or PositionCommand, over the laws' scalar
/// @tparam Laws  the summands
template <Robot R, class C, class... Laws>
  requires(ControlLaw<Laws, joint_count<R>, typename detail::CommandScalar<C>::Type> && ...)
class SumController {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using Command = C;
  using Scalar = typename detail::CommandScalar<C>::Type;
  using Input = ControlInput<joint_count, Scalar>;
  static_assert(JointCommand<C, joint_count, Scalar>);

  /// @param robot  whose limits hold
  /// @param laws   ready for use
  explicit SumController(const R& robot, Laws... laws)
      : range_(detail::command_range<C>(robot, std::numeric_limits<double>::max())),
        laws_(std::move(laws)...) {}

  /// Starts all laws. If a command was applied, laws that can, such as a PID, begin with what it
  /// holds beyond the other laws. Real-time: yes, if the laws' are.
  void start(const Input& in) noexcept {
    clip_.setZero();
    Input rest{in.state, in.reference, in.period, in.applied};
    for_each_law([&](auto& law) noexcept {
      using Law = std::remove_reference_t<decltype(law)>;
      if constexpr (!detail::SharesApplied<Law, joint_count, Scalar>) {
        start_law(law, in);
        if (!in.applied.reached_drives()) return;
        rest.applied.numbers -= law.output(Input{in.state, in.reference, in.period});
        start_law(law, in);  // forgets this output
      }
    });
    for_each_law([&](auto& law) noexcept {
      using Law = std::remove_reference_t<decltype(law)>;
      if constexpr (detail::SharesApplied<Law, joint_count, Scalar>)
        rest.applied.numbers -= law.start(rest);
    });
  }

  /// The limited total for the coming period. Real-time: yes, if the laws' are.
  [[nodiscard, gnu::always_inline]] Command update(const Input& in) noexcept {
    const Input inner{in.state, in.reference, in.period, in.applied, clip_ + in.cut};
    Vector total = Vector::Zero();
    for_each_law([&](auto& law) noexcept { total += law.output(inner); });
    Vector command;
    for (int j = 0; j < joint_count; ++j) {
      // A NaN passes, so that the loop finds it, and does not turn into a limit. A sum that
      // overflows has a direction, as any that is too large.
      command[j] = range_.clamp(total[j], j);
      clip_[j] = total[j] - command[j];
    }
    // A law integrates what was cut: neither a failed command nor an overflow may stay in its
    // memory.
    const MaskOf<Scalar> finite = is_finite(clip_);
    if (!all_of(finite)) {
      for (int j = 0; j < joint_count; ++j) clip_[j] = select(finite, clip_[j], Scalar(0));
    }
    return {command};
  }

  /// Goes on with other gains, in every law that takes them. Real-time: yes.
  template <class Gains>
    requires(TakesGains<Laws, Gains> || ...)
  void set_gains(const Gains& gains) noexcept {
    for_each_law([&](auto& law) noexcept {
      if constexpr (TakesGains<decltype(law), Gains>) articula::set_gains(law, gains);
    });
  }

  /// The laws as parts; see HasParts.
  static auto parts(auto& self) noexcept {
    return std::apply([](auto&... laws) { return std::tie(laws...); }, self.laws_);
  }

  /// One of the laws, by its type.
  template <class Law>
  [[nodiscard]] const Law& part() const noexcept {
    return std::get<Law>(laws_);
  }

 private:
  using Vector = JointVector<joint_count, Scalar>;

  template <class Law>
  static void start_law(Law& law, const Input& in) noexcept {
    if constexpr (detail::StartsLaw<Law, joint_count, Scalar>) law.start(in);
  }

  void for_each_law(auto function) noexcept {
    [&]<std::size_t... I>(std::index_sequence<I...>) noexcept {
      (function(std::get<I>(laws_)), ...);
    }(std::index_sequence_for<Laws...>());
  }

  detail::CommandRange<joint_count> range_;
  std::tuple<Laws...> laws_;
  Vector clip_ = Vector::Zero();  ///< of the last command, by the range
};

/// A controller of efforts as the sum of laws.
template <Robot R, class... Laws>
using EffortController = SumController<R, EffortCommand<joint_count<R>>, Laws...>;

/// A controller of velocity drives as the sum of laws.
template <Robot R, class... Laws>
using VelocityController = SumController<R, VelocityCommand<joint_count<R>>, Laws...>;

/// A controller of position drives as the sum of laws.
template <Robot R, class... Laws>
using PositionController = SumController<R, PositionCommand<joint_count<R>>, Laws...>;

}  // namespace articula

// SPDX-License-Identifier: Apache-2.0
/// @file The limits of each robot of a pack.
#pragma once

#include "articula/control/limits/command_limiter.hpp"
#include "articula/core/control_input.hpp"

#include <cstddef>
#include <utility>

namespace articula::detail {

/// One CommandLimiter for each robot whose numbers a scalar holds; one for double. Limits are
/// decisions, which differ by lane, so each lane is limited by itself.
/// @tparam Command  over S
template <Robot R, class Command, class S>
class LaneLimiters {
  static constexpr int N = joint_count<R>;
  using Vector = JointVector<N, S>;
  using Input = ControlInput<N, S>;
  using Limiter = CommandLimiter<R, decltype(lane_of(std::declval<const Command&>(), 0))>;

 public:
  LaneLimiters(const R& robot, const CommandLimits<N>& limits)
      : limiters_(copies(Limiter(robot, limits), std::make_index_sequence<lanes<S>>())) {}

  /// Begins at the measured state. Real-time: yes.
  void start(const Input& in) noexcept {
    for_each_lane(in, [&](int k, const ControlInput<N>& own) noexcept { limiters_[k].start(own); });
  }
  /// Keeps a command within the limits; returns the numbers of the result. Real-time: yes.
  Vector limit(const Input& in, Command& command) noexcept {
    return by_lane(in, command,
                   [](Limiter& limiter, auto&... own) noexcept { return limiter.limit(own...); });
  }
  /// Replaces a command by one that brakes all joints; likewise. Real-time: yes.
  Vector brake(const Input& in, Command& command) noexcept {
    return by_lane(in, command,
                   [](Limiter& limiter, auto&... own) noexcept { return limiter.brake(own...); });
  }

  [[nodiscard]] const CommandLimits<N>& limits() const noexcept { return limiters_[0].limits; }
  /// What the last call changed, of one robot.
  [[nodiscard]] LimitReport<N>& report(int lane) noexcept { return reports_[lane]; }
  [[nodiscard]] const LimitReport<N>& report(int lane) const noexcept { return reports_[lane]; }

 private:
  using Limiters = JointArray<Limiter, lanes<S>>;

  template <std::size_t... K>
  [[nodiscard]] static Limiters copies(const Limiter& one, std::index_sequence<K...>) {
    return {{(static_cast<void>(K), one)...}};
  }

  /// @param function  (limiter, input, command, report) -> numbers, all of one robot
  Vector by_lane(const Input& in, Command& command, const auto& function) noexcept {
    if constexpr (PackedScalar<S>) {
      Vector numbers;
      for_each_lane(in, [&](int k, const ControlInput<N>& own) noexcept {
        auto of_lane = lane_of(command, k);
        set_lane(numbers, k, function(limiters_[k], own, of_lane, reports_[k]));
        set_lane(command, k, of_lane);
      });
      return numbers;
    } else {
      return function(limiters_[0], in, command, reports_[0]);
    }
  }

  Limiters limiters_;
  JointArray<LimitReport<N>, lanes<S>> reports_{};
};

}  // namespace articula::detail

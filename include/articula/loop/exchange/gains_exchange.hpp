// SPDX-License-Identifier: Apache-2.0
/// @file New gains for a running controller, from another thread.
#pragma once

#include "articula/control/composition/set_gains.hpp"
#include "articula/control/laws/valid_gains.hpp"
#include "articula/core/joint_array.hpp"
#include "articula/core/name.hpp"
#include "articula/loop/exchange/latest_value.hpp"
#include "articula/model/robot.hpp"

#include <algorithm>

namespace articula {

/// Gives new gains to a controller that runs in another thread. For tuning while the robot moves. A
/// set is checked as a whole first. The controller has the old set or the new one, never a mixture
/// or a bad set. Of several offers between two cycles, the last one counts.
///
///     GainsExchange<PidGains, 2> exchange(Q2d{});
///     exchange.offer(gains);               // another thread: throws if the gains are bad
///     exchange.apply(loop.controller());   // the control thread, between two cycles
///
/// In the loop's own thread, call `set_gains(loop.controller(), gains)` instead.
/// @tparam G  the gains of one joint: PidGains, ImpedanceGains or your own, with `validate`
template <class G, int N>
class GainsExchange {
 public:
  using Gains = typename ValidGains<G, N>::Values;

  /// @param robot  whose joints the messages name
  template <Robot R>
    requires(joint_count<R> == N)
  explicit GainsExchange(const R& robot) {
    const auto names = joint_names(robot);
    std::copy(names.begin(), names.end(), names_.begin());
  }

  /// Checks gains and hands them over. For the one thread that sets gains; it does not wait.
  /// @throws std::invalid_argument with the reason, naming joint, gain and value; the controller
  ///         then keeps what it has
  /// Real-time: no (throws).
  void offer(const Gains& gains) {
    JointNames<N> names;
    std::copy(names_.begin(), names_.end(), names.begin());
    latest_.write(ValidGains<G, N>(gains, names));
  }

  /// Gives the controller the latest gains, if there are any that it does not have yet. For the
  /// control thread, between two cycles.
  /// @param controller  takes them, as `set_gains` says
  /// @return whether there were some
  /// Real-time: yes. Wait-free.
  template <class C>
  bool apply(C& controller) noexcept {
    if (!latest_.update()) return false;
    set_gains(controller, latest_.value());
    return true;
  }

 private:
  JointArray<Name, N> names_{};
  LatestValue<ValidGains<G, N>> latest_{};
};

}  // namespace articula

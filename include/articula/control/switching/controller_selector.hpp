// SPDX-License-Identifier: Apache-2.0
/// @file The selection of the active controller among several.
#pragma once

#include "articula/control/composition/controller_tuple.hpp"
#include "articula/control/safety/standby.hpp"
#include "articula/control/switching/switch_board.hpp"
#include "articula/control/switching/switch_options.hpp"

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace articula {

/// The selecting half of a Switch: its controllers, which of them is active, and what a request or
/// a failure changes about that. (The other half is BumplessTransfer.)
/// @tparam R            the robot
/// @tparam Controllers  one or more, all with the same type of command
template <Robot R, class... Controllers>
class ControllerSelector : public ControllerTuple<Controllers...> {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  static constexpr std::size_t controller_count = sizeof...(Controllers);
  using Scalar = detail::ScalarOfAll<Controllers...>;
  using Command = detail::CommandOfAll<articula::joint_count<R>, Controllers...>;

  /// Requests that controllers start and stop with the next update. In the thread of the update.
  /// Real-time: yes.
  SwitchOutcome request(const SwitchRequest& request) noexcept { return board_.plan(request); }

  /// The name of a controller, by its index in the list. Real-time: yes.
  [[nodiscard]] const Name& name_of(std::size_t controller) const noexcept {
    return board_.entries[controller].name;
  }
  /// What a controller is doing. Real-time: yes.
  [[nodiscard]] ControllerStatus status_of(std::size_t controller) const noexcept {
    return statuses_[controller];
  }
  /// Real-time: yes.
  [[nodiscard]] bool is_active(std::size_t controller) const noexcept {
    return controller == active_;
  }
  /// The name of the active controller; empty if there is none. Real-time: yes.
  [[nodiscard]] Name active() const noexcept { return active_ == none ? Name() : name_of(active_); }
  /// All controllers and what they are doing. Real-time: yes.
  [[nodiscard]] std::array<ControllerInfo, controller_count> list() const noexcept {
    std::array<ControllerInfo, controller_count> all;
    for (std::size_t i = 0; i < controller_count; ++i) all[i] = {name_of(i), status_of(i)};
    return all;
  }
  /// The plan of which controllers are active, for compositions such as Groups. Real-time: yes.
  [[nodiscard]] SwitchBoard<controller_count>& board() noexcept { return board_; }
  [[nodiscard]] const SwitchBoard<controller_count>& board() const noexcept { return board_; }

 protected:
  static constexpr std::size_t none = controller_count;

  ControllerSelector(const R& robot, const SwitchOptions<joint_count>& options,
                     Controllers... controllers)
      : ControllerTuple<Controllers...>(std::move(controllers)...),
        standby_(robot, options.damping_time) {
    std::size_t index = 0;
    board_.set_names(options.names, {detail::own_name<Controllers>(index++)...});
    for (const Fallback& fallback : options.fallbacks) {
      std::vector<std::size_t>& own = fallbacks_[board_.known(fallback.controller)];
      for (const Name& name : fallback.instead) {
        if (name == fallback.controller) board_.refuse("it is its own fallback: ", name);
        own.push_back(board_.known(name));
      }
    }
    const Name first = options.active.value_or(board_.entries[0].name);
    if (!first.empty()) board_.entries[board_.known(first)].active = true;
    activate(planned());
  }

  /// The active controller, or none.
  [[nodiscard]] std::size_t active_index() const noexcept { return active_; }
  /// The controller that shall be active, or none.
  [[nodiscard]] std::size_t planned() const noexcept { return board_.active_in(0); }
  /// Whether the next update starts a controller: another one, or the active one again.
  [[nodiscard]] bool switches() const noexcept {
    return planned() != active_ || (active_ != none && board_.entries[active_].restart);
  }
  [[nodiscard]] const std::vector<std::size_t>& fallbacks_of(std::size_t index) const noexcept {
    return fallbacks_[index];
  }

  /// Makes a controller the active one.
  void activate(std::size_t index) noexcept {
    if (active_ != none && statuses_[active_] == ControllerStatus::active) {
      statuses_[active_] = ControllerStatus::inactive;
    }
    active_ = index;
    for (std::size_t i = 0; i < controller_count; ++i) {
      board_.entries[i].active = i == index;
      board_.entries[i].restart = false;
    }
    set_status(index, ControllerStatus::active);
  }
  void set_status(std::size_t index, ControllerStatus status) noexcept {
    if (index != none) statuses_[index] = status;
  }

  /// Calls function(controller) for one of the controllers, or for the Standby in place of none.
  void visit(std::size_t index, auto function) noexcept {
    if (index == none) return function(standby_);
    this->for_each([&](auto& controller, std::size_t i) noexcept {
      if (i == index) function(controller);
    });
  }

 private:
  Standby<R, Command> standby_;
  SwitchBoard<controller_count> board_{};
  std::array<std::vector<std::size_t>, controller_count> fallbacks_{};
  std::array<ControllerStatus, controller_count> statuses_{};
  std::size_t active_ = none;
};

}  // namespace articula

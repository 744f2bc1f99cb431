// SPDX-License-Identifier: Apache-2.0
/// @file Starts and stops controllers of a running loop from another thread.
#pragma once

#include "articula/control/switching/switch_board.hpp"
#include "articula/control/switching/switch_request.hpp"
#include "articula/core/inline_sequence.hpp"
#include "articula/loop/exchange/event_ring.hpp"
#include "articula/loop/exchange/latest_value.hpp"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <thread>

namespace articula {

/// The answer to the request of this number.
struct NumberedOutcome {
  std::uint64_t request = 0;
  SwitchOutcome outcome{};
};

/// A change of one controller's status: by a request, by a failure, or as the fallback of a
/// controller that failed.
struct SwitchEvent {
  Name controller{};
  ControllerStatus before = ControllerStatus::inactive;
  ControllerStatus after = ControllerStatus::inactive;
};

/// Switches controllers of a loop that runs in another thread. For a program whose operator changes
/// the control mode while the robot moves:
///
///     SwitchExchange exchange(loop.controller());   // before the threads begin
///     auto outcome = exchange.ask({.stop = {"pid"}, .start = {"bypass"}});  // operating thread
///     for (const ControllerInfo& controller : exchange.list()) ...          // operating thread
///     exchange.apply(loop.controller());            // control thread, between two cycles
///
/// One operating thread makes requests. It gets their outcomes, the controllers' status, and
/// events. Only `ask` waits for the control thread. The control thread never waits.
///
/// Do not use it in the loop's own thread: call `request` of the Switch or Groups there. For an
/// operator in a browser or in another program, use a remote::Remote.
/// @tparam Count  number of controllers
template <std::size_t Count>
class SwitchExchange {
 public:
  static constexpr std::size_t capacity = 16;  ///< requests, outcomes, and events not yet taken

  /// @param controller  a Switch or Groups, or a Limited one
  template <class C>
    requires(detail::switch_size<C> == Count)
  explicit SwitchExchange(const C& controller)
      : infos_(switch_in(controller).list()), statuses_(infos_) {}

  // For the one thread that switches:

  /// Hands a request over.
  /// @return  its number, from 1; 0 if 16 requests wait for the control thread already
  /// Real-time: yes. Wait-free.
  std::uint64_t request(const SwitchRequest& request) noexcept {
    if (!requests_.push({last_request_ + 1, request})) return 0;
    return ++last_request_;
  }

  /// The oldest outcome that was not taken yet. Outcomes have the order of the requests. Where 16
  /// wait, later ones are dropped. Real-time: yes. Wait-free.
  [[nodiscard]] std::optional<NumberedOutcome> outcome() noexcept {
    NumberedOutcome next;
    if (!outcomes_.pop(next)) return std::nullopt;
    return next;
  }

// WebAssembly without threads has no control thread to wait for.
#if !defined(__wasi__) || defined(_REENTRANT)
  /// Hands a request over and waits for its outcome. Outcomes of earlier requests are dropped.
  /// @param patience  how long to wait for the control thread
  /// @return          nothing if it took longer; the request may still be done later
  /// Real-time: no (waits).
  std::optional<SwitchOutcome> ask(const SwitchRequest& wish, std::chrono::milliseconds patience =
                                                                  std::chrono::milliseconds(1000)) {
    const auto end = std::chrono::steady_clock::now() + patience;
    while (outcome()) {  // or there may be no room for the one that is waited for
    }
    std::uint64_t number = 0;
    for (;;) {
      if (number == 0) number = request(wish);
      while (const auto next = outcome()) {
        if (next->request == number) return next->outcome;
      }
      if (std::chrono::steady_clock::now() > end) return std::nullopt;
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
  }
#endif

  /// All controllers and their status at the last `apply`. Real-time: yes. Wait-free.
  [[nodiscard]] const std::array<ControllerInfo, Count>& list() noexcept {
    if (published_.update()) infos_ = published_.value();
    return infos_;
  }

  /// The oldest event that was not taken yet. Where 16 wait, later ones are dropped.
  /// Real-time: yes. Wait-free.
  [[nodiscard]] std::optional<SwitchEvent> event() noexcept {
    SwitchEvent next;
    if (!events_.pop(next)) return std::nullopt;
    return next;
  }

  // For the control thread:

  /// Passes requests on to the controller and publishes its status. Call it between two cycles. The
  /// next call hands the outcomes over, so `list` and `event` then include the cycle in between. A
  /// group with a divisor starts and stops controllers in its own next cycle. `list` and `event`
  /// show them after that cycle.
  /// @return  whether a controller started, stopped or failed since the last call
  /// Real-time: yes. Wait-free.
  template <class C>
    requires(detail::switch_size<C> == Count)
  bool apply(C& controller) noexcept {
    auto& controllers = switch_in(controller);
    const std::array<ControllerInfo, Count> now = controllers.list();
    bool changed = false;
    for (std::size_t i = 0; i < Count; ++i) {
      if (now[i].status == statuses_[i].status) continue;
      events_.push({now[i].name, statuses_[i].status, now[i].status});
      changed = true;
    }
    if (changed) published_.write(now);
    statuses_ = now;
    // The outcomes of the last call's requests, now that the list shows what that cycle made of
    // them.
    for (const NumberedOutcome& outcome : decided_) outcomes_.push(outcome);
    decided_.clear();
    NumberedRequest next;
    while (decided_.size() < capacity && requests_.pop(next)) {
      decided_.push_back({next.number, controllers.request(next.request)});
    }
    return changed;
  }

 private:
  struct NumberedRequest {
    std::uint64_t number = 0;
    SwitchRequest request{};
  };

  // The switching thread's:
  std::uint64_t last_request_ = 0;
  std::array<ControllerInfo, Count> infos_;
  // The control thread's:
  alignas(64) std::array<ControllerInfo, Count> statuses_;
  InlineSequence<NumberedOutcome, capacity> decided_{};  ///< and not handed over yet
  // Between them:
  EventRing<NumberedRequest, capacity> requests_{};
  EventRing<NumberedOutcome, capacity> outcomes_{};
  EventRing<SwitchEvent, capacity> events_{};
  LatestValue<std::array<ControllerInfo, Count>> published_{};
};

/// An exchange for a controller has the size that it takes.
template <class C>
SwitchExchange(const C&) -> SwitchExchange<detail::switch_size<C>>;

}  // namespace articula

// SPDX-License-Identifier: Apache-2.0
/// @file A loop that runs inside of the page that shows it.
#pragma once

#include "articula/loop/run_report.hpp"
#include "articula/remote/remote.hpp"
#include "articula/view/server/clients/broadcast.hpp"
#include "articula/view/server/clients/client.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace articula::view {

/// A loop and the view's side of one connection, without threads and sockets: frames in, frames
/// out. Its time passes only by calls. A page that runs it as WebAssembly needs no server.
/// Everything depends on the calls alone, so the same calls give the same bits in a page and
/// natively; durations are not measured.
class LiveLoop {
 public:
  virtual ~LiveLoop() = default;

  /// Lets time pass: makes the loop's cycles, and sends what is new.
  /// @param seconds  since the last call; a fraction of a period counts next time [s]
  /// @param wall     the time of the day, for time stamps [ns]
  virtual void advance(double seconds, WallTime wall) = 0;
  /// A frame came from the page. Any bytes may come.
  void receive(bool is_text, std::string_view bytes) { client().receive(is_text, bytes); }
  /// The frame to be sent next, if there is one.
  [[nodiscard]] std::optional<Frame> take() { return client().take(); }

 protected:
  [[nodiscard]] virtual Client& client() = 0;
};

/// The LiveLoop of a loop, which is active from the beginning.
/// @tparam LoopType  a Loop or SupervisedLoop; with simulated hardware there is something to see
template <class LoopType>
class LiveLoopOf final : public LiveLoop {
 public:
  /// The longest time that passes at once: a page that was hidden does not catch up [s].
  static constexpr double longest_step = 0.1;

  /// @param arguments  of the loop
  /// @throws what the loop throws
  template <class... Arguments>
  explicit LiveLoopOf(Arguments&&... arguments) : loop_(std::forward<Arguments>(arguments)...) {
    broadcast_.add(client_);
    if constexpr (requires { loop_.request_activation(); }) loop_.request_activation();
  }
  ~LiveLoopOf() override { broadcast_.remove(client_); }
  LiveLoopOf(const LiveLoopOf&) = delete;
  LiveLoopOf& operator=(const LiveLoopOf&) = delete;

  void advance(double seconds, WallTime wall) override {
    client_.alive();
    due_ += std::clamp(seconds, 0.0, longest_step) / loop_.period();
    for (; due_ >= 1; due_ -= 1) {
      report_.status = remote_.update();
      ++report_.cycles;
      remote_.report(report_);
    }
    passed_ += std::chrono::nanoseconds(std::llround(std::fmax(seconds, 0) * 1e9));
    broadcast_.tick(Client::TimePoint(passed_), wall);
  }

 private:
  [[nodiscard]] Client& client() override { return client_; }

  // A slow page is still there: nobody else could operate this loop.
  static constexpr double patience = 1e6;  // [s]

  LoopType loop_;
  remote::Remote<LoopType> remote_{loop_, {.operator_lifetime = patience, .answer_time = patience}};
  ViewOptions options_{.operates = true};
  Broadcast broadcast_{remote_};
  FuturesDesk futures_{remote_};
  Client client_{remote_, futures_, broadcast_.latest(), options_, "this page"};
  RunReport report_{};
  double due_ = 0;  ///< cycles; a fraction of one is left for the next time
  std::chrono::nanoseconds passed_{3'600'000'000'000};  ///< of the clock, which begins anywhere
};

}  // namespace articula::view

namespace articula {

/// The loop of a page. The program of a page defines it, and nothing else:
///
///     std::unique_ptr<articula::view::LiveLoop> articula::live_loop() {
///       return live<SupervisedLoop<Q2dSim, PidPlusGravity>>();
///     }
[[nodiscard]] std::unique_ptr<view::LiveLoop> live_loop();

/// A loop for a page.
/// @param arguments  of the loop
template <class LoopType, class... Arguments>
[[nodiscard]] std::unique_ptr<view::LiveLoop> live(Arguments&&... arguments) {
  return std::make_unique<view::LiveLoopOf<LoopType>>(std::forward<Arguments>(arguments)...);
}

}  // namespace articula

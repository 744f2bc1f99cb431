// SPDX-License-Identifier: Apache-2.0
/// @file A simulated Q2D that runs in real time and can be reached through its view.
#pragma once

#include "terminal.hpp"

#include <articula/articula.hpp>
#include <articula/loop/realtime/monotonic_clock.hpp>
#include <articula/remote/remote.hpp>
#include <articula/robots/q2d.hpp>
#include <articula/view/view.hpp>

#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace support {

template <class R>
using ArmControllers = articula::Switch<R, articula::PidPlusGravity<R>, articula::Bypass<R>>;

/// The loop runs until the end of this object. It is active from the first cycle on.
class RunningArm {
 public:
  explicit RunningArm(articula::ViewOptions options = {.operates = true})
      : view_(remote_, with_free_port(std::move(options))) {
    loop_.request_activation();
    thread_ = std::thread([this] {
      articula::MonotonicClock clock;
      remote_.run(clock, {.stop = &stop_});
    });
  }
  ~RunningArm() {
    stop_.request();
    thread_.join();
  }
  RunningArm(const RunningArm&) = delete;
  RunningArm& operator=(const RunningArm&) = delete;

  /// Runs articula for this loop, with JSON as its output.
  [[nodiscard]] Result ask(std::vector<std::string> words) const {
    words.insert(words.begin(), {"--json", "--port", std::to_string(view_.port())});
    return run_articula(std::move(words));
  }
  [[nodiscard]] articula::Remote<articula::SupervisedLoop<articula::Q2dSim, ArmControllers>>&
  remote() {
    return remote_;
  }
  [[nodiscard]] std::string port() const { return std::to_string(view_.port()); }

 private:
  [[nodiscard]] static articula::ViewOptions with_free_port(articula::ViewOptions options) {
    options.port = 0;
    return options;
  }

  // A busy machine must not end the loop by overruns.
  articula::SupervisedLoop<articula::Q2dSim, ArmControllers> loop_{
      articula::SupervisionOptions{.overruns = 1000000}};
  articula::Remote<articula::SupervisedLoop<articula::Q2dSim, ArmControllers>> remote_{loop_};
  articula::View view_;
  articula::StopFlag stop_;
  std::thread thread_;
};

}  // namespace support

// SPDX-License-Identifier: Apache-2.0
/// @file A progress line for long runs.
#pragma once

#include <chrono>
#include <iostream>
#include <string>
#include <utility>

namespace articula::examples {

/// One line on standard error, rewritten a few times a second. Less than a second shows nothing.
class Progress {
 public:
  /// @param what  name of the run
  explicit Progress(std::string what) : what_(std::move(what)) {}
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress() {
    if (shown_) std::cerr << '\n';
  }

  /// @param share  of the work that is done, 0 to 1
  void update(double share) {
    const auto now = std::chrono::steady_clock::now();
    if (now < next_ && !(shown_ && share >= 1)) return;
    next_ = now + std::chrono::milliseconds(200);
    shown_ = true;
    std::cerr << '\r' << what_ << ": " << static_cast<int>(100 * share) << " %" << std::flush;
  }

 private:
  std::string what_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point next_ =
      std::chrono::steady_clock::now() + std::chrono::seconds(1);
};

}  // namespace articula::examples

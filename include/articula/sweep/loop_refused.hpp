// SPDX-License-Identifier: Apache-2.0
/// @file The error of a loop of a sweep that cannot be set up.
#pragma once

#include <stdexcept>

namespace articula::detail {

/// A run's numbers are refused by the simulator or the controller. It differs from other errors of
/// a run, such as those of one's own metrics: the sweep counts the run, and goes on.
struct LoopRefused : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// Sets up a part of a loop.
/// @param make  returns it
/// @throws LoopRefused in the place of std::invalid_argument, with its text
template <class Make>
[[nodiscard]] auto set_up(const Make& make) {
  try {
    return make();
  } catch (const std::invalid_argument& error) {
    throw LoopRefused(error.what());
  }
}

}  // namespace articula::detail

// SPDX-License-Identifier: Apache-2.0
/// @file Waveforms from a configuration file.
#pragma once

#include "articula/reference/joint_signals.hpp"

#include <string>
#include <vector>

namespace articula {

/// Waveforms from a file.
struct SignalConfig {
  std::vector<JointSignal> signals{};  ///< for JointSignals
  /// Parameters without effect in this library, one line each with file, line and key.
  std::vector<std::string> notes{};
};

}  // namespace articula

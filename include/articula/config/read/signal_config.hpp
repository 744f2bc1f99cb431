// SPDX-License-Identifier: Apache-2.0
/// @file Waveforms as a configuration file has them.
#pragma once

#include "articula/reference/joint_signals.hpp"

#include <string>
#include <vector>

namespace articula {

/// Waveforms from a file.
struct SignalConfig {
  std::vector<JointSignal> signals{};  ///< for JointSignals
  /// What the file says and nothing here does, one line each with file, line and key.
  std::vector<std::string> notes{};
};

}  // namespace articula

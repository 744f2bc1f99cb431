// SPDX-License-Identifier: Apache-2.0
/// @file A controller's command with its verdict on it.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/scalar.hpp"

namespace articula {

/// How good a command is.
enum class Verdict : unsigned char {
  fine,      ///< It is what the controller was made for.
  degraded,  ///< A part of the controller has failed. The command is safe and is written.
  failed,    ///< There is no command. The caller puts a safe one in its place.
};

/// The result of a controller: a command and a verdict. A plain command converts to it, so
/// controllers that cannot fail return commands. A command that is not finite has failed. Robots of
/// a pack share the verdict: where one's command is not finite, that of all has failed.
/// @tparam Command  an EffortCommand, PositionCommand, VelocityCommand or MultiModeCommand
template <class Command>
struct Outcome {
  Command command{};
  Verdict verdict = Verdict::failed;

  /// No command. Real-time: yes.
  Outcome() = default;
  /// Real-time: yes.
  Outcome(const Command& own, Verdict own_verdict = Verdict::fine) noexcept  // NOLINT: implicit
      : command(own), verdict(all_of(is_finite(own)) ? own_verdict : Verdict::failed) {}
};

}  // namespace articula

// SPDX-License-Identifier: Apache-2.0
/// @file A request to start and stop controllers, and its answer.
#pragma once

#include "articula/core/inline_sequence.hpp"
#include "articula/core/name.hpp"

#include <initializer_list>
#include <span>
#include <stdexcept>
#include <string_view>

namespace articula {

/// What happens to a request of which some part is impossible.
enum class Strictness : unsigned char {
  strict,       ///< The whole request is refused.
  best_effort,  ///< The possible parts are done.
};

/// The names of up to 16 controllers, without heap memory: a control thread can copy them.
class ControllerNames : private InlineSequence<Name, 16> {
 public:
  using InlineSequence::begin, InlineSequence::capacity, InlineSequence::end;

  constexpr ControllerNames() = default;
  /// @throws std::length_error if there are more than `capacity`
  constexpr ControllerNames(std::initializer_list<Name> names)
      : ControllerNames(std::span(names.begin(), names.size())) {}
  /// @copydoc ControllerNames(std::initializer_list<Name>)
  constexpr explicit ControllerNames(std::span<const Name> names) {
    if (names.size() > capacity)
      throw std::length_error("a request names at most 16 controllers to start, or stop");
    for (const Name& name : names) push_back(name);
  }
};

/// Starts and stops controllers of a Switch or Groups, all in the same cycle. For a robot that
/// changes from one control mode to another:
///
///     loop.controller().request({.stop = {"pid"}, .start = {"computed_torque"}});
///
/// - The controllers in `stop` stop first, then those in `start` start. A controller in both lists
///   is restarted.
/// - Each list has at most 16 names (ControllerNames::capacity). For more names, make several
///   requests between two cycles: they take effect together.
///
/// From another thread than the loop's, hand the request to a SwitchExchange. For new gains of a
/// controller that goes on, use a GainsExchange and no request.
struct SwitchRequest {
  ControllerNames stop{};
  ControllerNames start{};
  Strictness strictness = Strictness::strict;
  bool replace = false;  ///< what starts also stops the controller that is active on its joints
};

/// Whether a request was done, or the reason why it was not.
enum class SwitchAnswer : unsigned char {
  done,            ///< The whole request takes effect in the next good cycle.
  unknown_name,    ///< No controller has this name.
  already_active,  ///< The controller to start is active already.
  not_active,      ///< The controller to stop is not active.
  occupied,        ///< Another controller stays active on the joints of the controller to start.
};

/// The answer to a request. A refused strict request changes nothing.
struct [[nodiscard]] SwitchOutcome {
  SwitchAnswer answer = SwitchAnswer::done;  ///< done, or the first obstacle
  Name controller{};                         ///< the controller of that obstacle, else empty
  int started = 0;                           ///< how many controllers start
  int stopped = 0;                           ///< how many controllers stop
};

/// Whether one of several controllers is in use.
enum class ControllerStatus : unsigned char {
  inactive,  ///< It is not called.
  active,    ///< It makes the command.
  failed,    ///< Its last outcome was a failure. Without a fallback, it is called again.
};

/// One entry of a list of controllers.
struct ControllerInfo {
  Name name{};
  ControllerStatus status = ControllerStatus::inactive;
};

/// The answer in words. Real-time: yes.
[[nodiscard]] constexpr std::string_view to_string(SwitchAnswer answer) noexcept {
  switch (answer) {
    case SwitchAnswer::done:
      return "done";
    case SwitchAnswer::unknown_name:
      return "unknown name";
    case SwitchAnswer::already_active:
      return "already active";
    case SwitchAnswer::not_active:
      return "not active";
    case SwitchAnswer::occupied:
      return "another controller of these joints is active or starts, too; stop it or replace it";
  }
  return "unknown answer";
}

/// The status in words. Real-time: yes.
[[nodiscard]] constexpr std::string_view to_string(ControllerStatus status) noexcept {
  switch (status) {
    case ControllerStatus::inactive:
      return "inactive";
    case ControllerStatus::active:
      return "active";
    case ControllerStatus::failed:
      return "failed";
  }
  return "unknown status";
}

}  // namespace articula

// SPDX-License-Identifier: Apache-2.0
/// @file Requests to a set of controllers, and their outcomes.
#pragma once

#include "articula/core/name.hpp"

#include <array>
#include <cstddef>
#include <initializer_list>
#include <span>
#include <stdexcept>
#include <string_view>

namespace articula {

/// What a request is worth of which some part cannot be done.
enum class Strictness : unsigned char {
  strict,       ///< Nothing: it is refused as a whole.
  best_effort,  ///< The rest of it, which is done.
};

/// A few names in place, so that a request can be handed to another thread without heap memory.
class ControllerNames {
 public:
  static constexpr std::size_t capacity = 16;

  constexpr ControllerNames() = default;
  /// @throws std::length_error if there are more than `capacity`
  constexpr ControllerNames(std::initializer_list<Name> names)
      : ControllerNames(std::span(names.begin(), names.size())) {}
  /// @copydoc ControllerNames(std::initializer_list<Name>)
  constexpr explicit ControllerNames(std::span<const Name> names) {
    if (names.size() > capacity)
      throw std::length_error("a request names at most 16 controllers to start, or stop");
    for (const Name& name : names) names_[size_++] = name;
  }

  [[nodiscard]] constexpr const Name* begin() const noexcept { return names_.data(); }
  [[nodiscard]] constexpr const Name* end() const noexcept { return names_.data() + size_; }

 private:
  std::array<Name, capacity> names_{};
  std::size_t size_ = 0;
};

/// What shall start and stop, all of it in one cycle. First the controllers in `stop` stop, then
/// those in `start` start: one that is in both is restarted. Each list has at most 16 names
/// (ControllerNames::capacity); beyond that, several requests between two cycles have effect
/// together.
struct SwitchRequest {
  ControllerNames stop{};
  ControllerNames start{};
  Strictness strictness = Strictness::strict;
  bool replace = false;  ///< what is active on the same joints stops for what starts, named or not
};

/// What became of a request, or why not.
enum class SwitchAnswer : unsigned char {
  done,            ///< All of it is done, with the next cycle that goes well.
  unknown_name,    ///< No controller has this name.
  already_active,  ///< This controller shall start, and is active.
  not_active,      ///< This controller shall stop, and is not active.
  occupied,  ///< This controller shall start, but another is active on its joints and stays so.
};

/// The answer to a request. Of a strict request that was refused nothing is done.
struct SwitchOutcome {
  SwitchAnswer answer = SwitchAnswer::done;  ///< done, or the first thing that cannot be done
  Name controller{};                         ///< which it is about; empty if all is done
  int started = 0;                           ///< how many controllers start
  int stopped = 0;                           ///< how many controllers stop
};

/// What a controller among several is doing.
enum class ControllerStatus : unsigned char {
  inactive,  ///< It is not asked.
  active,    ///< It makes the command.
  failed,    ///< Its last command was no command. If it has no fallback, it is asked again.
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
      return "another controller is active on these joints";
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

// SPDX-License-Identifier: Apache-2.0
/// @file The choice of active controllers: requests checked and planned.
#pragma once

#include "articula/control/composition/parts.hpp"
#include "articula/control/switching/switch_request.hpp"
#include "articula/core/refuse.hpp"
#include "articula/text/similar_word.hpp"

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

namespace articula {

/// Decides which of several controllers are active after a request. Switch and Groups contain one.
/// It has names and no controllers:
///
///     const SwitchOutcome outcome = board.plan({.start = {"bypass"}, .replace = true});
///     if (outcome.answer == SwitchAnswer::done) ...   // the entries are those of the next cycle
///
/// Controllers for the same joints are in the same group. At most one controller of a group is
/// active. To switch the controllers of a loop, use a Switch or Groups. Use a board only in a
/// controller of your own that holds several.
/// @tparam Count  number of controllers
template <std::size_t Count>
class SwitchBoard {
 public:
  struct Entry {
    Name name{};
    int group = 0;
    bool active = false;   ///< whether the controller is active from the next cycle on
    bool restart = false;  ///< whether it starts in the next cycle, even if it was active before
  };

  std::array<Entry, Count> entries{};

  /// Names all controllers.
  /// @param names     one for each controller; if the list is empty, `defaults` count
  /// @param defaults  the controllers' own names; a name that occurs again gets a number
  /// @throws std::invalid_argument if the number of names is wrong, or a name is empty or occurs
  ///         twice
  void set_names(const std::vector<Name>& names, const std::array<Name, Count>& defaults) {
    if (!names.empty() && names.size() != Count) {
      detail::refuse({"switch: SwitchOptions::names has ", names.size(), " names for ", Count,
                      " controllers; name each of them, or leave the list empty"});
    }
    for (std::size_t i = 0; i < Count; ++i) {
      Name name = names.empty() ? defaults[i] : names[i];
      for (int number = 2; names.empty() && find(name) < i; ++number) {
        name = with_suffix(defaults[i], number);
      }
      entries[i].name = name;
    }
    validate();
  }

  /// @throws std::invalid_argument if a name is empty or occurs twice
  void validate() const {
    for (std::size_t i = 0; i < Count; ++i) {
      if (entries[i].name.empty()) {
        detail::refuse({"switch: controller ", i + 1, " has no name"});
      }
      if (find(entries[i].name) != i) refuse("two controllers are named ", entries[i].name);
    }
  }

  /// @throws std::invalid_argument with this message and the name
  [[noreturn]] static void refuse(std::string_view what, const Name& name) {
    detail::refuse({"switch: ", what, "'", name.view(), "'"});
  }

  /// The index of a controller.
  /// @throws std::invalid_argument if none has this name
  [[nodiscard]] std::size_t known(const Name& name) const {
    const std::size_t i = find(name);
    if (i != Count) return i;
    std::vector<std::string_view> names;
    for (const Entry& entry : entries) names.push_back(entry.name.view());
    detail::refuse({"switch: there is no controller '", name.view(), "'",
                    detail::choice_of(name.view(), "controllers", names)});
  }

  /// The index of a controller, or Count if none has this name. Real-time: yes.
  [[nodiscard]] std::size_t find(const Name& name) const noexcept {
    std::size_t i = 0;
    while (i < Count && !(entries[i].name == name)) ++i;
    return i;
  }

  /// The index of a group's active controller, or Count. Real-time: yes.
  [[nodiscard]] std::size_t active_in(int group) const noexcept {
    std::size_t i = 0;
    while (i < Count && !(entries[i].active && entries[i].group == group)) ++i;
    return i;
  }

  /// Plans a request. Of a best-effort request, it plans the possible parts. A strict request with
  /// an impossible part changes nothing.
  /// Real-time: yes.
  [[nodiscard]] SwitchOutcome plan(const SwitchRequest& request) noexcept {
    SwitchBoard planned = *this;
    SwitchOutcome outcome;
    const auto object = [&](SwitchAnswer answer, const Name& name) {
      if (outcome.answer != SwitchAnswer::done) return;
      outcome.answer = answer;
      outcome.controller = name;
    };
    for (const Name& name : request.stop) {
      const std::size_t i = find(name);
      if (i == Count) {
        object(SwitchAnswer::unknown_name, name);
      } else if (!planned.entries[i].active) {
        object(SwitchAnswer::not_active, name);
      } else {
        planned.entries[i].active = false;
        ++outcome.stopped;
      }
    }
    std::array<bool, Count> starts{};
    for (const Name& name : request.start) {
      const std::size_t i = find(name);
      if (i == Count) {
        object(SwitchAnswer::unknown_name, name);
        continue;
      }
      if (planned.entries[i].active) {
        object(SwitchAnswer::already_active, name);
        continue;
      }
      const std::size_t other = planned.active_in(entries[i].group);
      if (other != Count && (!request.replace || starts[other])) {
        object(SwitchAnswer::occupied, name);
        continue;
      }
      if (other != Count) {
        planned.entries[other].active = false;
        ++outcome.stopped;
      }
      planned.entries[i].active = planned.entries[i].restart = starts[i] = true;
      ++outcome.started;
    }
    const bool refused =
        request.strictness == Strictness::strict && outcome.answer != SwitchAnswer::done;
    if (refused) {
      outcome.started = outcome.stopped = 0;
    } else {
      *this = planned;
    }
    return outcome;
  }

 private:
  [[nodiscard]] static Name with_suffix(const Name& name, int number) {
    return detail::message_of({name.view(), "_", number});
  }
};

/// A controller that contains several controllers and takes requests to switch: Switch, Groups.
template <class C>
concept Switching = requires(C controller, const SwitchRequest& request) {
  { controller.request(request) } noexcept -> std::same_as<SwitchOutcome>;
  { controller.list() } noexcept -> std::same_as<std::array<ControllerInfo, C::controller_count>>;
};

namespace detail {

/// A controller's own name, that of its one part, or one by its index in a list.
template <class C>
[[nodiscard]] Name own_name(std::size_t index) {
  if constexpr (requires { C::name; }) {
    return C::name;
  } else if constexpr (HasParts<C>) {
    if constexpr (std::tuple_size_v<PartsOf<C>> == 1) {
      return own_name<std::remove_cvref_t<std::tuple_element_t<0, PartsOf<C>>>>(index);
    }
  }
  return message_of({"controller_", index + 1});
}

/// How many controllers can be switched in a controller: in itself, or in its parts.
template <class C>
[[nodiscard]] consteval std::size_t count_switched() {
  if constexpr (Switching<C>) {
    return C::controller_count;
  } else if constexpr (HasParts<C>) {
    return []<class... Parts>(std::type_identity<std::tuple<Parts...>>) {
      return (count_switched<std::remove_cvref_t<Parts>>() + ... + std::size_t{0});
    }(std::type_identity<PartsOf<C>>());
  } else {
    return 0;
  }
}

template <class C>
inline constexpr std::size_t switch_size = count_switched<C>();

/// Which of several parts has the controllers that can be switched.
template <class... Parts>
[[nodiscard]] consteval std::size_t index_of_switch(std::type_identity<std::tuple<Parts...>>) {
  const std::array<bool, sizeof...(Parts)> have{switch_size<std::remove_cvref_t<Parts>> > 0 ...};
  return static_cast<std::size_t>(std::find(have.begin(), have.end(), true) - have.begin());
}

}  // namespace detail

/// The Switch or Groups in a controller: itself, or in one of its parts. Real-time: yes.
template <class C>
[[nodiscard]] auto& switch_in(C& controller) noexcept {
  using Own = std::remove_const_t<C>;
  static_assert(detail::switch_size<Own> > 0, "there is no Switch or Groups in this controller");
  if constexpr (Switching<Own>) {
    return controller;
  } else {
    using Parts = detail::PartsOf<C>;
    auto& part =
        std::get<detail::index_of_switch(std::type_identity<Parts>())>(Own::parts(controller));
    static_assert(
        detail::switch_size<std::remove_cvref_t<decltype(part)>> == detail::switch_size<Own>,
        "several parts of this controller are a Switch or Groups: pass the one that is "
        "meant");
    return switch_in(part);
  }
}

}  // namespace articula

// SPDX-License-Identifier: Apache-2.0
/// @file The gains of a controller as parameters with names.
#pragma once

#include "articula/command/command_parts.hpp"
#include "articula/control/composition/parts.hpp"
#include "articula/control/composition/set_gains.hpp"
#include "articula/control/switching/switch_board.hpp"
#include "articula/core/controller.hpp"
#include "articula/model/robot.hpp"
#include "articula/remote/gains/gain_holder.hpp"
#include "articula/remote/gains/parameter.hpp"
#include "articula/remote/gains/unit_text.hpp"

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace articula::remote {

/// A part of a controller that has gains of its own, of a kind that gain_fields lists.
template <class Part>
concept ListsGains = requires(const Part& part) {
  part.gains()[0];
} && (!gain_fields<std::remove_cvref_t<decltype(std::declval<const Part&>().gains()[0])>>.empty());

/// Likewise, and they can be changed while it runs.
template <class Part, int N>
concept HasGains =
    ListsGains<Part> &&
    articula::detail::SetsGains<
        Part, ValidGains<std::remove_cvref_t<decltype(std::declval<const Part&>().gains()[0])>, N>>;

/// The unit of a command's numbers.
template <class Command>
[[nodiscard]] UnitPowers unit_of_command() {
  if constexpr (std::same_as<Command, VelocityCommand<Command::joint_count>>) {
    return {.position = 1, .second = -1};
  } else if constexpr (std::same_as<Command, PositionCommand<Command::joint_count>>) {
    return {.position = 1};
  } else {
    return {.effort = 1};
  }
}

/// The gains of a controller, found by its type: in every law that has some, through Limited,
/// Switch, Groups, SumController and OnJoints. A parameter's name is <controller>.<joint>.<gain>,
/// with the names of the controllers as Switch and Groups list them. For the outside.
/// @tparam R  the robot
template <Robot R>
class GainParameters {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using Scope = PartScope<joint_count>;
  /// Changes of holders that belong together.
  using Changes = std::vector<std::pair<GainHolder*, GainChange*>>;

  /// @param robot       whose joints these are; stays where it is
  /// @param controller  stays where it is
  template <class C>
  GainParameters(const R& robot, C& controller) : robot_(robot) {
    output_ = unit_of_command<CommandOf<C, joint_count>>();
    std::vector<std::string> names;
    if constexpr (articula::detail::switch_size<C> > 0) {
      for (const ControllerInfo& info : switch_in(controller).list()) {
        names.emplace_back(info.name.view());
      }
    }
    auto next = names.cbegin();
    add(controller, Scope{}, std::string(articula::detail::own_name<C>(0).view()), next,
        names.cend());
  }

  /// All parameters with the values that the loop has.
  [[nodiscard]] std::vector<Parameter> list() const {
    std::vector<Parameter> all;
    for (const Entry& entry : entries_) {
      all.push_back(entry.parameter);
      all.back().value = entry.holder->value(entry.joint, entry.field);
    }
    return all;
  }

  /// Checks new values, all of them or none.
  /// @param[out] changes  the same with their holders
  /// @return              what the loop has to apply
  /// @throws std::invalid_argument naming the parameter, the value and what is accepted
  [[nodiscard]] std::vector<std::unique_ptr<GainChange>> change(
      const std::vector<ParameterValue>& values, Changes& changes) const {
    if (values.empty()) articula::detail::refuse({"parameters: none is named"});
    std::map<GainHolder*, std::vector<GainValue>> by_holder;
    for (const ParameterValue& value : values) {
      const Entry& entry = entry_of(value.name);
      const Parameter& p = entry.parameter;
      if (!(value.value >= p.lowest && value.value <= p.highest)) {
        articula::detail::refuse({"parameter '", p.name, "': ", value.value, " ", p.unit,
                                  " is not within ", p.lowest, " .. ", p.highest});
      }
      by_holder[entry.holder].push_back({entry.joint, entry.field, value.value});
    }
    std::vector<std::unique_ptr<GainChange>> all;
    for (const auto& [holder, own] : by_holder) {
      all.push_back(holder->change(own));
      changes.emplace_back(holder, all.back().get());
    }
    return all;
  }

 private:
  struct Entry {
    Parameter parameter{};
    GainHolder* holder = nullptr;
    int joint = 0;
    std::size_t field = 0;
  };
  using NameIterator = std::vector<std::string>::const_iterator;

  /// @param name       of the controller that the part belongs to
  /// @param next, end  names of the controllers that can be switched, in the order in which their
  ///                   parts are visited
  template <class Part>
  void add(Part& part, const Scope& scope, const std::string& name, NameIterator& next,
           NameIterator end) {
    static_assert(
        !ListsGains<Part> || HasGains<Part, joint_count>,
        "gain_fields lists the gains of this part, but set_gains does not take them: "
        "expected void set_gains(const ValidGains<G, N>&) noexcept, where gains() returns "
        "std::array<G, N>");
    if constexpr (HasGains<Part, joint_count>) {
      add_gains(part, scope, name);
    } else if constexpr (HasParts<Part>) {
      articula::detail::for_each_part(part, [&](auto& own, std::size_t index) {
        using Own = std::remove_cvref_t<decltype(own)>;
        const Scope inner = scope.of(articula::detail::scope_of_part<joint_count>(part, index));
        if constexpr (requires { part.name_of(index); }) {
          NameIterator none = end;  // a Switch within a Switch is not switched from outside
          add(own, inner, next != end ? *next++ : std::string(part.name_of(index).view()), none,
              end);
        } else if constexpr (requires { Part::group_count; }) {
          add(own, inner, std::string(articula::detail::own_name<Own>(index).view()), next, end);
        } else {
          add(own, inner, name, next, end);
        }
      });
    }
  }

  template <class Law>
  void add_gains(Law& law, const Scope& scope, const std::string& controller) {
    using G = std::remove_cvref_t<decltype(law.gains()[0])>;
    holders_.push_back(std::make_unique<LawGains<Law, G, joint_count>>(law, joint_names(robot_)));
    const UnitPowers output =
        scope.asks_acceleration ? UnitPowers{.position = 1, .second = -2} : output_;
    for (int j = 0; j < joint_count; ++j) {
      if (scope.joints[j] == 0) continue;
      const JointProperties& joint = model_of(robot_).joints[j];
      UnitPowers variable{.position = 1};
      if constexpr (requires { law.sampled_feedback(std::size_t{}).of_velocity; }) {
        if (law.sampled_feedback(static_cast<std::size_t>(j)).of_velocity) variable.second = -1;
      }
      for (std::size_t f = 0; f < gain_fields<G>.size(); ++f) {
        const auto& field = gain_fields<G>[f];
        const std::string name =
            controller + "." + std::string(joint.name.view()) + "." + std::string(field.name);
        entries_.push_back({{.name = free_name(name),
                             .unit = unit_text(powers_of(field.unit, output, variable),
                                               joint.type == JointType::prismatic),
                             .lowest = field.lowest,
                             .highest = field.highest,
                             .description = std::string(field.description)},
                            holders_.back().get(),
                            j,
                            f});
      }
    }
  }

  /// The name, with a number if another law of the same controller has such a gain.
  [[nodiscard]] std::string free_name(const std::string& name) const {
    std::string free = name;
    for (int number = 2; find(free) != entries_.end(); ++number) {
      free = name + "_" + std::to_string(number);
    }
    return free;
  }
  [[nodiscard]] auto find(std::string_view name) const {
    return std::find_if(entries_.begin(), entries_.end(),
                        [&](const Entry& entry) { return entry.parameter.name == name; });
  }
  [[nodiscard]] const Entry& entry_of(const std::string& name) const {
    const auto found = find(name);
    if (found == entries_.end()) {
      articula::detail::refuse(
          {"there is no parameter '", name, "'; they are named <controller>.<joint>.<gain>",
           entries_.empty() ? "" : ", as '",
           entries_.empty() ? "" : entries_.front().parameter.name, entries_.empty() ? "" : "'"});
    }
    return *found;
  }

  const R& robot_;
  UnitPowers output_{};
  std::vector<std::unique_ptr<GainHolder>> holders_{};
  std::vector<Entry> entries_{};
};

}  // namespace articula::remote

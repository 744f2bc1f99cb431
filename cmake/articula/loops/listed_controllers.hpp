// SPDX-License-Identifier: Apache-2.0
/// @file Controllers of which a file says how many there are, and of which kinds.
#pragma once

#include <articula/control/switching/groups.hpp>
#include <articula/control/switching/switch.hpp>

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

namespace terminal {

/// A place for a controller that there is not. It cannot be started.
template <class Command>
struct NoController {
  static constexpr int joint_count = Command::joint_count;
  [[nodiscard]] articula::Outcome<Command> update(
      const articula::ControlInput<joint_count>&) noexcept {
    return {};
  }
};

/// A controller of one of several kinds; which one it is, is decided at set-up.
/// @tparam R        the robot
/// @tparam Command  of all kinds
/// @tparam Kinds    controllers
template <articula::Robot R, class Command, class... Kinds>
class AnyController {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using Input = articula::ControlInput<joint_count>;
  using Kind = std::variant<NoController<Command>, Kinds...>;

  AnyController() = default;
  AnyController(Kind kind) : kind_(std::move(kind)) {}  // NOLINT: a kind is a controller

  // A Switch calls these for each of its places. Inline, they would be most of the program.
  /// Real-time: yes, if the controllers' functions are. Likewise `update`.
  [[gnu::noinline]] void start(const Input& in) noexcept {
    std::visit([&](auto& own) noexcept { articula::start_controller(own, in); }, kind_);
  }
  [[nodiscard, gnu::noinline]] articula::Outcome<Command> update(const Input& in) noexcept {
    return std::visit(
        [&](auto& own) noexcept -> articula::Outcome<Command> {
          return articula::update_controller(own, in);
        },
        kind_);
  }
  /// The one that it is; see articula::HasParts.
  static auto parts(auto& self) noexcept { return std::tie(self.kind_); }

 private:
  Kind kind_{};
};

/// The most controllers for the same joints that a file may have, and the most groups of joints.
inline constexpr std::size_t most_controllers = 8, most_groups = 4;

namespace detail {

template <articula::Robot R, class Any, class Places>
struct SwitchOfMany;
template <articula::Robot R, class Any, std::size_t... Places>
struct SwitchOfMany<R, Any, std::index_sequence<Places...>> {
  template <std::size_t>
  using Each = Any;
  using Type = articula::Switch<R, Each<Places>...>;

  static Type make(const R& robot, const articula::SwitchOptions<Any::joint_count>& options,
                   std::array<Any, sizeof...(Places)> all) {
    return Type(robot, options, std::move(all[Places])...);
  }
};

}  // namespace detail

/// A Switch with up to most_controllers controllers. Places without a controller have names that
/// begin with a space.
template <articula::Robot R, class Any>
class ControllersOfGroup
    : public detail::SwitchOfMany<R, Any, std::make_index_sequence<most_controllers>>::Type {
  using Many = detail::SwitchOfMany<R, Any, std::make_index_sequence<most_controllers>>;
  using Base = typename Many::Type;

 public:
  using typename Base::Command;
  using typename Base::Input;

  /// @param names  at most most_controllers, and as many controllers; the first one is active
  ControllersOfGroup(const R& robot, const std::vector<articula::Name>& names,
                     const std::vector<Any>& controllers)
      : Base(Many::make(robot, options(names), all(controllers))) {}

  // Inline in each of the groups, these would be most of the program.
  /// Real-time: yes. Likewise `update`.
  [[gnu::noinline]] void start(const Input& in) noexcept { Base::start(in); }
  [[nodiscard, gnu::noinline]] articula::Outcome<Command> update(const Input& in) noexcept {
    return Base::update(in);
  }

 private:
  static articula::SwitchOptions<Any::joint_count> options(std::vector<articula::Name> names) {
    articula::SwitchOptions<Any::joint_count> options;
    options.active = names.empty() ? articula::Name() : names.front();
    while (names.size() < most_controllers) names.emplace_back(" " + std::to_string(names.size()));
    options.names = std::move(names);
    return options;
  }
  static std::array<Any, most_controllers> all(const std::vector<Any>& controllers) {
    std::array<Any, most_controllers> places{};
    for (std::size_t i = 0; i < controllers.size(); ++i) places[i] = controllers[i];
    return places;
  }
};

namespace detail {

template <articula::Robot R, class Own, class Places>
struct GroupsOfMany;
template <articula::Robot R, class Own, std::size_t... Places>
struct GroupsOfMany<R, Own, std::index_sequence<Places...>> {
  template <std::size_t>
  using Each = Own;
  using Type = articula::Groups<R, Each<Places>...>;

  static Type make(const R& robot,
                   const std::array<articula::JointGroup, sizeof...(Places)>& groups,
                   std::vector<Own> all) {
    return Type(robot, groups, std::move(all[Places])...);
  }
};

}  // namespace detail

/// The controllers of a file: up to most_groups groups of joints, each with its controllers. They
/// have the names of the file, without that of a group. Places without a controller have no name in
/// `list`, and no request reaches them.
template <articula::Robot R, class Any>
class ListedControllers : public detail::GroupsOfMany<R, ControllersOfGroup<R, Any>,
                                                      std::make_index_sequence<most_groups>>::Type {
  using Own = ControllersOfGroup<R, Any>;
  using Many = detail::GroupsOfMany<R, Own, std::make_index_sequence<most_groups>>;
  using Base = typename Many::Type;

 public:
  /// The controllers of some joints.
  struct Group {
    std::vector<articula::Name> joints{};
    std::vector<articula::Name> names{};  ///< of the controllers; each is there once in all groups
    std::vector<Any> controllers{};       ///< as many
  };

  /// @param groups  at most most_groups; each joint is in one
  /// @throws std::invalid_argument as Groups
  ListedControllers(const R& robot, const std::vector<Group>& groups)
      : Base(Many::make(robot, joints_of(groups), all(robot, groups))) {
    const auto listed = Base::list();
    for (std::size_t i = 0; i < listed.size(); ++i) {
      const std::string_view name = listed[i].name.view(), own = name.substr(name.find('/') + 1);
      if (!own.starts_with(' ')) names_[i] = own;
    }
  }

  articula::SwitchOutcome request(const articula::SwitchRequest& request) noexcept {
    articula::Name unknown;
    articula::SwitchRequest own{.stop = with_groups(request.stop, unknown),
                                .start = with_groups(request.start, unknown),
                                .strictness = request.strictness,
                                .replace = request.replace};
    if (!unknown.empty()) return {articula::SwitchAnswer::unknown_name, unknown};
    articula::SwitchOutcome outcome = Base::request(own);
    const auto listed = Base::list();
    for (std::size_t i = 0; i < listed.size(); ++i) {
      if (!outcome.controller.empty() && listed[i].name == outcome.controller) {
        outcome.controller = names_[i];
        break;
      }
    }
    return outcome;
  }
  [[nodiscard]] auto list() const noexcept {
    auto infos = Base::list();
    for (std::size_t i = 0; i < infos.size(); ++i) infos[i].name = names_[i];
    return infos;
  }

 private:
  static std::array<articula::JointGroup, most_groups> joints_of(const std::vector<Group>& groups) {
    // A group without joints has nothing to do. It is called as seldom as possible.
    constexpr int seldom = 1000;
    std::array<articula::JointGroup, most_groups> all;
    for (std::size_t g = 0; g < most_groups; ++g) {
      all[g].name = std::to_string(g + 1);
      all[g].divisor = seldom;
      if (g >= groups.size()) continue;
      all[g].divisor = 1;
      all[g].joints = groups[g].joints;
    }
    return all;
  }
  static std::vector<Own> all(const R& robot, const std::vector<Group>& groups) {
    std::vector<Own> all;
    for (const Group& group : groups) all.emplace_back(robot, group.names, group.controllers);
    while (all.size() < most_groups) {
      all.emplace_back(robot, std::vector<articula::Name>{}, std::vector<Any>{});
    }
    return all;
  }
  /// The names as Groups has them.
  /// @param[out] unknown  the first that is none; else as it was
  [[nodiscard]] articula::ControllerNames with_groups(const articula::ControllerNames& names,
                                                      articula::Name& unknown) const noexcept {
    std::array<articula::Name, articula::ControllerNames::capacity> found{};
    std::size_t count = 0;
    const auto listed = Base::list();
    for (const articula::Name& name : names) {
      std::size_t i = 0;
      while (i < listed.size() && !(names_[i] == name)) ++i;
      if (name.empty() || i == listed.size()) {
        if (unknown.empty()) unknown = name;
        continue;
      }
      found[count++] = listed[i].name;
    }
    return articula::ControllerNames(std::span<const articula::Name>(found.data(), count));
  }

  std::array<articula::Name, Base::controller_count> names_{};
};

}  // namespace terminal

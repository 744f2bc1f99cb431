// SPDX-License-Identifier: Apache-2.0
/// @file Controllers of which a file says how many there are, and of which kinds.
#pragma once

#include <articula/control/switching/switch.hpp>

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
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
  /// Calls function(controller) for the one that it is.
  void for_each_part(auto&& function) {
    std::visit([&](auto& own) { function(own); }, kind_);
  }
  void for_each_part(auto&& function) const {
    std::visit([&](const auto& own) { function(own); }, kind_);
  }

 private:
  Kind kind_{};
};

/// The most controllers that one file may have.
inline constexpr std::size_t most_controllers = 8;

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

/// A Switch with up to most_controllers controllers. Places without a controller have no name in
/// `list`, and no request reaches them.
template <articula::Robot R, class Any>
class ListedControllers
    : public detail::SwitchOfMany<R, Any, std::make_index_sequence<most_controllers>>::Type {
  using Many = detail::SwitchOfMany<R, Any, std::make_index_sequence<most_controllers>>;
  using Base = typename Many::Type;

 public:
  /// @param names  at most most_controllers, and as many controllers
  ListedControllers(const R& robot, const std::vector<articula::Name>& names,
                    const std::vector<Any>& controllers)
      : Base(Many::make(robot, {.names = all_names(names)}, all(controllers))),
        count_(names.size()) {}

  articula::SwitchOutcome request(const articula::SwitchRequest& request) noexcept {
    for (const auto* names : {&request.stop, &request.start}) {
      for (const articula::Name& name : *names) {
        const std::size_t place = this->board().find(name);
        if (place >= count_ && place < most_controllers) {
          return {articula::SwitchAnswer::unknown_name, name};
        }
      }
    }
    return Base::request(request);
  }
  [[nodiscard]] std::array<articula::ControllerInfo, most_controllers> list() const noexcept {
    auto infos = Base::list();
    for (std::size_t i = count_; i < most_controllers; ++i) infos[i].name = {};
    return infos;
  }

 private:
  static std::vector<articula::Name> all_names(std::vector<articula::Name> names) {
    while (names.size() < most_controllers) {
      names.emplace_back("no controller " + std::to_string(names.size()));
    }
    return names;
  }
  static std::array<Any, most_controllers> all(const std::vector<Any>& controllers) {
    std::array<Any, most_controllers> places{};
    for (std::size_t i = 0; i < controllers.size(); ++i) places[i] = controllers[i];
    return places;
  }

  std::size_t count_;
};

}  // namespace terminal

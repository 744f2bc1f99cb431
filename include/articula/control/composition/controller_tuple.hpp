// SPDX-License-Identifier: Apache-2.0
/// @file The members of Switch and Groups.
#pragma once

#include "articula/core/controller_check.hpp"
#include "articula/core/scalar.hpp"

#include <concepts>
#include <cstddef>
#include <tuple>
#include <utility>

namespace articula {

namespace detail {

template <class... Controllers>
using FirstOf = std::tuple_element_t<0, std::tuple<Controllers...>>;

/// The type of a number of several controllers: that of the first.
template <class... Controllers>
using ScalarOfAll = ScalarOf<FirstOf<Controllers...>>;

/// At least one of several controllers brakes.
template <int N, class... Controllers>
concept AnyBrakes = (Brakes<Controllers, N, ScalarOfAll<Controllers...>> || ...);

/// Asserts that several types are controllers with the same type of command.
template <int N, class... Controllers>
struct CheckedControllers {
  using S = ScalarOfAll<Controllers...>;
  using Command = typename CheckedController<FirstOf<Controllers...>, N, S>::Command;
  static_assert((std::same_as<typename CheckedController<Controllers, N, S>::Command, Command> &&
                 ...),
                "the controllers of a Switch or of Groups must have the same type of command");
};

/// The command of several controllers for N joints.
template <int N, class... Controllers>
using CommandOfAll = typename CheckedControllers<N, Controllers...>::Command;

}  // namespace detail

/// The controllers of a Switch or of Groups.
template <class... Controllers>
class ControllerTuple {
 public:
  /// One of the controllers, by its index in the list or its type.
  template <std::size_t I>
  [[nodiscard]] auto& member() noexcept {
    return std::get<I>(controllers_);
  }
  template <std::size_t I>
  [[nodiscard]] const auto& member() const noexcept {
    return std::get<I>(controllers_);
  }
  template <class C>
  [[nodiscard]] C& member() noexcept {
    return std::get<C>(controllers_);
  }
  template <class C>
  [[nodiscard]] const C& member() const noexcept {
    return std::get<C>(controllers_);
  }

  /// The controllers as parts; see HasParts.
  static auto parts(auto& self) noexcept {
    return std::apply([](auto&... controllers) { return std::tie(controllers...); },
                      self.controllers_);
  }

 protected:
  explicit ControllerTuple(Controllers... controllers) : controllers_(std::move(controllers)...) {}

  /// Calls function(controller, index) for each of the controllers.
  void for_each(auto&& function) { visit(controllers_, function); }
  void for_each(auto&& function) const { visit(controllers_, function); }

 private:
  static void visit(auto& controllers, auto& function) {
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (function(std::get<I>(controllers), I), ...);
    }(std::index_sequence_for<Controllers...>());
  }

  std::tuple<Controllers...> controllers_;
};

}  // namespace articula

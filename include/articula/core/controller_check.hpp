// SPDX-License-Identifier: Apache-2.0
/// @file Compile-time messages for types that are no controllers.
///
/// Loops and compositions (Limited, Switch, Groups) take any type and name its command by
/// `CheckedController<C, N, S>::Command`. So a mistake gives one message that says what is wrong. A
/// constraint would list every alternative that does not hold.
#pragma once

#include "articula/core/controller.hpp"

#include <tuple>
#include <type_traits>

namespace articula::detail {

/// Whether a controller that has a number of joints has that of the robot.
template <class C, int N>
[[nodiscard]] consteval bool is_for_joints() {
  if constexpr (requires { C::joint_count; }) {
    return C::joint_count == N;
  } else {
    return true;
  }
}

/// What is asserted of a type that can be called.
/// @tparam N  number of joints
/// @tparam S  type of a number
template <class C, int N, class S, bool = HasUpdate<C, N, S> || IsCallable<C, N, S>>
struct CheckedUpdate {
  using Result = CommandOf<C, N, S>;
  static constexpr bool gives_command = JointCommand<Result, N, S>;
  // One that is no command is replaced, so that the message below is the first.
  using Command = std::conditional_t<gives_command, Result, EffortCommand<N, S>>;
  static_assert(
      update_is_noexcept<C, N, S>(),
      "update of the controller must be noexcept and take a const ControlInput<N>& (a copy "
      "is not noexcept), see core/controller.hpp");
  static_assert(gives_command,
                "update of the controller must return a command for N joints by value, such as "
                "EffortCommand<N>, or an Outcome of one, see core/controller.hpp");
};
template <class C, int N, class S>
struct CheckedUpdate<C, N, S, false> {
  using Command = EffortCommand<N, S>;  // so that the message below is the first
  static_assert(is_for_joints<C, N>(),
                "the controller's joint_count is not that of this robot: it is for another robot");
  static_assert(HasUpdate<C, N, S> || !is_for_joints<C, N>(),
                "the controller has no update(const ControlInput<N>&) for the N joints of this "
                "robot, see core/controller.hpp");
};

template <class T>
inline constexpr bool is_tuple_of_references = false;
template <class... Parts>
inline constexpr bool is_tuple_of_references<std::tuple<Parts...>> =
    (std::is_lvalue_reference_v<Parts> && ...);

/// A controller has no `parts`, or shows its parts as control/composition/parts.hpp says.
template <class C>
concept PartsFit =
    !(requires(C& c) { c.parts(); } || requires(C& c) { C::parts(c); }) ||
    (requires(C& c) { requires is_tuple_of_references<decltype(C::parts(c))>; } &&
     requires(const C& c) { requires is_tuple_of_references<decltype(C::parts(c))>; });

/// Asserts all that the concept Controller demands, one thing at a time.
/// @tparam N  number of joints
/// @tparam S  type of a number
template <class C, int N, class S = double>
struct CheckedController : CheckedUpdate<C, N, S> {
  static_assert(StartFits<C, N, S> || !is_for_joints<C, N>(),
                "start of the controller must take a const ControlInput<N>& for the N joints of "
                "this robot, see core/controller.hpp");
  static_assert(start_is_noexcept<C, N, S>(), "start of the controller must be noexcept");
  static_assert(
      BrakeFits<C, N, S>,
      "brake of the controller must be noexcept, take a const ControlInput<N>& and return "
      "what update returns, see core/controller.hpp");
  static_assert(PartsFit<C>,
                "parts of the controller must be static auto parts(auto& self) noexcept and return "
                "std::tie of members, see control/composition/parts.hpp");
};

}  // namespace articula::detail

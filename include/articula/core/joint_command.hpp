// SPDX-License-Identifier: Apache-2.0
/// @file The commands of a controller to the drives: one type per command interface.
#pragma once

#include "articula/core/joint_vector.hpp"

#include <concepts>

namespace articula {

/// Efforts for N drives.
/// @tparam N       number of joints
/// @tparam Scalar  as that of JointVector
template <int N, class Scalar = double>
struct EffortCommand {
  static constexpr int joint_count = N;

  JointVector<N, Scalar> effort = JointVector<N, Scalar>::Zero();  ///< [N m or N], N x 1
};

/// Positions for N drives that close their own position loop.
/// @tparam N       number of joints
/// @tparam Scalar  as that of JointVector
template <int N, class Scalar = double>
struct PositionCommand {
  static constexpr int joint_count = N;

  JointVector<N, Scalar> position = JointVector<N, Scalar>::Zero();  ///< [rad or m], N x 1
};

/// Velocities for N drives that close their own velocity loop.
/// @tparam N       number of joints
/// @tparam Scalar  as that of JointVector
template <int N, class Scalar = double>
struct VelocityCommand {
  static constexpr int joint_count = N;

  JointVector<N, Scalar> velocity = JointVector<N, Scalar>::Zero();  ///< [rad/s or m/s], N x 1
};

/// A spring, a damper and an effort for each of N drives that close this loop of their own, known
/// as MIT mode. effort = stiffness (position - q) + damping (velocity - v) + effort.
/// @tparam N       number of joints
/// @tparam Scalar  as that of JointVector
template <int N, class Scalar = double>
struct MultiModeCommand {
  static constexpr int joint_count = N;

  JointVector<N, Scalar> position = JointVector<N, Scalar>::Zero();   ///< [rad or m], N x 1
  JointVector<N, Scalar> velocity = JointVector<N, Scalar>::Zero();   ///< [rad/s or m/s], N x 1
  JointVector<N, Scalar> stiffness = JointVector<N, Scalar>::Zero();  ///< [N m/rad or N/m], N x 1
  JointVector<N, Scalar> damping = JointVector<N, Scalar>::Zero();  ///< [N m s/rad or N s/m], N x 1
  JointVector<N, Scalar> effort =
      JointVector<N, Scalar>::Zero();  ///< feed-forward effort [N m or N], N x 1
};

/// Any of the commands above for N joints.
template <class C, int N, class Scalar = double>
concept JointCommand =
    std::same_as<C, EffortCommand<N, Scalar>> || std::same_as<C, PositionCommand<N, Scalar>> ||
    std::same_as<C, VelocityCommand<N, Scalar>> || std::same_as<C, MultiModeCommand<N, Scalar>>;

namespace detail {

template <class Command>
struct CommandScalar;
template <template <int, class> class Command, int N, class Scalar>
struct CommandScalar<Command<N, Scalar>> {
  using Type = Scalar;
};

}  // namespace detail

/// The numbers of a command, whatever they command, N x 1. Real-time: yes.
template <int N, class S>
[[nodiscard]] constexpr const JointVector<N, S>& values_of(
    const EffortCommand<N, S>& command) noexcept {
  return command.effort;
}
/// @copydoc values_of(const EffortCommand<N, S>&)
template <int N, class S>
[[nodiscard]] constexpr const JointVector<N, S>& values_of(
    const PositionCommand<N, S>& command) noexcept {
  return command.position;
}
/// @copydoc values_of(const EffortCommand<N, S>&)
template <int N, class S>
[[nodiscard]] constexpr const JointVector<N, S>& values_of(
    const VelocityCommand<N, S>& command) noexcept {
  return command.velocity;
}

}  // namespace articula

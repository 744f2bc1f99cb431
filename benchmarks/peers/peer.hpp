// SPDX-License-Identifier: Apache-2.0
/// @file The same work, done by another library.
#pragma once

#include "robots/blueprint.hpp"

#include <articula/model/model.hpp>

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace peers {

/// What is measured.
enum class Operation {
  inverse_dynamics,
  gravity,
  mass_matrix,
  forward_dynamics,
  step,
  forward_kinematics,
  jacobian
};

inline constexpr std::array<std::string_view, 7> operation_names{
    "inverse_dynamics",   "gravity", "mass_matrix", "forward_dynamics", "step",
    "forward_kinematics", "jacobian"};

inline constexpr double step_time = 1e-3;  ///< of a Runge-Kutta step [s]

using Numbers = std::vector<double>;

/// A robot in motion. Joints are in articula's order, which is that of the bodies.
struct State {
  Numbers q, v, a, effort;
};

/// A robot in another library. States are handed over before anything is measured, so that each
/// library reads them in a form of its own.
class Peer {
 public:
  virtual ~Peer() = default;
  /// True if the library offers the operation for this robot.
  [[nodiscard]] virtual bool offers(Operation operation) const = 0;
  /// Does the work on one of the states.
  virtual void run(Operation operation, std::size_t state) = 0;
  /// What the last run of an operation gave, in the order of articula's joints: efforts, rows of
  /// the mass matrix, accelerations, positions and velocities after a step, the rotation and the
  /// translation of the link, its Jacobian; matrices column by column.
  [[nodiscard]] virtual Numbers result(Operation operation) const = 0;
};

/// Orocos KDL: the robot as kdl_parser makes it of a URDF, a segment for each link, fixed joints
/// included. Its solvers for chains where the robot is one, else its solver for trees, which has
/// inverse dynamics only.
/// @param joints  names of those that move, in articula's order
/// @param link    whose place and Jacobian are asked for
[[nodiscard]] std::unique_ptr<Peer> kdl(const support::Blueprint& robot,
                                        const std::vector<std::string>& joints,
                                        const std::string& link, const std::vector<State>& states);

/// How MuJoCo's functions are called.
enum class Pipeline {
  whole,     ///< mj_inverse, mj_forward, mj_step
  shortest,  ///< only those of their stages that the result needs
};

/// @param link  on one of the bodies
[[nodiscard]] std::unique_ptr<Peer> mujoco(std::span<const articula::Body> bodies,
                                           const articula::Vector3<double>& gravity,
                                           const articula::LinkFrame& link,
                                           const std::vector<State>& states, Pipeline pipeline);

}  // namespace peers

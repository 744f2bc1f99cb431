// SPDX-License-Identifier: Apache-2.0
/// @file Robots of any number of joints behind one type, so that what is tested on all of them is
/// compiled once.
#pragma once

#include "robots/blueprint.hpp"

#include <articula/dynamics/dynamics.hpp>

#include <Eigen/Core>

#include <memory>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

namespace support {

/// articula's functions for one run-time model, on vectors of run-time size.
class AnyRobot {
 public:
  using Vector = Eigen::VectorXd;
  using Matrix = Eigen::MatrixXd;

  virtual ~AnyRobot() = default;
  [[nodiscard]] virtual Vector inverse_dynamics(const Vector& q, const Vector& v,
                                                const Vector& a) const = 0;
  [[nodiscard]] virtual Vector forward_dynamics(const Vector& q, const Vector& v,
                                                const Vector& effort) const = 0;
  [[nodiscard]] virtual Vector nonlinear_effects(const Vector& q, const Vector& v) const = 0;
  [[nodiscard]] virtual Vector gravity(const Vector& q) const = 0;
  [[nodiscard]] virtual Matrix mass_matrix(const Vector& q) const = 0;
  [[nodiscard]] virtual double kinetic_energy(const Vector& q, const Vector& v) const = 0;
  [[nodiscard]] virtual double potential_energy(const Vector& q) const = 0;
  [[nodiscard]] virtual Eigen::Isometry3d forward_kinematics(const Vector& q,
                                                             std::string_view link) const = 0;
  [[nodiscard]] virtual Matrix jacobian(const Vector& q, std::string_view link) const = 0;
  [[nodiscard]] virtual std::vector<std::string_view> joint_names() const = 0;
  [[nodiscard]] virtual const articula::Body& first_body() const = 0;
};

/// @tparam N       number of joints
/// @tparam Bodies  number of moving bodies
template <int N, int Bodies>
class SizedRobot final : public AnyRobot {
 public:
  explicit SizedRobot(const Blueprint& blueprint) : model_(blueprint.model<N, Bodies>()) {}

  Vector inverse_dynamics(const Vector& q, const Vector& v, const Vector& a) const override {
    return articula::inverse_dynamics(model_, Sized(q), Sized(v), Sized(a));
  }
  Vector forward_dynamics(const Vector& q, const Vector& v, const Vector& effort) const override {
    return articula::forward_dynamics(model_, Sized(q), Sized(v), Sized(effort));
  }
  Vector nonlinear_effects(const Vector& q, const Vector& v) const override {
    return articula::nonlinear_effects(model_, Sized(q), Sized(v));
  }
  Vector gravity(const Vector& q) const override { return articula::gravity(model_, Sized(q)); }
  Matrix mass_matrix(const Vector& q) const override {
    return articula::mass_matrix(model_, Sized(q));
  }
  double kinetic_energy(const Vector& q, const Vector& v) const override {
    return articula::kinetic_energy(model_, Sized(q), Sized(v));
  }
  double potential_energy(const Vector& q) const override {
    return articula::potential_energy(model_, Sized(q));
  }
  Eigen::Isometry3d forward_kinematics(const Vector& q, std::string_view link) const override {
    return articula::forward_kinematics(model_, Sized(q), link);
  }
  Matrix jacobian(const Vector& q, std::string_view link) const override {
    return articula::jacobian(model_, Sized(q), link);
  }
  std::vector<std::string_view> joint_names() const override {
    const auto names = articula::joint_names(model_);
    return {names.begin(), names.end()};
  }
  const articula::Body& first_body() const override { return model_.mechanism.bodies[0]; }

 private:
  using Sized = articula::JointVector<N>;
  articula::Model<N, Bodies> model_;
};

/// The robot of a blueprint with 1 to 8 free joints, or with 1, 3 or 5 and some that mimic them.
[[nodiscard]] inline std::unique_ptr<AnyRobot> any_robot(const Blueprint& blueprint) {
  const articula::ModelSize size = articula::model_size(blueprint.joints);
  std::unique_ptr<AnyRobot> robot;
  const auto try_size = [&]<int N, int Bodies>(std::integer_sequence<int, N, Bodies>) {
    if (size.joints == N && size.bodies == Bodies) {
      robot = std::make_unique<SizedRobot<N, Bodies>>(blueprint);
    }
  };
  const auto try_sizes = [&]<int... K>(std::integer_sequence<int, K...>) {
    (try_size(std::integer_sequence<int, K + 1, K + 1>{}), ...);
  };
  try_sizes(std::make_integer_sequence<int, 8>{});
  try_size(std::integer_sequence<int, 1, 2>{});
  try_size(std::integer_sequence<int, 3, 5>{});
  try_size(std::integer_sequence<int, 5, 8>{});
  if (!robot) throw std::logic_error("any_robot: add this size");
  return robot;
}

}  // namespace support

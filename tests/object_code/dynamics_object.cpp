// SPDX-License-Identifier: Apache-2.0
#include <articula/dynamics/dynamics.hpp>
#include <articula/robots/q2d.hpp>

using namespace articula;

namespace {

using Vector = JointVector<2>;

template <Robot R>
void all_dynamics(const R& robot, const Vector& q, const Vector& v, const Vector& x, LinkIndex link,
                  JointMatrix<2>& matrix, Eigen::Isometry3d& place, Vector& sum) noexcept {
  matrix = mass_matrix(robot, q);
  place = forward_kinematics(robot, q, link);
  place.translation() += jacobian(robot, q, link).template topRows<3>() * v;
  sum = inverse_dynamics(robot, q, v, x) + gravity(robot, q) + nonlinear_effects(robot, q, v) +
        forward_dynamics(robot, q, v, x) + friction_effort(robot, v);
  const JointVectors<2, 8> many = v.replicate<1, 8>();
  sum += forward_dynamics(robot, many, many, many).rowwise().sum() +
         inverse_dynamics(robot, many, many, many).rowwise().sum();
  sum[0] += kinetic_energy(robot, q, v) + potential_energy(robot, q);
}

}  // namespace

extern "C" void described(const Vector& q, const Vector& v, const Vector& x, LinkIndex link,
                          JointMatrix<2>& matrix, Eigen::Isometry3d& place, Vector& sum) noexcept {
  all_dynamics(Q2d(), q, v, x, link, matrix, place, sum);
  place = place * forward_kinematics<"tool_link">(Q2d(), q);
  place.translation() += jacobian<"tool_link">(Q2d(), q).topRows<3>() * v;
}

extern "C" void loaded(const Model<2>& robot, const Vector& q, const Vector& v, const Vector& x,
                       LinkIndex link, JointMatrix<2>& matrix, Eigen::Isometry3d& place,
                       Vector& sum) noexcept {
  all_dynamics(robot, q, v, x, link, matrix, place, sum);
}

// SPDX-License-Identifier: Apache-2.0
/// @file The mass matrix.
#pragma once

#include "articula/dynamics/engine/evaluate.hpp"
#include "articula/dynamics/engine/unset_array.hpp"
#include "articula/dynamics/engine/wrench.hpp"

namespace articula {

/// The algorithm of mass_matrix: composite rigid bodies. All that a joint carries is one rigid body
/// for this joint. Its inertia gives the wrench for a unit acceleration of the joint. The
/// components of this wrench along the axes of the joints towards the base are elements of the
/// matrix. Source: [Walker, Orin 1982, method 3]; [Featherstone 2008, section 6.2].
struct MassMatrix {
  template <class S, int N, int B>
  [[nodiscard]] static constexpr JointRows<S, N> evaluate(
      const Mechanism<N, B>& mechanism, const Configuration<S, B>& configuration) noexcept {
    detail::UnsetArray<MassMoments<S>, B> composite;
    for (int i = 0; i < B; ++i) {
      composite.set(i, configuration[i].moments);
    }
    JointRows<S, B> matrix;
    for (auto& row : matrix) row.fill(S(0.0));
    for (int i = B; i-- > 0;) {
      Wrench<S> wrench = unit_acceleration_wrench(composite[i], mechanism.bodies[i].prismatic);
      matrix[i][i] = along_axis(mechanism.bodies[i], wrench);
      if (mechanism.bodies[i].reflected_inertia != 0) {
        matrix[i][i] = matrix[i][i] + configuration[i].reflected_inertia;
      }
      int j = i;
      while (mechanism.bodies[j].parent >= 0) {
        const Vector3<S> force = configuration[j].to_parent(wrench.force);
        wrench = {force, configuration[j].to_parent(wrench.moment) +
                             cross(configuration[j].translation, force)};
        j = detail::parent_of(mechanism.bodies[j], j);
        matrix[i][j] = matrix[j][i] = along_axis(mechanism.bodies[j], wrench);
      }
      if (mechanism.bodies[i].parent >= 0) {
        configuration[i].add_to_parent(composite[i],
                                       composite[detail::parent_of(mechanism.bodies[i], i)]);
      }
    }
    for (int i = 0; i < B; ++i) {
      const Body& body = mechanism.bodies[i];
      if (body.sharing_body < 0) continue;
      const int other = body.sharing_body;
      matrix[i][other] = matrix[other][i] = matrix[i][other] + S(body.shared_inertia);
    }
    return joint_matrix<S, N, B>(mechanism, matrix);
  }

 private:
  /// The wrench that gives a resting body a unit acceleration along (or about) its z axis.
  template <class S>
  static constexpr Wrench<S> unit_acceleration_wrench(const MassMoments<S>& body,
                                                      bool prismatic) noexcept {
    const Vector3<S>& h = body.first;
    const Symmetric3<S>& j = body.second;
    if (prismatic) return {{S(0.0), S(0.0), body.mass}, {h.y, -h.x, S(0.0)}};
    return {{-h.y, h.x, S(0.0)}, {-j.xz, -j.yz, j.xx + j.yy}};
  }
  template <class S>
  static constexpr S along_axis(const Body& body, const Wrench<S>& wrench) noexcept {
    return body.prismatic ? wrench.force.z : wrench.moment.z;
  }
};

/// The matrix M(q) of the equations of motion M(q) a + h(q, v) = effort. It is symmetric and
/// positive definite, and the kinetic energy is v^T M v / 2. It includes the reflected inertia of
/// the drives.
/// @param robot  a described robot or a model
/// @param q      joint positions [rad or m], N x 1
/// @return       M [kg m^2, kg m or kg], N x N, both triangles filled
/// Real-time: yes. O(N d) with d the depth of the tree.
template <Robot R>
[[nodiscard]] JointMatrix<joint_count<R>> mass_matrix(
    const R& robot, const JointVector<joint_count<R>>& q) noexcept {
  return detail::to_matrix(detail::evaluate<MassMatrix>(robot, q));
}

/// The same for the robots of a pack.
/// Real-time: yes.
template <Robot R, JointVectorPack<R> Q>
  requires(Q::ColsAtCompileTime == 1)
[[nodiscard]] JointMatrix<joint_count<R>, typename Q::Scalar> mass_matrix(const R& robot,
                                                                          const Q& q) noexcept {
  return detail::to_matrix(detail::evaluate_numbers<MassMatrix>(robot, q.data()));
}

}  // namespace articula

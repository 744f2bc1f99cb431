// SPDX-License-Identifier: Apache-2.0
/// @file The Q2D as a textbook has it: a planar arm with two revolute joints, in closed form. It
/// uses nothing of articula, so that articula can be tested against it.
#pragma once

#include <Eigen/Dense>

#include <cmath>

namespace support {

/// A planar arm with two vertical axes, by its seven dynamic parameters.
///
/// Lagrange's equations with the bodies' moments taken about their own joint axes
/// [Siciliano, Sciavicco, Villani, Oriolo 2009, section 7.3.2]:
///   M(q) a + bias(q, v) + gravity(q) = effort.
/// The defaults are the Q2D's: body 1 is the two shoulder links, body 2 the two elbow links.
struct TwoLinkArm {
  using Vector = Eigen::Vector2d;
  using Matrix = Eigen::Matrix2d;

  /// A link by what a planar motion sees of it: mass [kg], centre of mass [m], izz there [kg m^2].
  struct PlanarLink {
    double mass;
    Vector center;
    double izz;
  };
  /// Two links that are welded together, both given in the frame of their joint.
  struct Body {
    double mass;           ///< sum of m [kg]
    Vector first_moment;   ///< sum of m c [kg m]
    double second_moment;  ///< sum of izz + m |c|^2, about the joint's axis [kg m^2]

    Body(const PlanarLink& a, const PlanarLink& b)
        : mass(a.mass + b.mass),
          first_moment(a.mass * a.center + b.mass * b.center),
          second_moment(a.izz + a.mass * a.center.squaredNorm() + b.izz +
                        b.mass * b.center.squaredNorm()) {}
  };

  Body shoulder{{0.19730261508, {0.0252456823, -0.00000002723}, 0.00047879093657893},
                {1.26475817816, {0.16516344805, -0.00048428845}, 0.03113579694057124}};
  Body elbow{{0.19712951877, {0.02548273493, -0.00000002263}, 0.00048091942023028},
             {0.67529215765, {0.06204831581, 0.00000013809}, 0.00751638349361413}};
  double upper_arm = 0.343;           ///< shoulder axis to elbow axis [m]
  Vector gravity_vector{0.0, 0.0};    ///< fall in the arm's plane [m/s^2]; zero unless it is tilted
  Vector damping{29.7914, 2.6404};    ///< [N m s/rad]
  Vector effort_limit{27.94, 13.62};  ///< [N m]

  /// M(q) [kg m^2].
  [[nodiscard]] Matrix mass_matrix(const Vector& q) const {
    const double coupling = upper_arm * (elbow.first_moment.x() * std::cos(q[1]) -
                                         elbow.first_moment.y() * std::sin(q[1]));
    const double inner = elbow.second_moment + coupling;
    const double outer = shoulder.second_moment + elbow.second_moment +
                         elbow.mass * upper_arm * upper_arm + 2 * coupling;
    Matrix m;
    m << outer, inner, inner, elbow.second_moment;
    return m;
  }

  /// Coriolis and centrifugal effort [N m].
  [[nodiscard]] Vector bias(const Vector& q, const Vector& v) const {
    const double slope =  // of the coupling with the elbow's angle
        -upper_arm *
        (elbow.first_moment.x() * std::sin(q[1]) + elbow.first_moment.y() * std::cos(q[1]));
    return {slope * v[1] * (2 * v[0] + v[1]), -slope * v[0] * v[0]};
  }

  /// The effort that holds the arm against gravity_vector [N m]: the slope of the potential energy.
  [[nodiscard]] Vector gravity(const Vector& q) const {
    const double inner = -gravity_vector.dot(turned(elbow.first_moment, q[0] + q[1]));
    return {inner - gravity_vector.dot(turned(upper_arm_moment(), q[0])), inner};
  }

  /// -gravity . (sum of m r) [J], zero for a mass at the shoulder's axis.
  [[nodiscard]] double potential_energy(const Vector& q) const {
    return -gravity_vector.dot(rotation(q[0]) * upper_arm_moment() +
                               rotation(q[0] + q[1]) * elbow.first_moment);
  }

  /// v' M v / 2 [J].
  [[nodiscard]] double kinetic_energy(const Vector& q, const Vector& v) const {
    return v.dot(mass_matrix(q) * v) / 2;
  }

  /// The effort for an acceleration [N m].
  [[nodiscard]] Vector inverse_dynamics(const Vector& q, const Vector& v, const Vector& a) const {
    return mass_matrix(q) * a + bias(q, v) + gravity(q);
  }

  /// The acceleration an effort causes [rad/s^2]. Damping is the caller's to subtract.
  [[nodiscard]] Vector forward_dynamics(const Vector& q, const Vector& v,
                                        const Vector& effort) const {
    return mass_matrix(q).inverse() * (effort - bias(q, v) - gravity(q));
  }

 private:
  [[nodiscard]] static Matrix rotation(double angle) {
    return Eigen::Rotation2Dd(angle).toRotationMatrix();
  }
  /// The slope of rotation(angle) * moment with the angle.
  [[nodiscard]] static Vector turned(const Vector& moment, double angle) {
    const Vector m = rotation(angle) * moment;
    return {-m.y(), m.x()};
  }
  /// What turns with the shoulder alone: its own mass, and the elbow's as if at the elbow's axis.
  [[nodiscard]] Vector upper_arm_moment() const {
    return shoulder.first_moment + Vector(elbow.mass * upper_arm, 0);
  }
};

}  // namespace support

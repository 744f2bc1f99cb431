// SPDX-License-Identifier: Apache-2.0
/// @file A robot by the textbook: poses link by link and the mass matrix by Jacobians, straight
/// from the description. It shares no code with articula beyond the description's types.
#pragma once

#include "eigen.hpp"
#include "robots/blueprint.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

namespace support {

/// Kinematics and energies of a blueprint, slow and plain.
class TextbookRobot {
 public:
  /// @param blueprint  without fault; has to outlive this
  /// @param names      of the joints that move and mimic no other, in the order of q
  template <class Names>
  TextbookRobot(const Blueprint& blueprint, const Names& names)
      : blueprint_(blueprint), names_(names.begin(), names.end()) {}

  /// Where a link stands in the root's frame.
  [[nodiscard]] Eigen::Isometry3d placement(std::string_view link, const Eigen::VectorXd& q) const {
    const articula::Joint* joint = carrier(link);
    if (!joint) return Eigen::Isometry3d::Identity();
    return joint_placement(*joint, q) * motion(*joint, q);
  }

  /// The sum over the links of m Jv' Jv + Jw' I Jw.
  [[nodiscard]] Eigen::MatrixXd mass_matrix(const Eigen::VectorXd& q) const {
    Eigen::MatrixXd mass_matrix = Eigen::MatrixXd::Zero(q.size(), q.size());
    for (const articula::Link& link : blueprint_.links) {
      const Eigen::Isometry3d pose = placement(link.name, q);
      const Eigen::Vector3d center = pose * to_eigen(link.center_of_mass);
      const Eigen::Matrix3d turn = pose.linear() * rotation_of_rpy(link.inertia_orientation);
      Eigen::Matrix3Xd linear = Eigen::Matrix3Xd::Zero(3, q.size()), angular = linear;
      for (const articula::Joint* j = carrier(link.name); j; j = carrier(j->parent)) {
        if (j->type == articula::JointType::fixed) continue;
        const Eigen::Isometry3d at = joint_placement(*j, q);
        const Eigen::Vector3d axis = at.linear() * to_eigen(j->axis).normalized();
        const Eigen::Index i = index(*j);
        const double speed = mimics(*j) ? j->mimic.multiplier : 1;
        if (j->type == articula::JointType::prismatic) {
          linear.col(i) += speed * axis;
        } else {
          linear.col(i) += speed * axis.cross(center - at.translation());
          angular.col(i) += speed * axis;
        }
      }
      mass_matrix += link.mass * linear.transpose() * linear + angular.transpose() * turn *
                                                                   to_eigen(link.inertia) *
                                                                   turn.transpose() * angular;
    }
    return mass_matrix;
  }

  /// Minus the sum of m g . c over the links that a moving joint carries.
  [[nodiscard]] double potential_energy(const Eigen::VectorXd& q) const {
    double energy = 0;
    for (const articula::Link& link : blueprint_.links) {
      if (!moves(link.name)) continue;
      energy -=
          link.mass *
          to_eigen(blueprint_.gravity).dot(placement(link.name, q) * to_eigen(link.center_of_mass));
    }
    return energy;
  }

 private:
  [[nodiscard]] const articula::Joint* carrier(std::string_view link) const {
    for (const articula::Joint& joint : blueprint_.joints) {
      if (joint.child.view() == link) return &joint;
    }
    return nullptr;
  }
  [[nodiscard]] bool moves(std::string_view link) const {
    for (const articula::Joint* j = carrier(link); j; j = carrier(j->parent)) {
      if (j->type != articula::JointType::fixed) return true;
    }
    return false;
  }
  [[nodiscard]] static bool mimics(const articula::Joint& joint) {
    return !joint.mimic.joint.empty();
  }
  /// Of the element of q that moves a joint.
  [[nodiscard]] Eigen::Index index(const articula::Joint& joint) const {
    const articula::Name& name = mimics(joint) ? joint.mimic.joint : joint.name;
    const auto found = std::find(names_.begin(), names_.end(), name.view());
    return static_cast<Eigen::Index>(found - names_.begin());
  }
  [[nodiscard]] double position(const articula::Joint& joint, const Eigen::VectorXd& q) const {
    const double moved = q[index(joint)];
    return mimics(joint) ? joint.mimic.multiplier * moved + joint.mimic.offset : moved;
  }
  /// The joint's frame before it moves.
  [[nodiscard]] Eigen::Isometry3d joint_placement(const articula::Joint& joint,
                                                  const Eigen::VectorXd& q) const {
    return placement(joint.parent, q) * Eigen::Translation3d(to_eigen(joint.origin)) *
           Eigen::Isometry3d(rotation_of_rpy(joint.orientation));
  }
  [[nodiscard]] Eigen::Isometry3d motion(const articula::Joint& joint,
                                         const Eigen::VectorXd& q) const {
    if (joint.type == articula::JointType::fixed) return Eigen::Isometry3d::Identity();
    const Eigen::Vector3d axis = to_eigen(joint.axis).normalized();
    if (joint.type == articula::JointType::prismatic) {
      return Eigen::Isometry3d(Eigen::Translation3d(position(joint, q) * axis));
    }
    return Eigen::Isometry3d(Eigen::AngleAxisd(position(joint, q), axis));
  }

  const Blueprint& blueprint_;
  std::vector<std::string_view> names_;
};

}  // namespace support

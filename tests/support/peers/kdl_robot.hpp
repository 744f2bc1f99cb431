// SPDX-License-Identifier: Apache-2.0
/// @file A robot in the Orocos Kinematics and Dynamics Library.
#pragma once

#include "peers/kdl.hpp"

#include <Eigen/Core>

#include <kdl/treeidsolver_recursive_newton_euler.hpp>

#include <algorithm>
#include <iterator>
#include <string_view>

namespace support {

/// The name of the link that no joint carries.
[[nodiscard]] inline articula::Name root_of(const Blueprint& robot) {
  for (const articula::Link& link : robot.links) {
    bool carried = false;
    for (const articula::Joint& joint : robot.joints) carried = carried || joint.child == link.name;
    if (!carried) return link.name;
  }
  throw std::logic_error("a tree has a root");
}

/// A robot in KDL, which knows nothing of mimic joints: q_all = C q + offset is worked out here,
/// from the description.
class KdlRobot {
 public:
  /// @param names  of the joints that can be commanded, in the order of all vectors
  template <class Names>
  KdlRobot(const Blueprint& robot, const Names& names)
      : tree_(to_kdl(robot, root_of(robot))),
        solver_(tree_, to_kdl(robot.gravity)),
        weightless_solver_(tree_, KDL::Vector::Zero()),
        coupling_(Eigen::MatrixXd::Zero(tree_.getNrOfJoints(), std::ssize(names))),
        offset_(Eigen::VectorXd::Zero(tree_.getNrOfJoints())) {
    for (const auto& [name, element] : tree_.getSegments()) {
      for (const articula::Joint& joint : robot.joints) {
        if (element.segment.getJoint().getName() != joint.name.view()) continue;
        if (joint.type == articula::JointType::fixed) continue;
        const auto& [followed, multiplier, offset] = joint.mimic;
        const std::string_view leader = followed.empty() ? joint.name.view() : followed.view();
        const auto found = std::find(names.begin(), names.end(), leader);
        coupling_(element.q_nr, found - names.begin()) = multiplier;
        offset_[element.q_nr] = offset;
      }
    }
  }

  [[nodiscard]] Eigen::VectorXd inverse_dynamics(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                                 const Eigen::VectorXd& a) {
    return solve(solver_, q, v, a);
  }
  /// KDL has it for chains alone; for a tree its columns are the efforts for unit accelerations.
  [[nodiscard]] Eigen::MatrixXd mass_matrix(const Eigen::VectorXd& q) {
    const Eigen::MatrixXd units = Eigen::MatrixXd::Identity(q.size(), q.size());
    Eigen::MatrixXd matrix(q.size(), q.size());
    for (Eigen::Index j = 0; j < q.size(); ++j) {
      matrix.col(j) = solve(weightless_solver_, q, Eigen::VectorXd::Zero(q.size()), units.col(j));
    }
    return matrix;
  }

 private:
  [[nodiscard]] Eigen::VectorXd solve(KDL::TreeIdSolver_RNE& solver, const Eigen::VectorXd& q,
                                      const Eigen::VectorXd& v, const Eigen::VectorXd& a) const {
    const unsigned n = tree_.getNrOfJoints();
    KDL::JntArray all_q(n), all_v(n), all_a(n), effort(n);
    all_q.data = coupling_ * q + offset_;
    all_v.data = coupling_ * v;
    all_a.data = coupling_ * a;
    if (solver.CartToJnt(all_q, all_v, all_a, {}, effort) != 0) {
      throw std::logic_error("KDL's tree solver fails");
    }
    return coupling_.transpose() * effort.data;
  }

  KDL::Tree tree_;
  KDL::TreeIdSolver_RNE solver_, weightless_solver_;
  Eigen::MatrixXd coupling_;  ///< from the joints that can be commanded to all that move
  Eigen::VectorXd offset_;
};

}  // namespace support

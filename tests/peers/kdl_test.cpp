// SPDX-License-Identifier: Apache-2.0
// The same robots in the Orocos Kinematics and Dynamics Library, which was written by others.
#include "peers/kdl.hpp"
#include "catch.hpp"
#include "eigen.hpp"
#include "robots/random_robots.hpp"

#include <articula/dynamics/dynamics.hpp>
#include <articula/robots/q2d.hpp>

#include <kdl/chaindynparam.hpp>
#include <kdl/chainjnttojacsolver.hpp>
#include <kdl/treefksolverpos_recursive.hpp>
#include <kdl/treeidsolver_recursive_newton_euler.hpp>

#include <string>
#include <vector>

using namespace articula;
using support::distance;
using support::to_kdl;

namespace {

/// Both libraries add up some hundred products, each off by 1.1e-16 of the largest terms, which
/// cancel in part: 1e-12 of the size of the result or of 1, whichever is larger.
constexpr double rounding = 1e-12;

void check_close(const Eigen::MatrixXd& ours, const Eigen::MatrixXd& theirs) {
  CHECK(distance(ours, theirs) <= rounding * (1 + theirs.norm()));
}

/// Ours in the order of KDL's joints.
template <int N>
struct Order {
  std::array<unsigned, std::size_t{N}> place{};

  Order(const Model<N>& robot, const KDL::Tree& tree) {
    for (const auto& [name, element] : tree.getSegments()) {
      for (std::size_t i = 0; i < place.size(); ++i) {
        if (robot.joints[i].name.view() == element.segment.getJoint().getName()) {
          place[i] = element.q_nr;
        }
      }
    }
  }
  [[nodiscard]] KDL::JntArray to_kdl(const JointVector<N>& v) const {
    KDL::JntArray array(N);
    for (std::size_t i = 0; i < place.size(); ++i) array(place[i]) = v[static_cast<int>(i)];
    return array;
  }
  [[nodiscard]] JointVector<N> from_kdl(const KDL::JntArray& array) const {
    JointVector<N> v;
    for (std::size_t i = 0; i < place.size(); ++i) v[static_cast<int>(i)] = array(place[i]);
    return v;
  }
};

/// The Jacobian of a link, which KDL has for the chain from the root to it.
template <int N>
void check_jacobian(const Model<N>& robot, const JointVector<N>& q, const KDL::Tree& tree,
                    const Name& root, const Name& link) {
  KDL::Chain chain;
  REQUIRE(tree.getChain(std::string(root.view()), std::string(link.view()), chain));
  std::vector<int> moving;  // the joints of the chain
  for (const KDL::Segment& segment : chain.segments) {
    if (segment.getJoint().getType() == KDL::Joint::None) continue;
    moving.push_back(joint_index(robot, segment.getJoint().getName()));
  }
  KDL::JntArray chain_q(chain.getNrOfJoints());
  for (unsigned i = 0; i < chain_q.rows(); ++i) chain_q(i) = q[moving[i]];
  KDL::Jacobian theirs(chain.getNrOfJoints());
  if (!moving.empty()) REQUIRE(KDL::ChainJntToJacSolver(chain).JntToJac(chain_q, theirs) == 0);
  LinkJacobian<N> expected = LinkJacobian<N>::Zero();
  for (unsigned i = 0; i < chain_q.rows(); ++i) expected.col(moving[i]) = theirs.data.col(i);
  check_close(jacobian(robot, q, link), expected);
}

/// Inverse dynamics, placements and Jacobians of the links of any tree.
template <int N>
void check_tree(const support::Blueprint& blueprint, const Name& root, support::Random& random) {
  const Model<N> robot = blueprint.model<N>();
  const KDL::Tree tree = to_kdl(blueprint, root);
  REQUIRE(tree.getNrOfJoints() == N);
  const Order<N> order(robot, tree);
  KDL::TreeIdSolver_RNE solver(tree, to_kdl(blueprint.gravity));
  KDL::TreeFkSolverPos_recursive kinematics(tree);
  for (int k = 0; k < 5; ++k) {
    const JointVector<N> q = random.vector<N>(3), v = random.vector<N>(3), a = random.vector<N>(10);
    KDL::JntArray effort(N);
    const std::map<std::string, KDL::Wrench> no_forces;
    REQUIRE(solver.CartToJnt(order.to_kdl(q), order.to_kdl(v), order.to_kdl(a), no_forces,
                             effort) == 0);
    check_close(inverse_dynamics(robot, q, v, a), order.from_kdl(effort));
    for (const Link& link : blueprint.links) {
      KDL::Frame frame;
      if (link.name == root) continue;
      REQUIRE(kinematics.JntToCart(order.to_kdl(q), frame, std::string(link.name.view())) == 0);
      const Eigen::Isometry3d ours = forward_kinematics(robot, q, link.name);
      check_close(ours.translation(), Eigen::Map<const Eigen::Vector3d>(frame.p.data));
      check_close(ours.linear(),
                  Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(frame.M.data));
      check_jacobian(robot, q, tree, root, link.name);
    }
  }
}

/// Mass matrix, Coriolis and gravity efforts, which KDL has for chains alone.
template <int N>
void check_chain(const support::Blueprint& blueprint, const Name& root, const Name& tip,
                 support::Random& random) {
  const Model<N> robot = blueprint.model<N>();
  KDL::Chain chain;
  REQUIRE(
      to_kdl(blueprint, root).getChain(std::string(root.view()), std::string(tip.view()), chain));
  REQUIRE(chain.getNrOfJoints() == N);
  KDL::ChainDynParam solver(chain, to_kdl(blueprint.gravity));
  for (int k = 0; k < 5; ++k) {
    const JointVector<N> q = random.vector<N>(3), v = random.vector<N>(3);
    KDL::JntArray kdl_q(N), kdl_v(N), coriolis(N), weight(N);
    kdl_q.data = q;
    kdl_v.data = v;
    KDL::JntSpaceInertiaMatrix mass(N);
    REQUIRE(solver.JntToMass(kdl_q, mass) == 0);
    REQUIRE(solver.JntToCoriolis(kdl_q, kdl_v, coriolis) == 0);
    REQUIRE(solver.JntToGravity(kdl_q, weight) == 0);
    check_close(mass_matrix(robot, q), mass.data);
    check_close(gravity(robot, q), weight.data);
    check_close(nonlinear_effects(robot, q, v), coriolis.data + weight.data);
  }
}

const Name& tip_of(const support::Blueprint& chain) {
  for (const Link& link : chain.links) {
    bool carries = false;
    for (const Joint& joint : chain.joints) carries = carries || joint.parent == link.name;
    if (!carries) return link.name;
  }
  throw std::logic_error("a chain ends");
}

}  // namespace

TEST_CASE("KDL has the same dynamics of the Q2D, upright and tilted") {
  const unsigned seed = 901;
  CAPTURE(seed);
  support::Random random(seed);
  support::Blueprint robot = support::blueprint_of(Q2d::description);
  for (int k = 0; k < 50; ++k) {
    check_tree<2>(robot, "origin_link", random);
    check_chain<2>(robot, "origin_link", "tool_link", random);
    robot.gravity = random.vector3(9.81);
  }
}

TEMPLATE_TEST_CASE_SIG("KDL has the same dynamics of random trees and chains", "", ((int N), N), 1,
                       2, 4, 7) {
  const unsigned seed = 910 + N;
  CAPTURE(seed, N);
  support::Random random(seed);
  for (int k = 0; k < 30; ++k) {
    check_tree<N>(support::random_robot(random, N), "root", random);
    const support::Blueprint chain = support::random_robot(random, N, support::Shape::chain);
    check_chain<N>(chain, "root", tip_of(chain), random);
  }
}

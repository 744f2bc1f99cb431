// SPDX-License-Identifier: Apache-2.0
#include "peer.hpp"
#include "peers/kdl_robot.hpp"

#include <kdl/chaindynparam.hpp>
#include <kdl/chainfdsolver_recursive_newton_euler.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainidsolver_recursive_newton_euler.hpp>
#include <kdl/chainjnttojacsolver.hpp>
#include <kdl/tree.hpp>
#include <kdl/treeidsolver_recursive_newton_euler.hpp>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>

namespace peers {
namespace {

using support::to_kdl;

/// The inertia of a segment and of all that fixed joints hold on it, about the origin of its frame.
KDL::RigidBodyInertia inertia_with(const KDL::SegmentMap::const_iterator& segment,
                                   const std::string& next) {
  KDL::RigidBodyInertia inertia = segment->second.segment.getInertia();
  for (const auto& child : segment->second.children) {
    if (child->first == next) continue;
    inertia = inertia + child->second.segment.pose(0) * inertia_with(child, next);
  }
  return inertia;
}

/// The chain with the most segments that holds all moving joints, if there is one. What is fixed
/// beside it (the other finger of a gripper) is added to the segment that carries it: a chain of
/// KDL would leave it out.
std::optional<KDL::Chain> whole_chain(const KDL::Tree& tree) {
  KDL::Chain longest;
  for (const auto& [tip, element] : tree.getSegments()) {
    KDL::Chain chain;
    tree.getChain(tree.getRootSegment()->first, tip, chain);
    if (chain.getNrOfJoints() < tree.getNrOfJoints()) continue;
    if (chain.getNrOfSegments() > longest.getNrOfSegments()) longest = chain;
  }
  if (longest.getNrOfSegments() == 0) return {};
  KDL::Chain whole;
  for (unsigned i = 0; i < longest.getNrOfSegments(); ++i) {
    KDL::Segment segment = longest.getSegment(i);
    const bool last = i + 1 == longest.getNrOfSegments();
    segment.setInertia(inertia_with(tree.getSegment(segment.getName()),
                                    last ? "" : longest.getSegment(i + 1).getName()));
    whole.addSegment(segment);
  }
  return whole;
}

/// For each joint of KDL its number in articula's order.
std::vector<std::size_t> order_of(const KDL::Tree& tree, const std::vector<std::string>& names) {
  std::vector<std::size_t> order(tree.getNrOfJoints());
  for (const auto& [name, element] : tree.getSegments()) {
    const KDL::Joint& joint = element.segment.getJoint();
    if (joint.getType() == KDL::Joint::None) continue;
    const auto found = std::find(names.begin(), names.end(), joint.getName());
    order[element.q_nr] = static_cast<std::size_t>(found - names.begin());
  }
  return order;
}

/// A state in KDL's types.
struct KdlState {
  KDL::JntArray q, v, a, effort;
};

std::vector<KdlState> convert(const std::vector<State>& states,
                              const std::vector<std::size_t>& order) {
  std::vector<KdlState> converted;
  for (const State& state : states) {
    const auto array = [&](const Numbers& numbers) {
      KDL::JntArray result(static_cast<unsigned>(numbers.size()));
      for (unsigned i = 0; i < result.rows(); ++i) result(i) = numbers[order[i]];
      return result;
    };
    converted.push_back({array(state.q), array(state.v), array(state.a), array(state.effort)});
  }
  return converted;
}

void require(int error) {
  if (error < 0) throw std::runtime_error("a solver of KDL fails");
}

[[nodiscard]] KDL::Chain chain_to(const KDL::Tree& tree, const std::string& link) {
  KDL::Chain chain;
  tree.getChain(tree.getRootSegment()->first, link, chain);
  return chain;
}

/// The kinematics of a link, by KDL's solvers for the chain that leads to it.
class KdlLink {
 public:
  /// @param names   of all joints in articula's order
  KdlLink(const KDL::Tree& tree, const std::string& link, const std::vector<std::string>& names,
          const std::vector<State>& states)
      : chain_(chain_to(tree, link)),
        place_solver_(chain_),
        jacobian_solver_(chain_),
        joints_(names.size()),
        jacobian_(chain_.getNrOfJoints()) {
    for (const KDL::Segment& segment : chain_.segments) {
      if (segment.getJoint().getType() == KDL::Joint::None) continue;
      const auto found = std::find(names.begin(), names.end(), segment.getJoint().getName());
      order_.push_back(static_cast<std::size_t>(found - names.begin()));
    }
    for (const State& state : states) {
      KDL::JntArray q(chain_.getNrOfJoints());
      for (unsigned i = 0; i < q.rows(); ++i) q(i) = state.q[order_[i]];
      positions_.push_back(q);
    }
  }

  void place(std::size_t state) { require(place_solver_.JntToCart(positions_[state], place_)); }
  void move(std::size_t state) { require(jacobian_solver_.JntToJac(positions_[state], jacobian_)); }
  [[nodiscard]] Numbers result(Operation operation) const {
    Numbers numbers;
    if (operation == Operation::forward_kinematics) {
      for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) numbers.push_back(place_.M(row, column));
      }
      numbers.insert(numbers.end(), place_.p.data, place_.p.data + 3);
    } else {
      numbers.resize(6 * joints_);
      for (unsigned i = 0; i < jacobian_.columns(); ++i) {
        for (unsigned row = 0; row < 6; ++row) numbers[6 * order_[i] + row] = jacobian_(row, i);
      }
    }
    return numbers;
  }

 private:
  KDL::Chain chain_;  // solvers keep a reference
  KDL::ChainFkSolverPos_recursive place_solver_;
  KDL::ChainJntToJacSolver jacobian_solver_;
  std::size_t joints_;
  std::vector<std::size_t> order_{};
  std::vector<KDL::JntArray> positions_{};
  KDL::Frame place_{};
  KDL::Jacobian jacobian_;
};

/// What a robot in KDL is made of.
struct KdlRobot {
  KDL::Tree tree;
  KDL::Vector gravity;
  std::vector<std::string> joints;  ///< their names in articula's order
  std::string link;
};

/// What both kinds of solvers share.
class KdlPeer : public Peer {
 public:
  KdlPeer(const KdlRobot& robot, const std::vector<State>& states)
      : order_(order_of(robot.tree, robot.joints)),
        states_(convert(states, order_)),
        numbers_(static_cast<unsigned>(order_.size())),
        link_(robot.tree, robot.link, robot.joints, states) {}

  void run(Operation operation, std::size_t state) final {
    if (operation == Operation::forward_kinematics) return link_.place(state);
    if (operation == Operation::jacobian) return link_.move(state);
    run_dynamics(operation, state);
  }
  [[nodiscard]] Numbers result(Operation operation) const final {
    if (operation == Operation::forward_kinematics || operation == Operation::jacobian) {
      return link_.result(operation);
    }
    return result_of_dynamics(operation);
  }

 protected:
  virtual void run_dynamics(Operation operation, std::size_t state) = 0;
  [[nodiscard]] virtual Numbers result_of_dynamics(Operation) const { return numbers_of(numbers_); }
  [[nodiscard]] Numbers numbers_of(const KDL::JntArray& array) const {
    Numbers numbers(order_.size());
    for (unsigned i = 0; i < array.rows(); ++i) numbers[order_[i]] = array(i);
    return numbers;
  }

  std::vector<std::size_t> order_;  ///< in ours, of KDL's joints
  std::vector<KdlState> states_;
  KDL::JntArray numbers_;  ///< efforts or accelerations of the last run

 private:
  KdlLink link_;
};

class KdlTree final : public KdlPeer {
 public:
  KdlTree(const KdlRobot& robot, const std::vector<State>& states)
      : KdlPeer(robot, states),
        tree_(robot.tree),
        solver_(tree_, robot.gravity),
        zero_(tree_.getNrOfJoints()) {}

  [[nodiscard]] bool offers(Operation operation) const override {
    return operation == Operation::inverse_dynamics || operation == Operation::gravity ||
           operation == Operation::forward_kinematics || operation == Operation::jacobian;
  }

 private:
  void run_dynamics(Operation operation, std::size_t index) override {
    const KdlState& s = states_[index];
    const bool moves = operation == Operation::inverse_dynamics;
    require(solver_.CartToJnt(s.q, moves ? s.v : zero_, moves ? s.a : zero_, no_forces_, numbers_));
  }

  KDL::Tree tree_;  // solvers keep a reference
  KDL::TreeIdSolver_RNE solver_;
  KDL::JntArray zero_;
  KDL::WrenchMap no_forces_{};
};

class KdlChain final : public KdlPeer {
 public:
  /// @pre joints of a chain are in the order of ours
  KdlChain(const KDL::Chain& chain, const KdlRobot& robot, const std::vector<State>& states)
      : KdlPeer(robot, states),
        chain_(chain),
        inverse_(chain_, robot.gravity),
        parameters_(chain_, robot.gravity),
        forward_(chain_, robot.gravity),
        no_forces_(chain.getNrOfSegments(), KDL::Wrench::Zero()),
        matrix_(static_cast<int>(chain.getNrOfJoints())),
        q_(chain.getNrOfJoints()),
        v_(chain.getNrOfJoints()) {
    for (KDL::JntArray& array : slopes_) array.resize(chain.getNrOfJoints());
  }

  [[nodiscard]] bool offers(Operation) const override { return true; }

 private:
  void run_dynamics(Operation operation, std::size_t index) override {
    const KdlState& s = states_[index];
    switch (operation) {
      case Operation::inverse_dynamics:
        return require(inverse_.CartToJnt(s.q, s.v, s.a, no_forces_, numbers_));
      case Operation::gravity:
        return require(parameters_.JntToGravity(s.q, numbers_));
      case Operation::mass_matrix:
        return require(parameters_.JntToMass(s.q, matrix_));
      case Operation::forward_dynamics:
        return require(forward_.CartToJnt(s.q, s.v, s.effort, no_forces_, numbers_));
      case Operation::step:
        return step(s);
      default:
        return;
    }
  }
  [[nodiscard]] Numbers result_of_dynamics(Operation operation) const override {
    if (operation == Operation::mass_matrix) {
      return {matrix_.data.data(), matrix_.data.data() + matrix_.data.size()};
    }
    if (operation != Operation::step) return numbers_of(numbers_);
    Numbers numbers = numbers_of(q_);
    for (const double x : numbers_of(v_)) numbers.push_back(x);
    return numbers;
  }

  /// The classical Runge-Kutta step around KDL's forward dynamics; its own integrator is not of
  /// fourth order.
  void step(const KdlState& s) {
    auto& [a1, a2, a3, a4, v2, v3, v4] = slopes_;
    const double h = step_time;
    const auto accelerate = [&](KDL::JntArray& a) {
      require(forward_.CartToJnt(q_, v_, s.effort, no_forces_, a));
    };
    q_.data = s.q.data;
    v_.data = s.v.data;
    accelerate(a1);
    q_.data = s.q.data + h / 2 * s.v.data;
    v_.data = v2.data = s.v.data + h / 2 * a1.data;
    accelerate(a2);
    q_.data = s.q.data + h / 2 * v2.data;
    v_.data = v3.data = s.v.data + h / 2 * a2.data;
    accelerate(a3);
    q_.data = s.q.data + h * v3.data;
    v_.data = v4.data = s.v.data + h * a3.data;
    accelerate(a4);
    q_.data = s.q.data + h / 6 * (s.v.data + 2 * (v2.data + v3.data) + v4.data);
    v_.data = s.v.data + h / 6 * (a1.data + 2 * (a2.data + a3.data) + a4.data);
  }

  KDL::Chain chain_;  // solvers keep a reference
  KDL::ChainIdSolver_RNE inverse_;
  KDL::ChainDynParam parameters_;
  KDL::ChainFdSolver_RNE forward_;
  KDL::Wrenches no_forces_;
  KDL::JntSpaceInertiaMatrix matrix_;
  KDL::JntArray q_, v_;
  std::array<KDL::JntArray, 7> slopes_{};
};

}  // namespace

std::unique_ptr<Peer> kdl(const support::Blueprint& robot, const std::vector<std::string>& joints,
                          const std::string& link, const std::vector<State>& states) {
  const KdlRobot ours{to_kdl(robot, support::root_of(robot)), to_kdl(robot.gravity), joints, link};
  if (const auto chain = whole_chain(ours.tree)) {
    return std::make_unique<KdlChain>(*chain, ours, states);
  }
  return std::make_unique<KdlTree>(ours, states);
}

}  // namespace peers

// SPDX-License-Identifier: Apache-2.0
#include "peer.hpp"

#include <kdl/chaindynparam.hpp>
#include <kdl/chainfdsolver_recursive_newton_euler.hpp>
#include <kdl/chainidsolver_recursive_newton_euler.hpp>
#include <kdl/tree.hpp>
#include <kdl/treeidsolver_recursive_newton_euler.hpp>

#include <stdexcept>
#include <string>

namespace peers {
namespace {

KDL::Vector to_kdl(const articula::Vector3<double>& a) { return {a.x, a.y, a.z}; }

KDL::Segment to_kdl(const std::string& name, const articula::Body& body) {
  const auto& [x, y, z] = body.placement.rotation.rows;
  const KDL::Frame frame(KDL::Rotation(x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z),
                         to_kdl(body.placement.translation));
  const KDL::Joint joint(name, frame.p, frame.M.UnitZ(),
                         body.prismatic ? KDL::Joint::TransAxis : KDL::Joint::RotAxis);
  const auto& [mass, first_moment, i] = body.inertia;
  const KDL::Vector c = to_kdl(first_moment) / mass;
  const double xx = i.xx - mass * (c.y() * c.y() + c.z() * c.z()),
               yy = i.yy - mass * (c.x() * c.x() + c.z() * c.z()),
               zz = i.zz - mass * (c.x() * c.x() + c.y() * c.y());
  const KDL::RotationalInertia about_center(xx, yy, zz, i.xy + mass * c.x() * c.y(),
                                            i.xz + mass * c.x() * c.z(),
                                            i.yz + mass * c.y() * c.z());
  const KDL::RigidBodyInertia inertia(mass, c, about_center);
  return KDL::Segment(name, joint, frame, inertia);
}

/// KDL numbers joints in the order in which they are added.
KDL::Tree to_kdl(std::span<const articula::Body> bodies) {
  KDL::Tree tree("root");
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const std::string parent = bodies[i].parent < 0 ? "root" : std::to_string(bodies[i].parent);
    if (!tree.addSegment(to_kdl(std::to_string(i), bodies[i]), parent)) {
      throw std::runtime_error("KDL refuses a segment");
    }
  }
  return tree;
}

/// A state in KDL's types.
struct KdlState {
  KDL::JntArray q, v, a, effort;
};

std::vector<KdlState> convert(const std::vector<State>& states) {
  std::vector<KdlState> converted;
  for (const State& state : states) {
    const auto array = [](const Numbers& numbers) {
      KDL::JntArray result(static_cast<unsigned>(numbers.size()));
      for (unsigned i = 0; i < result.rows(); ++i) result(i) = numbers[i];
      return result;
    };
    converted.push_back({array(state.q), array(state.v), array(state.a), array(state.effort)});
  }
  return converted;
}

void require(int error) {
  if (error < 0) throw std::runtime_error("a solver of KDL fails");
}

/// What both kinds of solvers share.
class KdlPeer : public Peer {
 public:
  KdlPeer(unsigned joints, const std::vector<State>& states)
      : states_(convert(states)), numbers_(joints) {}

  [[nodiscard]] Numbers result(Operation) const override { return numbers_of(numbers_); }

 protected:
  [[nodiscard]] static Numbers numbers_of(const KDL::JntArray& array) {
    return {array.data.begin(), array.data.end()};
  }

  std::vector<KdlState> states_;
  KDL::JntArray numbers_;  ///< efforts or accelerations of the last run
};

class KdlTree final : public KdlPeer {
 public:
  KdlTree(const KDL::Tree& tree, const KDL::Vector& gravity, const std::vector<State>& states)
      : KdlPeer(tree.getNrOfJoints(), states),
        tree_(tree),
        solver_(tree_, gravity),
        zero_(tree.getNrOfJoints()) {}

  [[nodiscard]] bool offers(Operation operation) const override {
    return operation == Operation::inverse_dynamics || operation == Operation::gravity;
  }
  void run(Operation operation, std::size_t index) override {
    const KdlState& s = states_[index];
    const bool moves = operation == Operation::inverse_dynamics;
    require(solver_.CartToJnt(s.q, moves ? s.v : zero_, moves ? s.a : zero_, no_forces_, numbers_));
  }

 private:
  KDL::Tree tree_;  // solvers keep a reference
  KDL::TreeIdSolver_RNE solver_;
  KDL::JntArray zero_;
  KDL::WrenchMap no_forces_{};
};

class KdlChain final : public KdlPeer {
 public:
  KdlChain(const KDL::Chain& chain, const KDL::Vector& gravity, const std::vector<State>& states)
      : KdlPeer(chain.getNrOfJoints(), states),
        chain_(chain),
        inverse_(chain_, gravity),
        parameters_(chain_, gravity),
        forward_(chain_, gravity),
        no_forces_(chain.getNrOfSegments(), KDL::Wrench::Zero()),
        matrix_(static_cast<int>(chain.getNrOfJoints())),
        q_(chain.getNrOfJoints()),
        v_(chain.getNrOfJoints()) {
    for (KDL::JntArray& array : slopes_) array.resize(chain.getNrOfJoints());
  }

  [[nodiscard]] bool offers(Operation) const override { return true; }

  void run(Operation operation, std::size_t index) override {
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
    }
  }
  [[nodiscard]] Numbers result(Operation operation) const override {
    if (operation == Operation::mass_matrix) {
      return {matrix_.data.data(), matrix_.data.data() + matrix_.data.size()};
    }
    if (operation != Operation::step) return numbers_of(numbers_);
    Numbers numbers = numbers_of(q_);
    for (const double x : numbers_of(v_)) numbers.push_back(x);
    return numbers;
  }

 private:
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

std::unique_ptr<Peer> kdl(std::span<const articula::Body> bodies,
                          const articula::Vector3<double>& gravity,
                          const std::vector<State>& states) {
  const KDL::Tree tree = to_kdl(bodies);
  KDL::Chain chain;
  tree.getChain("root", std::to_string(bodies.size() - 1), chain);
  if (chain.getNrOfJoints() == bodies.size()) {
    return std::make_unique<KdlChain>(chain, to_kdl(gravity), states);
  }
  return std::make_unique<KdlTree>(tree, to_kdl(gravity), states);
}

}  // namespace peers

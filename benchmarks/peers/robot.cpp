// SPDX-License-Identifier: Apache-2.0
// A robot, PEERS_ROBOT with the link PEERS_LINK, in articula and in other libraries: first a check
// that all give the same, then a case for each library and operation, named
// <operation>/<robot>/<library>.
#include "../after_sleep.hpp"
#include "peer.hpp"

#include <articula/dynamics/dynamics.hpp>
#include <articula/sim/runge_kutta.hpp>
#include PEERS_ROBOT_HEADER

#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include <string>

namespace {

using namespace articula;
using peers::Numbers, peers::Operation;

/// The robot with every joint free: the peers know no joints that follow others exactly.
struct Robot {
  static constexpr auto description = [] {
    auto free = PEERS_ROBOT::description;
    for (Joint& joint : free.joints) joint.mimic = {};
    return free;
  }();
};

constexpr Name link = PEERS_LINK;
constexpr int n = joint_count<Robot>;
using Vector = JointVector<n>;

struct Sample {
  Vector q, v, a, effort;
};

/// Random states, and efforts that suit the accelerations.
std::vector<Sample> make_samples() {
  std::mt19937 engine(1);
  const auto vector = [&](double size) {
    Vector v;
    for (double& x : v) x = std::uniform_real_distribution<double>(-size, size)(engine);
    return v;
  };
  std::vector<Sample> samples;
  for (int i = 0; i < 256; ++i) {
    Sample s{vector(3), vector(3), vector(10), {}};
    s.effort = inverse_dynamics(Robot{}, s.q, s.v, vector(10));
    samples.push_back(s);
  }
  return samples;
}

Numbers numbers_of(const Eigen::MatrixXd& values) {
  return {values.data(), values.data() + values.size()};
}

std::vector<peers::State> states_of(const std::vector<Sample>& samples) {
  std::vector<peers::State> states;
  for (const auto& [q, v, a, effort] : samples) {
    states.push_back({numbers_of(q), numbers_of(v), numbers_of(a), numbers_of(effort)});
  }
  return states;
}

template <Operation operation, class R>
[[gnu::always_inline]] inline auto work(const R& robot, const Sample& s) {
  if constexpr (operation == Operation::inverse_dynamics) {
    return inverse_dynamics(robot, s.q, s.v, s.a);
  } else if constexpr (operation == Operation::gravity) {
    return gravity(robot, s.q);
  } else if constexpr (operation == Operation::mass_matrix) {
    return mass_matrix(robot, s.q);
  } else if constexpr (operation == Operation::forward_dynamics) {
    return forward_dynamics(robot, s.q, s.v, s.effort);
  } else if constexpr (operation == Operation::forward_kinematics) {
    constexpr LinkIndex tip = link_index(Robot{}, link);
    if constexpr (DescribedRobot<R>) {
      return forward_kinematics<link>(robot, s.q);
    } else {
      return forward_kinematics(robot, s.q, tip);
    }
  } else if constexpr (operation == Operation::jacobian) {
    constexpr LinkIndex tip = link_index(Robot{}, link);
    if constexpr (DescribedRobot<R>) {
      return jacobian<link>(robot, s.q);
    } else {
      return jacobian(robot, s.q, tip);
    }
  } else {
    return runge_kutta_step<n>({s.q, s.v}, peers::step_time, [&](const Vector& q, const Vector& v) {
      return forward_dynamics(robot, q, v, s.effort);
    });
  }
}

Numbers numbers_of(const JointState<n>& motion) {
  Numbers numbers = numbers_of(motion.position);
  for (const double x : motion.velocity) numbers.push_back(x);
  return numbers;
}

Numbers numbers_of(const Eigen::Isometry3d& place) {
  Numbers numbers = numbers_of(Eigen::MatrixXd(place.linear()));
  for (const double x : place.translation()) numbers.push_back(x);
  return numbers;
}

void compare(const std::string& name, const Numbers& ours, const Numbers& theirs,
             double tolerance) {
  double difference = 0, size = 1;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    difference += (ours[i] - theirs[i]) * (ours[i] - theirs[i]);
    size += theirs[i] * theirs[i];
  }
  if (!(std::sqrt(difference / size) <= tolerance)) {
    throw std::runtime_error(name + " is off by " + std::to_string(std::sqrt(difference / size)));
  }
}

/// All that is measured, with the robot and the libraries that do it.
class Cases {
 public:
  explicit Cases(const std::string& robot) : robot_(robot) {
    add<Operation::inverse_dynamics>();
    add<Operation::gravity>();
    add<Operation::mass_matrix>();
    add<Operation::forward_dynamics>();
    add<Operation::step>();
    add<Operation::forward_kinematics>();
    add<Operation::jacobian>();
    if (robot_ == "panda") {
      register_after_sleep("clock/panda/none", [](std::size_t) {});
      add_after_sleep<Operation::inverse_dynamics>();
      add_after_sleep<Operation::forward_dynamics>();
    }
  }

 private:
  struct NamedPeer {
    std::string name;
    double tolerance;  ///< MuJoCo's inertias are right to about 1e-7 only
    std::unique_ptr<peers::Peer> peer;
  };

  [[nodiscard]] std::string name_of(Operation operation) const {
    return std::string(peers::operation_names[static_cast<std::size_t>(operation)]) + "/" + robot_ +
           "/";
  }

  template <Operation operation>
  void add() {
    const std::string name = name_of(operation);
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const Numbers ours = numbers_of(work<operation>(Robot{}, samples_[i]));
      compare(name + "model", ours, numbers_of(work<operation>(model_, samples_[i])), 1e-9);
      for (const NamedPeer& other : peers_) {
        if (!other.peer->offers(operation)) continue;
        other.peer->run(operation, i);
        compare(name + other.name, ours, other.peer->result(operation), other.tolerance);
      }
    }
    add_ours<operation>(name + "described", described_);
    add_ours<operation>(name + "model", model_);
    for (const NamedPeer& other : peers_) {
      if (!other.peer->offers(operation)) continue;
      benchmark::RegisterBenchmark((name + other.name).c_str(),
                                   [this, peer = other.peer.get()](benchmark::State& bench) {
                                     std::size_t i = 0;
                                     for (auto _ : bench) {
                                       peer->run(operation, i++ % samples_.size());
                                       benchmark::ClobberMemory();
                                     }
                                   });
    }
  }
  /// The same calls as in a loop that sleeps until its next cycle.
  template <Operation operation>
  void add_after_sleep() {
    const auto add_robot = [&](const std::string& name, const auto& robot) {
      register_after_sleep(name_of(operation) + name, [this, &robot](std::size_t i) {
        auto result = work<operation>(robot, samples_[i % samples_.size()]);
        benchmark::DoNotOptimize(result);
      });
    };
    add_robot("described", described_);
    add_robot("model", model_);
    for (const NamedPeer& other : peers_) {
      if (!other.peer->offers(operation)) continue;
      register_after_sleep(name_of(operation) + other.name,
                           [this, peer = other.peer.get()](std::size_t i) {
                             peer->run(operation, i % samples_.size());
                             benchmark::ClobberMemory();
                           });
    }
  }

  template <Operation operation, class R>
  void add_ours(const std::string& name, const R& robot) {
    benchmark::RegisterBenchmark(name.c_str(), [this, &robot](benchmark::State& bench) {
      std::size_t i = 0;
      for (auto _ : bench) {
        auto result = work<operation>(robot, samples_[i++ % samples_.size()]);
        benchmark::DoNotOptimize(result);
      }
    });
  }

  std::string robot_;
  Robot described_{};
  std::vector<Sample> samples_ = make_samples();
  std::vector<peers::State> states_ = states_of(samples_);
  std::remove_cvref_t<decltype(model_of(Robot{}))> model_ = model_of(Robot{});
  std::vector<std::string> names_ = [] {
    const auto names = joint_names(Robot{});
    return std::vector<std::string>(names.begin(), names.end());
  }();
  std::span<const Body> bodies_ = model_.mechanism.bodies;
  Vector3<double> gravity_ = Robot::description.gravity;
  LinkFrame frame_ = model_.links[link_index(Robot{}, link).value];
  std::array<NamedPeer, 3> peers_{
      NamedPeer{"kdl", 1e-9,
                peers::kdl(support::blueprint_of(Robot::description), names_,
                           std::string(link.view()), states_)},
      NamedPeer{"mujoco", 1e-5,
                peers::mujoco(bodies_, gravity_, frame_, states_, peers::Pipeline::whole)},
      NamedPeer{"mujoco_shortest", 1e-5,
                peers::mujoco(bodies_, gravity_, frame_, states_, peers::Pipeline::shortest)}};
};

const Cases cases(PEERS_NAME);  // NOLINT: benchmarks are registered before main

}  // namespace

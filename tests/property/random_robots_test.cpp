// SPDX-License-Identifier: Apache-2.0
// What is true of every robot, tried on random ones: trees of revolute, continuous, prismatic,
// fixed and mimic joints.
#include "robots/random_robots.hpp"
#include "catch.hpp"
#include "eigen.hpp"
#include "numbers.hpp"
#include "robots/any_robot.hpp"
#include "robots/textbook_robot.hpp"
#include "slope.hpp"

#include <Eigen/Eigenvalues>

#include <memory>
#include <utility>

using namespace articula;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using support::Blueprint;
using support::distance;
using support::slope;
using support::TextbookRobot;

namespace {

/// Some hundred roundings of 1.1e-16 of the largest terms, which cancel in part.
constexpr double rounding = 1e-12;
/// slope's error for robots whose energies change some ten times faster than q, to the fifth power.
constexpr double by_differences = 1e-7;

bool close(const MatrixXd& a, const MatrixXd& b, double tolerance = rounding) {
  return distance(a, b) <= tolerance * (1 + b.norm());
}
bool close(double a, double b, double tolerance = rounding) {
  return std::abs(a - b) <= tolerance * (1 + std::abs(b));
}

/// One robot in one state.
struct Trial {
  Blueprint blueprint;
  std::unique_ptr<support::AnyRobot> robot;
  VectorXd q{}, v{}, a{}, effort{};

  explicit Trial(Blueprint description)
      : blueprint(std::move(description)), robot(support::any_robot(blueprint)) {}

  [[nodiscard]] Eigen::Index size() const { return q.size(); }
  [[nodiscard]] VectorXd zero() const { return VectorXd::Zero(size()); }
  [[nodiscard]] VectorXd unit(Eigen::Index j) const { return VectorXd::Unit(size(), j); }

  void next_state(support::Random& random) {
    const auto joints = static_cast<Eigen::Index>(robot->joint_names().size());
    q = random.vector(joints, 3);
    v = random.vector(joints, 2);
    a = random.vector(joints, 5);
    effort = random.vector(joints, 20);
  }
  /// The slope of f(q, v) with time, along the motion that the effort causes.
  template <class Function>
  [[nodiscard]] double along_motion(const Function& f) const {
    const VectorXd acceleration = robot->forward_dynamics(q, v, effort);
    return slope([&](double t) -> double { return f(q + t * v, v + t * acceleration); });
  }
};

/// Free joints and moving bodies of the robots that are tried.
constexpr std::pair<int, int> sizes[] = {{1, 1}, {2, 2}, {3, 3}, {4, 4}, {5, 5}, {6, 6},
                                         {7, 7}, {8, 8}, {1, 2}, {3, 5}, {5, 8}};

/// @param robots  of each size
/// @param states  of each robot
template <class Check>
void on_random_robots(unsigned seed, int robots, int states, const Check& check) {
  support::Random random(seed);
  for (const auto& [joints, bodies] : sizes) {
    for (int robot = 0; robot < robots; ++robot) {
      Trial trial(support::random_robot(random, bodies, support::Shape::tree, bodies - joints));
      for (int state = 0; state < states; ++state) {
        trial.next_state(random);
        CAPTURE(seed, joints, bodies, robot, state);
        check(trial);
      }
    }
  }
}

}  // namespace

TEST_CASE("dynamics agree with each other") {
  on_random_robots(401, 40, 25, [](const Trial& t) {
    const auto inverse = t.robot->inverse_dynamics(t.q, t.v, t.a);
    const auto mass = t.robot->mass_matrix(t.q);
    const auto bias = t.robot->nonlinear_effects(t.q, t.v);
    const VectorXd zero = t.zero();
    CHECK(close(inverse, mass * t.a + bias));
    CHECK(close(t.robot->inverse_dynamics(t.q, zero, zero), t.robot->gravity(t.q)));
    CHECK(close(t.robot->nonlinear_effects(t.q, zero), t.robot->gravity(t.q)));
    CHECK(close(t.robot->kinetic_energy(t.q, t.v), t.v.dot(mass * t.v) / 2));
    // What has to come back: 1e-10, as a mass matrix may be conditioned like 1e4.
    const auto acceleration = t.robot->forward_dynamics(t.q, t.v, t.effort);
    CHECK(close(t.robot->inverse_dynamics(t.q, t.v, acceleration), t.effort, 1e-10));
    CHECK(close(t.robot->forward_dynamics(t.q, t.v, inverse), t.a, 1e-10));
  });
}

TEST_CASE("the mass matrix is symmetric and positive definite") {
  on_random_robots(402, 40, 25, [](const Trial& t) {
    const MatrixXd mass = t.robot->mass_matrix(t.q);
    // Mimic joints add up rows and columns in different order.
    CHECK(close(mass, mass.transpose(), 1e-15));
    CHECK(Eigen::SelfAdjointEigenSolver<MatrixXd>(mass).eigenvalues().minCoeff() > 0);
  });
}

TEST_CASE("kinematics and energies are the textbook's") {
  on_random_robots(403, 20, 5, [](const Trial& t) {
    const TextbookRobot textbook(t.blueprint, t.robot->joint_names());
    CHECK(close(t.robot->mass_matrix(t.q), textbook.mass_matrix(t.q)));
    CHECK(close(t.robot->potential_energy(t.q) - t.robot->potential_energy(t.zero()),
                textbook.potential_energy(t.q) - textbook.potential_energy(t.zero()),
                1e-11));  // differences of some hundred J
    for (const Link& link : t.blueprint.links) {
      CAPTURE(link.name.view());
      CHECK(close(t.robot->forward_kinematics(t.q, link.name).matrix(),
                  textbook.placement(link.name, t.q).matrix(), 1e-14));
    }
  });
}

TEST_CASE("links move as their positions change") {
  // The kinetic energy, from how forward_kinematics changes with time alone.
  on_random_robots(404, 20, 5, [](const Trial& t) {
    double energy = 0;
    for (const Link& link : t.blueprint.links) {
      const Eigen::Isometry3d pose = t.robot->forward_kinematics(t.q, link.name);
      const Eigen::Matrix4d rate = slope([&](double time) -> Eigen::Matrix4d {
        return t.robot->forward_kinematics(t.q + time * t.v, link.name).matrix();
      });
      const Eigen::Vector3d velocity =
          (rate * support::to_eigen(link.center_of_mass).homogeneous()).head<3>();
      const Eigen::Matrix3d spin = pose.linear().transpose() * rate.topLeftCorner<3, 3>();
      const Eigen::Vector3d angular(spin(2, 1), spin(0, 2), spin(1, 0));
      const Eigen::Vector3d turned =
          support::rotation_of_rpy(link.inertia_orientation).transpose() * angular;
      energy += link.mass * velocity.squaredNorm() / 2 +
                turned.dot(support::to_eigen(link.inertia) * turned) / 2;
    }
    CHECK(close(t.robot->kinetic_energy(t.q, t.v), energy, by_differences));
  });
}

TEST_CASE("gravity is the slope of the potential energy") {
  on_random_robots(405, 20, 10, [](const Trial& t) {
    VectorXd expected = t.zero();
    for (Eigen::Index j = 0; j < t.size(); ++j) {
      expected[j] = slope([&](double s) { return t.robot->potential_energy(t.q + s * t.unit(j)); });
    }
    CHECK(close(t.robot->gravity(t.q), expected, by_differences));
  });
}

TEST_CASE("Coriolis efforts are Lagrange's, by slopes of the textbook's mass matrix") {
  on_random_robots(406, 10, 2, [](const Trial& t) {
    const TextbookRobot textbook(t.blueprint, t.robot->joint_names());
    const MatrixXd rate = slope([&](double s) { return textbook.mass_matrix(t.q + s * t.v); });
    VectorXd expected = rate * t.v;
    for (Eigen::Index j = 0; j < t.size(); ++j) {
      expected[j] -= slope(
          [&](double s) { return t.v.dot(textbook.mass_matrix(t.q + s * t.unit(j)) * t.v) / 2; });
    }
    CHECK(close(t.robot->nonlinear_effects(t.q, t.v) - t.robot->gravity(t.q), expected,
                by_differences));
  });
}

TEST_CASE("the power of the drives is the change of energy") {
  on_random_robots(407, 20, 10, [](const Trial& t) {
    const double change = t.along_motion([&](const auto& q, const auto& v) {
      return t.robot->kinetic_energy(q, v) + t.robot->potential_energy(q);
    });
    CHECK(close(t.v.dot(t.effort), change, by_differences));
  });
}

TEST_CASE("Coriolis efforts do no work but for the changing mass matrix") {
  // v'(dM/dt - 2 C) v = 0, where C v = h - g.
  on_random_robots(408, 20, 10, [](const Trial& t) {
    const MatrixXd rate = slope([&](double s) { return t.robot->mass_matrix(t.q + s * t.v); });
    const VectorXd coriolis = t.robot->nonlinear_effects(t.q, t.v) - t.robot->gravity(t.q);
    CHECK(close(2 * t.v.dot(coriolis), t.v.dot(rate * t.v), by_differences));
  });
}

TEST_CASE("momentum about a joint on the base changes by that joint's effort alone") {
  // Turning or sliding all that a joint on the base carries changes no energy where gravity has no
  // moment about (or force along) it, so that this row of M v obeys dp/dt = effort.
  on_random_robots(409, 20, 2, [](const Trial& t) {
    if (t.robot->joint_names().size() !=
        static_cast<std::size_t>(model_size(t.blueprint.joints).bodies))
      return;
    const Body& first = t.robot->first_body();
    REQUIRE(first.parent == -1);
    Blueprint blueprint = t.blueprint;
    blueprint.gravity = 9.81 * first.placement.rotation.column(first.prismatic ? 0 : 2);
    const auto robot = support::any_robot(blueprint);
    const VectorXd acceleration = robot->forward_dynamics(t.q, t.v, t.effort);
    const double change = slope([&](double s) -> double {
      return robot->mass_matrix(t.q + s * t.v).row(0).dot(t.v + s * acceleration);
    });
    CHECK(close(t.effort[0], change, by_differences));
  });
}

TEST_CASE("momentum is conserved along a whole motion without efforts") {
  // Gravity along the first axis. Integrated by the midpoint rule in halved steps the drift falls
  // by about 4 each time, so that what there is comes from the integrator.
  const unsigned seed = 410;
  CAPTURE(seed);
  support::Random random(seed);
  const auto turns_first = [](const Trial& t) { return !t.robot->first_body().prismatic; };
  Trial t(support::random_robot(random, 4));
  while (!turns_first(t)) t = Trial(support::random_robot(random, 4));
  t.blueprint.gravity = 9.81 * t.robot->first_body().placement.rotation.column(2);
  const auto robot = support::any_robot(t.blueprint);
  t.next_state(random);
  const auto momentum = [&](const VectorXd& q, const VectorXd& v) {
    return robot->mass_matrix(q).row(0).dot(v);
  };
  const auto drift = [&](int steps) {
    const double h = 0.2 / steps;
    VectorXd q = t.q, v = t.v;
    for (int k = 0; k < steps; ++k) {
      const VectorXd half_q = q + h / 2 * v;
      const VectorXd half_v = v + h / 2 * robot->forward_dynamics(q, v, t.zero());
      q += h * half_v;
      v += h * robot->forward_dynamics(half_q, half_v, t.zero());
    }
    return std::abs(momentum(q, v) - momentum(t.q, t.v)) / std::abs(momentum(t.q, t.v));
  };
  CHECK(drift(2000) < 1e-5);
  CHECK(drift(4000) < drift(2000) / 3);
  CHECK(drift(8000) < drift(4000) / 3);
}

TEST_CASE("tiny positions and velocities are as good as none") {
  on_random_robots(411, 10, 1, [](const Trial& t) {
    for (double tiny : {0.0, support::smallest, 1e-160}) {
      const VectorXd x = VectorXd::Constant(t.size(), tiny);
      CHECK(close(t.robot->inverse_dynamics(x, x, x), t.robot->gravity(t.zero())));
      CHECK(t.robot->kinetic_energy(x, x) >= 0);
    }
  });
}

TEST_CASE("NaN and infinity in any joint's acceleration or effort stay visible") {
  on_random_robots(412, 10, 1, [](const Trial& t) {
    for (double bad : {support::not_a_number, support::infinity}) {
      for (Eigen::Index j = 0; j < t.size(); ++j) {
        VectorXd x = t.a;
        x[j] = bad;
        CHECK_FALSE(t.robot->inverse_dynamics(t.q, t.v, x).allFinite());
        CHECK_FALSE(t.robot->forward_dynamics(t.q, t.v, x).allFinite());
      }
    }
  });
}

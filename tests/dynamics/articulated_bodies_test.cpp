// SPDX-License-Identifier: Apache-2.0
#include "articula/dynamics/articulated_bodies.hpp"

#include "articula/dynamics/dynamics.hpp"
#include "articula/robots/q2d.hpp"
#include "articula/robots/ur10.hpp"
#include "catch.hpp"
#include "robots/random_robots.hpp"

#include <array>
#include <cstddef>
#include <utility>

using namespace articula;

namespace {

constexpr std::array<const char*, 15> names{"a", "b", "c", "d", "e", "f", "g", "h",
                                            "i", "j", "k", "l", "m", "n", "o"};

constexpr Link link(std::size_t i) {
  const double mass = i == 0 ? 0 : 2 + 0.1 * static_cast<double>(i);
  const double inertia = i == 0 ? 0 : 0.5;
  return {.name = names[i],
          .mass = mass,
          .center_of_mass = {0.05, 0, 0.1},
          .inertia = {.xx = inertia, .yy = inertia, .zz = inertia},
          .inertia_orientation = {0, 0, 0}};
}

constexpr Joint joint(std::size_t i) {
  return {.name = names[i],
          .type = JointType::continuous,
          .parent = names[i],
          .child = names[i + 1],
          .origin = {0.3, 0, 0.2},
          .orientation = {i % 2 == 0 ? 1.5707963267948966 : -1.5707963267948966, 0, 0},
          .axis = {0, 0, 1},
          .reflected_inertia = 0.1};
}

template <class>
struct Snake;
template <std::size_t... I>
struct Snake<std::index_sequence<I...>> {
  static constexpr RobotDescription<sizeof...(I) + 1, sizeof...(I)> description{
      .name = "snake", .links = {link(0), link(I + 1)...}, .joints = {joint(I)...}};
};

/// Says which of two algorithms was run.
template <int Which>
struct Told {
  static constexpr int smallest_model = 12;
  template <int N, int B>
  [[nodiscard]] static constexpr bool pays_for_numbers(const Mechanism<N, B>& mechanism) noexcept {
    return ArticulatedBodies::pays_for_numbers(mechanism);
  }
  template <class S, int N, int B>
  [[nodiscard]] static constexpr int evaluate(const Mechanism<N, B>&, const Configuration<S, B>&,
                                              const JointArray<S, N>&) noexcept {
    return Which;
  }
};
struct Either : Told<1> {
  using Alternative = Told<2>;
};

using ShortSnake = Snake<std::make_index_sequence<4>>;
using LongSnake = Snake<std::make_index_sequence<14>>;

template <class R, class Algorithm>
int cost() {
  return compiled::detail::program_in<Algorithm, R, compiled::detail::frames_for<Algorithm, R>()>
      .operations()
      .cost();
}

}  // namespace

TEST_CASE("articulated bodies accelerate as the factorised mass matrix says") {
  constexpr unsigned seed = 1;
  CAPTURE(seed);
  support::Random random(seed);
  for (int trial = 0; trial < 300; ++trial) {
    CAPTURE(trial);
    const auto shape = trial % 2 == 0 ? support::Shape::chain : support::Shape::tree;
    support::Blueprint robot = support::random_robot(random, 6, shape, 0);
    for (Joint& each : robot.joints) {
      if (each.type != JointType::fixed && trial % 3 == 0) {
        each.reflected_inertia = random.number(0, 1);
      }
    }
    const Model<6> model = robot.model<6>();
    const JointVector<6> q = random.vector<6>(3), v = random.vector<6>(2),
                         effort = random.vector<6>(10);
    const JointVector<6> expected = forward_dynamics(model, q, v, effort);
    const auto a = detail::to_vector(detail::evaluate<ArticulatedBodies>(model, q, v, effort));
    // Mass matrices are conditioned like 1e4 at worst; some hundred roundings.
    CHECK((a - expected).norm() <= 1e-10 * (1 + expected.norm()));
  }
}

TEST_CASE(
    "the cheaper one is taken: articulated bodies for a long chain, factors for a short one") {
  CHECK(cost<LongSnake, ArticulatedBodies>() < cost<LongSnake, ForwardDynamics>());
  CHECK(operations<ForwardDynamics, LongSnake>().cost() == cost<LongSnake, ArticulatedBodies>());
  CHECK(cost<ShortSnake, ForwardDynamics>() < cost<ShortSnake, ArticulatedBodies>());
  CHECK(operations<ForwardDynamics, ShortSnake>().cost() == cost<ShortSnake, ForwardDynamics>());
  CHECK(cost<Ur10, ForwardDynamics>() < cost<Ur10, ArticulatedBodies>());
  CHECK(operations<ForwardDynamics, Ur10>().cost() == cost<Ur10, ForwardDynamics>());
}

TEST_CASE("a long chain accelerates as its efforts demand") {
  constexpr unsigned seed = 2;
  CAPTURE(seed);
  support::Random random(seed);
  for (int trial = 0; trial < 50; ++trial) {
    const JointVector<14> q = random.vector<14>(3), v = random.vector<14>(1),
                          a = random.vector<14>(5);
    const JointVector<14> effort = inverse_dynamics(LongSnake{}, q, v, a);
    // Efforts of some hundred N m; the mass matrix is conditioned like 1e4.
    CHECK((forward_dynamics(LongSnake{}, q, v, effort) - a).norm() <= 1e-9);
  }
}

TEST_CASE("articulated bodies are not tried where joints are tied otherwise than by the tree") {
  support::Random random(3);
  support::Blueprint robot = support::random_robot(random, 12, support::Shape::chain, 0);
  CHECK(ArticulatedBodies::may_pay(robot.model<12>().canonical));
  Joint *first = nullptr, *last = nullptr;
  for (Joint& each : robot.joints) {
    if (each.type == JointType::fixed) continue;
    each.reflected_inertia = 1;
    (first ? last : first) = &each;
  }
  first->shared_rotors = {last->name, 0.5};
  REQUIRE(robot.fault().rule == Rule::none);
  CHECK_FALSE(ArticulatedBodies::may_pay(robot.model<12>().canonical));
  const support::Blueprint mimic = support::random_robot(random, 14, support::Shape::chain, 1);
  CHECK_FALSE(ArticulatedBodies::may_pay(mimic.model<13, 14>().canonical));
  CHECK_FALSE(ArticulatedBodies::may_pay(
      support::random_robot(random, 10, support::Shape::chain, 0).model<10>().canonical));
}

TEST_CASE("models take articulated bodies where they take less time") {
  support::Random random(4);
  const auto taken = [&]<int N>(std::integral_constant<int, N>, support::Shape shape, int mimics) {
    const auto model = support::random_robot(random, N, shape, mimics).model<N>();
    const JointVector<N> q = JointVector<N>::Zero();
    return detail::evaluate<Either>(model, q, q);
  };
  using support::Shape;
  CHECK(taken(std::integral_constant<int, 7>{}, Shape::chain, 0) == 1);
  CHECK(taken(std::integral_constant<int, 11>{}, Shape::chain, 0) == 1);
  CHECK(taken(std::integral_constant<int, 12>{}, Shape::chain, 0) == 2);
  CHECK(taken(std::integral_constant<int, 24>{}, Shape::chain, 0) == 2);
  CHECK(taken(std::integral_constant<int, 60>{}, Shape::tree, 0) == 2);
  CHECK(taken(std::integral_constant<int, 14>{}, Shape::tree, 0) == 1);  // too bushy to pay
}

TEST_CASE("large models accelerate as their efforts demand") {
  constexpr unsigned seed = 5;
  CAPTURE(seed);
  support::Random random(seed);
  constexpr int n = 24;
  for (int trial = 0; trial < 20; ++trial) {
    CAPTURE(trial);
    const Model<n> model =
        support::random_robot(random, n, trial % 2 ? support::Shape::chain : support::Shape::tree)
            .model<n>();
    using Many = JointVectors<n, 3>;
    const Many q = random.vector<n>(3).replicate<1, 3>(), v = random.vector<n>(1).replicate<1, 3>(),
               effort = random.vector<n>(20).replicate<1, 3>();
    const JointVector<n> own_q = q.col(0), own_v = v.col(0), own_effort = effort.col(0);
    const JointVector<n> a = forward_dynamics(model, own_q, own_v, own_effort);
    const JointMatrix<n> matrix = mass_matrix(model, own_q);
    const JointVector<n> demanded = matrix * a + nonlinear_effects(model, own_q, own_v);
    // Some thousand roundings of terms as large as the matrix times the acceleration.
    CHECK((demanded - own_effort).norm() <= 1e-11 * (1 + matrix.norm() * a.norm()));
    CHECK((forward_dynamics(model, q, v, effort).col(2) - a).norm() <= 1e-8 * a.norm());
  }
}

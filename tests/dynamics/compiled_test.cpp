// SPDX-License-Identifier: Apache-2.0
#include "articula/dynamics/engine/compiled.hpp"

#include "articula/dynamics/dynamics.hpp"
#include "articula/robots/panda.hpp"
#include "articula/robots/q2d.hpp"
#include "articula/robots/ur10.hpp"
#include "catch.hpp"
#include "robots/oddity.hpp"
#include "robots/random_mechanism.hpp"

#include <vector>

#if __has_include(<xsimd/xsimd.hpp>)
#include <xsimd/xsimd.hpp>
#endif

using namespace articula;  // NOLINT

namespace {

template <class Result>
std::vector<double> numbers_of(Result result) {
  std::vector<double> numbers;
  symbolic::for_each_scalar<double>(result, [&](double& x) { numbers.push_back(x); });
  return numbers;
}

/// A program and its algorithm's text on the mechanism as it is, at random states. Some thousand
/// operations on numbers up to about 1e3, each off by 1e-16 of its size.
template <class Algorithm, class R, class... Inputs>
void check_program(test::Randomness& random, const Inputs&... inputs) {
  constexpr int n = joint_count<R>, b = compiled::detail::ModelOf<R>::body_count;
  const Mechanism<n, b>& mechanism = model_of(R{}).mechanism;
  const auto q = random.numbers<n>(-3, 3);
  const auto configuration = configuration_of<double, n, b>(mechanism, q);
  const auto expected =
      numbers_of(Algorithm::template evaluate<double, n, b>(mechanism, configuration, inputs...));
  const auto result = numbers_of(compiled::run<Algorithm, R>(q, inputs...));
  REQUIRE(result.size() == expected.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    CAPTURE(i);
    CHECK(result[i] == Approx(expected[i]).epsilon(1e-11).margin(1e-11));
  }
}

template <class Algorithm, class R>
constexpr bool takes(int multiplications, int additions) {
  constexpr auto counts = operations<Algorithm, R>();
  return counts.multiplications <= multiplications && counts.additions <= additions;
}

}  // namespace

TEMPLATE_TEST_CASE("Programs compute what their algorithms compute", "", Q2d, Ur10, Panda,
                   support::Oddity) {
  using R = TestType;
  constexpr int n = joint_count<R>;
  test::Randomness random(1);
  for (int trial = 0; trial < 500; ++trial) {
    const auto v = random.numbers<n>(-2, 2), x = random.numbers<n>(-5, 5);
    check_program<InverseDynamics, R>(random, v, x);
    check_program<NonlinearEffects, R>(random, v);
    check_program<Gravity, R>(random);
    check_program<MassMatrix, R>(random);
    check_program<ForwardDynamics, R>(random, v, x);
    check_program<KineticEnergy, R>(random, v);
    check_program<PotentialEnergy, R>(random);
    check_program<BodyPlacements, R>(random);
  }
}

TEST_CASE("Programs take no more operations than promised") {
  STATIC_REQUIRE(takes<InverseDynamics, Q2d>(19, 11));
  STATIC_REQUIRE(takes<Gravity, Q2d>(0, 0));
  STATIC_REQUIRE(takes<MassMatrix, Q2d>(4, 3));
  STATIC_REQUIRE(takes<ForwardDynamics, Q2d>(22, 12));
  STATIC_REQUIRE(operations<ForwardDynamics, Q2d>().divisions == 1);

  STATIC_REQUIRE(takes<InverseDynamics, Ur10>(137, 109));
  STATIC_REQUIRE(takes<NonlinearEffects, Ur10>(110, 79));
  STATIC_REQUIRE(takes<Gravity, Ur10>(3, 4));
  STATIC_REQUIRE(takes<MassMatrix, Ur10>(38, 48));
  STATIC_REQUIRE(takes<ForwardDynamics, Ur10>(192, 189));
  STATIC_REQUIRE(operations<InverseDynamics, Ur10>().sines == 5);

  STATIC_REQUIRE(takes<InverseDynamics, Panda>(287, 274));
  STATIC_REQUIRE(takes<NonlinearEffects, Panda>(279, 257));
  STATIC_REQUIRE(takes<Gravity, Panda>(60, 36));
  STATIC_REQUIRE(takes<MassMatrix, Panda>(162, 155));
  STATIC_REQUIRE(takes<ForwardDynamics, Panda>(555, 510));
}

TEST_CASE("Results do not depend on the frames in which they are calculated") {
  constexpr int n = 9;
  test::Randomness random(2);
  for (int trial = 0; trial < 200; ++trial) {
    CAPTURE(trial);
    const Mechanism<n> tree = canonical_form(random.mechanism<n>()).mechanism;
    const auto q = random.numbers<n>(-3, 3), v = random.numbers<n>(-2, 2),
               x = random.numbers<n>(-5, 5);
    const auto moving = configuration_of<double, n, n>(tree, q);
    const auto resting = configuration_of<double, n, n, Frames::resting>(tree, q);
    const auto compare = [](const auto& a, const auto& b) {
      const auto expected = numbers_of(a), result = numbers_of(b);
      for (std::size_t i = 0; i < expected.size(); ++i) {
        CHECK(result[i] == Approx(expected[i]).epsilon(1e-11).margin(1e-10));
      }
    };
    compare(InverseDynamics::evaluate(tree, moving, v, x),
            InverseDynamics::evaluate(tree, resting, v, x));
    compare(Gravity::evaluate(tree, moving), Gravity::evaluate(tree, resting));
    compare(MassMatrix::evaluate(tree, moving), MassMatrix::evaluate(tree, resting));
    compare(KineticEnergy::evaluate(tree, moving, v), KineticEnergy::evaluate(tree, resting, v));
  }
}

#if __has_include(<xsimd/xsimd.hpp>)
TEST_CASE("A program runs for a pack of robots at once") {
  using Pack = xsimd::batch<double>;
  constexpr int n = 7;
  test::Randomness random(3);
  std::array<std::array<JointArray<double, n>, Pack::size>, 3> states;
  for (auto& robots : states) {
    for (auto& numbers : robots) numbers = random.numbers<n>(-2, 2);
  }
  const auto pack = [&](std::size_t which) {
    JointArray<Pack, n> packed;
    for (int i = 0; i < n; ++i) {
      alignas(64) std::array<double, Pack::size> lanes;
      for (std::size_t k = 0; k < lanes.size(); ++k) lanes[k] = states[which][k][i];
      packed[i] = Pack::load_unaligned(lanes.data());
    }
    return packed;
  };
  const auto packed = compiled::run<ForwardDynamics, Panda>(pack(0), pack(1), pack(2));
  for (std::size_t k = 0; k < Pack::size; ++k) {
    const auto single =
        compiled::run<ForwardDynamics, Panda>(states[0][k], states[1][k], states[2][k]);
    for (int i = 0; i < n; ++i) {
      CHECK(packed[i].get(k) == Approx(single[i]).epsilon(1e-11).margin(1e-11));
    }
  }
}
#endif

// SPDX-License-Identifier: Apache-2.0
/// @file Described robots that look like none of the ready ones: what the compiler makes of them
/// does the same as the algorithms' own texts.
#include "catch.hpp"
#include "robots/random_mechanism.hpp"

#include <articula/dynamics/dynamics.hpp>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

using namespace articula;

namespace {

constexpr std::array<std::string_view, 7> names{"base", "a", "b", "c", "d", "e", "f"};

/// How a body is joined to the one that carries it.
struct Step {
  JointType type;
  Vector3<double> axis;
  std::size_t parent;  ///< by its place in `names`
};

/// Bodies that are alike, each on the joint that its step says.
template <std::size_t N>
constexpr auto robot_of(std::string_view name, const std::array<Step, N>& steps,
                        Vector3<double> gravity) {
  RobotDescription<N + 1, N> robot{.name = name, .gravity = gravity};
  robot.links[0].name = names[0];
  for (std::size_t i = 0; i < N; ++i) {
    robot.links[i + 1] = {.name = names[i + 1],
                          .mass = 1 + 0.1 * static_cast<double>(i),
                          .center_of_mass = {0.1, 0.2, 0.3},
                          .inertia = {.xx = 0.5, .xy = 0.01, .yy = 0.6, .yz = -0.02, .zz = 0.7}};
    robot.joints[i] = {.name = names[i + 1],
                       .type = steps[i].type,
                       .parent = names[steps[i].parent],
                       .child = names[i + 1],
                       .origin = {0.3, 0.1, 0.2},
                       .axis = steps[i].axis};
    if (steps[i].type == JointType::prismatic) robot.joints[i].limits = {-1, 1, 1, 1};
  }
  return robot;
}

constexpr auto slides = JointType::prismatic, turns = JointType::continuous;
constexpr Vector3<double> x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, oblique{1, 2, 3}, across{-3, 1, 2};

/// A machine tool: a table that slides two ways and turns twice, and a spindle that slides beside
/// it.
struct MachineTool {
  static constexpr auto description =
      robot_of("machine_tool",
               std::to_array<Step>(
                   {{slides, x, 0}, {slides, y, 1}, {turns, z, 2}, {turns, x, 3}, {slides, z, 0}}),
               {0, 0, -9.81});
};

/// All axes vertical: gravity asks for no effort, so that it cannot tell which frames are better.
struct Scara {
  static constexpr auto description = robot_of("scara",
                                               std::to_array<Step>({{turns, z, 0},
                                                                    {turns, z, 1},
                                                                    {turns, z, 2},
                                                                    {turns, z, 3},
                                                                    {turns, z, 4},
                                                                    {turns, z, 5}}),
                                               {0, 0, -9.81});
};

/// No axis parallel or perpendicular to another.
struct Oblique {
  static constexpr auto description =
      robot_of("oblique",
               std::to_array<Step>(
                   {{turns, oblique, 0}, {turns, across, 1}, {slides, oblique, 2}, {turns, y, 3}}),
               {1, 2, -9});
};

/// Three arms on one base, which itself falls nowhere.
struct Tripod {
  static constexpr auto description = robot_of("tripod",
                                               std::to_array<Step>({{turns, x, 0},
                                                                    {turns, y, 1},
                                                                    {slides, z, 0},
                                                                    {turns, x, 3},
                                                                    {slides, y, 0},
                                                                    {turns, z, 5}}),
                                               {0, 0, 0});
};

/// The rounding of some thousand operations on numbers up to about 1e3.
constexpr double tolerance = 1e-11;

template <class Algorithm, class R, class... Inputs>
void compare(const JointArray<double, joint_count<R>>& q, const Inputs&... inputs) {
  constexpr int n = joint_count<R>;
  const auto& mechanism = model_of(R{}).mechanism;
  auto expected = Algorithm::template evaluate<double, n, n>(
      mechanism, configuration_of<double, n, n>(mechanism, q), inputs...);
  auto result = compiled::run<Algorithm, R>(q, inputs...);
  std::vector<double> a, b;
  symbolic::for_each_scalar<double>(expected, [&](double& number) { a.push_back(number); });
  symbolic::for_each_scalar<double>(result, [&](double& number) { b.push_back(number); });
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    CAPTURE(R::description.name.view(), i);
    CHECK(b[i] == Approx(a[i]).epsilon(tolerance).margin(tolerance));
  }
}

/// The cheaper of an algorithm's programs in both kinds of frames.
template <class Algorithm, class R>
constexpr int least_cost =
    std::min(compiled::detail::program_in<Algorithm, R, Frames::moving>.operations().cost(),
             compiled::detail::program_in<Algorithm, R, Frames::resting>.operations().cost());

static_assert(operations<MassMatrix, Scara>().cost() == least_cost<MassMatrix, Scara>);
static_assert(operations<InverseDynamics, Scara>().cost() == least_cost<InverseDynamics, Scara>);
static_assert(operations<ForwardDynamics, Tripod>().cost() == least_cost<ForwardDynamics, Tripod>);
// Vertical axes: the mass moves in a plane, and angles are added (moving frames: 127 and 133).
static_assert(operations<MassMatrix, Scara>().multiplications <= 88);
static_assert(operations<Gravity, Scara>().cost() == 0 &&
              operations<Gravity, Tripod>().cost() == 0);

}  // namespace

TEMPLATE_TEST_CASE("Programs of unusual robots do what their algorithms say", "", MachineTool,
                   Scara, Oblique, Tripod) {
  constexpr int n = joint_count<TestType>;
  test::Randomness random(11);
  for (int trial = 0; trial < 100; ++trial) {
    const auto q = random.numbers<n>(-3, 3), v = random.numbers<n>(-3, 3),
               a = random.numbers<n>(-9, 9);
    compare<Gravity, TestType>(q);
    compare<InverseDynamics, TestType>(q, v, a);
    compare<MassMatrix, TestType>(q);
    compare<ForwardDynamics, TestType>(q, v, a);
  }
}

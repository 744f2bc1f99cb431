// SPDX-License-Identifier: Apache-2.0
// Links named at compile time or at run time, on the way from the base alone, beside the placements
// of all bodies.
#include <articula/dynamics/dynamics.hpp>
#include <articula/robots/panda.hpp>
#include <articula/robots/pr2.hpp>
#include <articula/robots/q2d.hpp>
#include <articula/robots/ur10.hpp>

#include "catch.hpp"
#include "random.hpp"
#include "robots/oddity.hpp"
#include "robots/random_robots.hpp"

#include <utility>

using namespace articula;

namespace {

/// Where a link stands by the algorithm that places every body.
template <Robot R>
Eigen::Matrix4d placement_by_bodies(const R& robot, const JointVector<joint_count<R>>& q,
                                    LinkIndex link) {
  using AnyModel = std::remove_cvref_t<decltype(model_of(robot))>;
  constexpr int n = AnyModel::joint_count, b = AnyModel::body_count;
  const auto& mechanism = model_of(robot).mechanism;
  const LinkFrame& frame = model_of(robot).links[link.value];
  Placement<double> placement = frame.placement;
  if (frame.body >= 0) {
    const auto configuration = configuration_of<double, n, b>(mechanism, detail::to_array(q));
    const auto bodies = BodyPlacements::evaluate<double, n, b>(mechanism, configuration);
    placement = bodies[static_cast<std::size_t>(frame.body)] * placement;
  }
  return detail::to_isometry(placement).matrix();
}

/// By differences of those placements, in the middle of a step of 1e-5 either way: off by the
/// rounding of lengths of some metres over the step, and the square of the step.
template <Robot R>
LinkJacobian<joint_count<R>> jacobian_by_bodies(const R& robot,
                                                const JointVector<joint_count<R>>& q,
                                                LinkIndex link) {
  constexpr int n = joint_count<R>;
  constexpr double step = 1e-5;
  LinkJacobian<n> jacobian;
  const Eigen::Matrix4d here = placement_by_bodies(robot, q, link);
  for (int j = 0; j < n; ++j) {
    const JointVector<n> before = q - step * JointVector<n>::Unit(j),
                         after = q + step * JointVector<n>::Unit(j);
    const Eigen::Matrix4d rate =
        (placement_by_bodies(robot, after, link) - placement_by_bodies(robot, before, link)) /
        (2 * step);
    const Eigen::Matrix3d spin =
        rate.topLeftCorner<3, 3>() * here.topLeftCorner<3, 3>().transpose();
    jacobian.col(j) << rate.topRightCorner<3, 1>(), spin(2, 1), spin(0, 2), spin(1, 0);
  }
  return jacobian;
}

constexpr double slope_tolerance = 1e-8;
constexpr double rounding = 1e-14;  // sums and products of lengths up to a few metres

template <Name name, class R>
void check_named(const R& robot, const JointVector<joint_count<R>>& q) {
  CAPTURE(name.view());
  const LinkIndex link = link_index(robot, name);
  const Eigen::Matrix4d place = forward_kinematics<name>(robot, q).matrix();
  CHECK((place - placement_by_bodies(robot, q, link)).norm() <= rounding);
  CHECK((place - forward_kinematics(robot, q, link).matrix()).norm() <= rounding);
  CHECK((place - forward_kinematics(model_of(robot), q, link).matrix()).norm() <= rounding);
  const auto motion = jacobian<name>(robot, q);
  CHECK((motion - jacobian_by_bodies(robot, q, link)).norm() <= slope_tolerance);
  CHECK((motion - jacobian(robot, q, link)).norm() <= rounding);
  CHECK((motion - jacobian(model_of(robot), q, link)).norm() <= rounding);
}

template <class R>
void check_all_links(support::Random& random) {
  const auto q = random.vector<joint_count<R>>(3);
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    (check_named<R::description.links[I].name>(R{}, q), ...);
  }(std::make_index_sequence<R::description.links.size()>{});
}

/// A UR10 of which nobody knows the masses.
struct DrawnUr10 {
  static constexpr auto description = [] {
    auto drawn = Ur10::description;
    drawn.kinematic = true;
    for (Link& link : drawn.links) link = {.name = link.name};
    return drawn;
  }();
};

template <class Algorithm, class R>
constexpr bool takes(int multiplications, int additions, int sines) {
  constexpr auto counts = operations<Algorithm, R>();
  return counts.multiplications <= multiplications && counts.additions <= additions &&
         counts.sines <= sines;
}

}  // namespace

TEST_CASE("A link named at compile time stands and moves where its bodies carry it") {
  const unsigned seed = 451;
  CAPTURE(seed);
  support::Random random(seed);
  for (int trial = 0; trial < 50; ++trial) {
    CAPTURE(trial);
    check_all_links<Q2d>(random);
    check_all_links<support::Oddity>(random);
    check_named<"tool0">(Ur10{}, random.vector<6>(3));
    check_named<"forearm_link">(Ur10{}, random.vector<6>(3));
    check_named<"panda_hand_tcp">(Panda{}, random.vector<7>(3));
    const auto q = random.vector<joint_count<Pr2>>(1);
    check_named<"r_gripper_l_finger_tip_link">(Pr2{}, q);  // on joints that follow others
    check_named<"head_pan_link">(Pr2{}, q);
  }
}

TEST_CASE("A link of a long tree named at run time stands where its bodies carry it") {
  const unsigned seed = 452;
  CAPTURE(seed);
  support::Random random(seed);
  for (int trial = 0; trial < 20; ++trial) {
    // Sines are taken eight at a time: fewer, as many, and more on the way.
    const auto robot = support::random_robot(random, 19, support::Shape::chain, 1).model<18, 19>();
    const auto q = random.vector<18>(1);
    for (std::size_t i = 0; i < robot.links.size(); ++i) {
      CAPTURE(trial, i);
      const Eigen::Matrix4d expected = placement_by_bodies(robot, q, {i});
      const Eigen::Matrix4d place = forward_kinematics(robot, q, LinkIndex{i}).matrix();
      CHECK((place - expected).norm() <= 10 * rounding);  // 19 steps
      CHECK((jacobian(robot, q, LinkIndex{i}) - jacobian_by_bodies(robot, q, {i})).norm() <=
            10 * slope_tolerance);
    }
  }
}

TEST_CASE("The kinematics of a named link take no more operations than promised") {
  STATIC_REQUIRE(takes<PlacementOf<"tool0">, Ur10>(46, 28, 6));
  STATIC_REQUIRE(takes<JacobianOf<"tool0">, Ur10>(53, 28, 5));
  STATIC_REQUIRE(takes<PlacementOf<"panda_hand_tcp">, Panda>(92, 50, 7));
  STATIC_REQUIRE(takes<JacobianOf<"panda_hand_tcp">, Panda>(102, 53, 6));
  // Of thirty bodies those that move the gripper, no others; of the base nothing.
  STATIC_REQUIRE(operations<PlacementOf<"r_gripper_tool_frame">, Pr2>().sines == 7);
  STATIC_REQUIRE(operations<JacobianOf<"base_link">, Pr2>() == symbolic::OperationCounts{});
}

TEST_CASE("Named links need no masses") {
  const JointVector<6> q(0.3, -0.5, 1, 2, -1, 0.2);
  check_named<"tool0">(DrawnUr10{}, q);
  CHECK(jacobian<"tool0">(DrawnUr10{}, q) == jacobian<"tool0">(Ur10{}, q));
}

TEST_CASE("A program of a named link runs for a pack of robots") {
  constexpr int lanes = symbolic::lanes_of_a_register;
  using Pack = symbolic::Pack<lanes>;
  support::Random random(453);
  const JointVectors<6, lanes> q =
      JointVectors<6, lanes>::NullaryExpr([&] { return random.number(-3, 3); });
  JointArray<Pack, 6> packed;
  for (int i = 0; i < 6; ++i)
    packed[static_cast<std::size_t>(i)] = Pack::load(q.data() + i * lanes);
  const auto columns = compiled::run<JacobianOf<"tool0">, Ur10>(packed);
  for (int k = 0; k < lanes; ++k) {
    const auto alone = jacobian<"tool0">(Ur10{}, JointVector<6>(q.col(k)));
    for (int i = 0; i < 36; ++i) {
      CHECK(columns[static_cast<std::size_t>(i)][k] == Approx(alone.data()[i]).margin(rounding));
    }
  }
}

TEST_CASE("A position that is not finite stays visible in a named link") {
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK_FALSE(forward_kinematics<"tool0">(Ur10{}, {0, 0, infinity, 0, 0, 0}).matrix().allFinite());
  CHECK_FALSE(jacobian<"tool0">(Ur10{}, {0, 0, infinity, 0, 0, 0}).allFinite());
}

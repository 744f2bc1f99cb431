// SPDX-License-Identifier: Apache-2.0
#include "catch.hpp"
#include "eigen.hpp"
#include "random.hpp"

#include <articula/model/placement.hpp>

#include <cmath>
#include <numbers>

using namespace articula;
using support::distance;
using support::to_eigen;

namespace {

/// Some sums of three products of numbers up to 1, each off by 1.1e-16, over nine elements.
constexpr double rounding = 2e-15;

/// A proper rotation whose third column is the axis.
void check_turns_z_onto(const Eigen::Vector3d& axis) {
  const Eigen::Matrix3d r = to_eigen(rotation_of_z_onto({axis.x(), axis.y(), axis.z()}));
  CAPTURE(axis.transpose());
  CHECK(r.col(2) == axis);
  CHECK(distance(r * r.transpose(), Eigen::Matrix3d::Identity()) < rounding);
  CHECK(r.determinant() == Approx(1));
}

// Known to the compiler, and exact where it matters: zeros stay zeros in the dynamics.
constexpr double right_angle = std::numbers::pi / 2;
static_assert(rotation_from_rpy({0, 0, 0}) == Matrix3<double>::identity());
static_assert(rotation_from_rpy({0, 0, right_angle}) ==
              Matrix3<double>{{{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}}});
static_assert(rotation_from_rpy({right_angle, 0, 0}) ==
              Matrix3<double>{{{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}}});
static_assert(rotation_from_rpy({0, right_angle, 0}) ==
              Matrix3<double>{{{{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}}}});
static_assert(rotation_of_z_onto({0, 0, 1}) == Matrix3<double>::identity());

}  // namespace

TEST_CASE("rotation_from_rpy turns about x, then y, then z of the fixed frame") {
  const unsigned seed = 201;
  CAPTURE(seed);
  support::Random random(seed);
  for (double size : {1e-12, 0.1, 3.2, 50.0}) {
    for (int k = 0; k < 500; ++k) {
      const Vector3<double> rpy = random.vector3(size);
      CAPTURE(rpy.x, rpy.y, rpy.z);
      CHECK(distance(to_eigen(rotation_from_rpy(rpy)), support::rotation_of_rpy(rpy)) < rounding);
    }
  }
}

TEST_CASE("rotation_from_rpy of right angles holds only 0, 1 and -1") {
  for (int i = -4; i <= 4; ++i) {
    for (int j = -4; j <= 4; ++j) {
      for (int k = -4; k <= 4; ++k) {
        const Vector3<double> rpy{i * right_angle, j * right_angle, k * right_angle};
        const Eigen::Matrix3d expected = support::rotation_of_rpy(rpy).array().round();
        CAPTURE(i, j, k);
        CHECK(to_eigen(rotation_from_rpy(rpy)) == expected);
      }
    }
  }
}

TEST_CASE("rotation_from_rpy keeps small angles") {
  // Far above the 1e-15 that are taken for the rounding of a right angle; 1e-12 squared is nothing.
  const Matrix3<double> turn = rotation_from_rpy({1e-12, 0, 0});
  CHECK(turn.rows[2].y == Approx(1e-12).epsilon(1e-12));
}

TEST_CASE("rotation_of_z_onto a coordinate axis holds only 0, 1 and -1") {
  for (int k = 0; k < 3; ++k) {
    for (double sign : {1.0, -1.0}) {
      const Eigen::Vector3d axis = sign * Eigen::Vector3d::Unit(k);
      const Eigen::Matrix3d r = to_eigen(rotation_of_z_onto({axis.x(), axis.y(), axis.z()}));
      CAPTURE(k, sign);
      CHECK(r == Eigen::Matrix3d(r.array().round()));
      check_turns_z_onto(axis);
    }
  }
}

TEST_CASE("rotation_of_z_onto any axis is a rotation") {
  const unsigned seed = 202;
  CAPTURE(seed);
  support::Random random(seed);
  for (int k = 0; k < 1000; ++k) check_turns_z_onto(random.vector<3>(1).normalized());
  for (double tilt : {1e-300, 1e-160, 1e-16, 1e-8, 1e-3}) {  // nearly along a coordinate axis
    for (int k = 0; k < 3; ++k) {
      for (int along = 0; along < 3; ++along) {
        const Eigen::Vector3d axis = Eigen::Vector3d::Unit(k) - tilt * Eigen::Vector3d::Unit(along);
        check_turns_z_onto(axis.normalized());
      }
    }
  }
  check_turns_z_onto(Eigen::Vector3d(1, 1, 1).normalized());
  check_turns_z_onto(Eigen::Vector3d(-1, 1, 0).normalized());
}

TEST_CASE("placements chain as isometries do") {
  const unsigned seed = 203;
  CAPTURE(seed);
  support::Random random(seed);
  for (int k = 0; k < 200; ++k) {
    const Placement<double> a{rotation_from_rpy(random.vector3(3)), random.vector3(2)};
    const Placement<double> b{rotation_from_rpy(random.vector3(3)), random.vector3(2)};
    // Sums of three products of numbers up to 2, over twelve elements.
    CHECK(distance(to_eigen(a * b), to_eigen(a) * to_eigen(b)) < 5e-15);
    CHECK(distance(to_eigen(a * Placement<double>{}), to_eigen(a)) == 0);
    CHECK(distance(to_eigen(Placement<double>{} * a), to_eigen(a)) == 0);
  }
}

// SPDX-License-Identifier: Apache-2.0
#include "catch.hpp"
#include "eigen.hpp"
#include "random.hpp"

#include <articula/model/link.hpp>

#include <vector>

using namespace articula;
using support::distance;
using support::to_eigen;

namespace {

/// A body made of point masses, whose inertia anybody can add up.
struct Cloud {
  std::vector<double> masses{};
  std::vector<Eigen::Vector3d> points{};

  explicit Cloud(support::Random& random) {
    for (int k = 0; k < 5; ++k) {
      masses.push_back(random.number(0.1, 3));
      points.push_back(random.vector<3>(1));
    }
  }

  [[nodiscard]] Inertia<double> inertia() const {
    Inertia<double> sum;
    for (std::size_t k = 0; k < masses.size(); ++k) {
      const double m = masses[k], x = points[k].x(), y = points[k].y(), z = points[k].z();
      sum = sum + Inertia<double>{m,
                                  {m * x, m * y, m * z},
                                  {.xx = m * (y * y + z * z),
                                   .xy = -m * x * y,
                                   .xz = -m * x * z,
                                   .yy = m * (x * x + z * z),
                                   .yz = -m * y * z,
                                   .zz = m * (x * x + y * y)}};
    }
    return sum;
  }
  [[nodiscard]] Cloud seen_from(const Placement<double>& ab) const {
    Cloud cloud = *this;
    for (Eigen::Vector3d& point : cloud.points) point = to_eigen(ab) * point;
    return cloud;
  }
};

void check_equal(const Inertia<double>& a, const Inertia<double>& b) {
  // Masses sum up to 15 kg and points lie up to 4 m from the origin, so that moments reach 200 kg
  // m^2, of which some ten roundings of 1.1e-16 are 2e-13.
  CHECK(std::abs(a.mass - b.mass) < 1e-14);
  CHECK(distance(to_eigen(a.first_moment), to_eigen(b.first_moment)) < 1e-13);
  CHECK(distance(to_eigen(a.moment), to_eigen(b.moment)) < 5e-13);
}

}  // namespace

TEST_CASE("an inertia seen from another frame is that of the moved points") {
  const unsigned seed = 211;
  CAPTURE(seed);
  support::Random random(seed);
  for (int k = 0; k < 500; ++k) {
    const Cloud cloud(random);
    const Placement<double> ab{rotation_from_rpy(random.vector3(3)), random.vector3(2)};
    check_equal(moved(ab, cloud.inertia()), cloud.seen_from(ab).inertia());
    // And there and back again, in two steps.
    const Placement<double> bc{rotation_from_rpy(random.vector3(3)), random.vector3(1)};
    check_equal(moved(ab, moved(bc, cloud.inertia())), moved(ab * bc, cloud.inertia()));
  }
}

TEST_CASE("an inertia seen from the same frame is the same") {
  support::Random random(212);
  const Inertia<double> inertia = Cloud(random).inertia();
  const Inertia<double> same = moved({}, inertia);
  CHECK(same.mass == inertia.mass);
  CHECK(same.first_moment == inertia.first_moment);
  CHECK(same.moment == inertia.moment);
}

TEST_CASE("no mass stays no mass") {
  const Inertia<double> nothing =
      moved({rotation_from_rpy({1, 2, 3}), {4, 5, 6}}, Inertia<double>{});
  CHECK(nothing.mass == 0);
  CHECK(nothing.first_moment == Vector3<double>{});
  CHECK(nothing.moment == Symmetric3<double>{});
}

TEST_CASE("a rotated inertia is R I R'") {
  const unsigned seed = 213;
  CAPTURE(seed);
  support::Random random(seed);
  for (int k = 0; k < 500; ++k) {
    const Matrix3<double> r = rotation_from_rpy(random.vector3(3));
    const Symmetric3<double> i = Cloud(random).inertia().moment;
    const Eigen::Matrix3d expected = to_eigen(r) * to_eigen(i) * to_eigen(r).transpose();
    CHECK(distance(to_eigen(rotated(r, i)), expected) < 1e-13);  // moments up to 50 kg m^2
  }
}

TEST_CASE("a link's inertia about its origin: turned axes and Steiner's term") {
  const unsigned seed = 214;
  CAPTURE(seed);
  support::Random random(seed);
  for (int k = 0; k < 500; ++k) {
    const Link link{.name = "link",
                    .mass = random.number(0.1, 5),
                    .center_of_mass = random.vector3(2),
                    .inertia = Cloud(random).inertia().moment,
                    .inertia_orientation = random.vector3(3)};
    const Eigen::Vector3d c = to_eigen(link.center_of_mass);
    const Eigen::Matrix3d r = support::rotation_of_rpy(link.inertia_orientation);
    const Eigen::Matrix3d expected =
        r * to_eigen(link.inertia) * r.transpose() +
        link.mass * (c.squaredNorm() * Eigen::Matrix3d::Identity() - c * c.transpose());
    const Inertia<double> inertia = inertia_of(link);
    CHECK(inertia.mass == link.mass);
    CHECK(distance(to_eigen(inertia.first_moment), link.mass * c) < 1e-14);
    CHECK(distance(to_eigen(inertia.moment), expected) < 2e-13);  // moments up to 100 kg m^2
  }
}

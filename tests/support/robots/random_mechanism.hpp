// SPDX-License-Identifier: Apache-2.0
/// @file Mechanisms and joint states without any regularity, for tests of laws.
#pragma once

#include "articula/model/mechanism.hpp"

#include <array>
#include <cstddef>
#include <numbers>
#include <random>

namespace articula::test {

/// Draws mechanisms and numbers, the same ones in every run.
class Randomness {
 public:
  explicit Randomness(unsigned seed) : engine_(seed) {}

  double number(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  bool chance() { return number(0, 1) < 0.5; }
  Vector3<double> vector() { return {number(-1, 1), number(-1, 1), number(-1, 1)}; }

  template <int N>
  JointArray<double, N> numbers(double low, double high) {
    JointArray<double, N> values;
    for (double& value : values) value = number(low, high);
    return values;
  }

  /// Half of them by right angles, half of them by any.
  Matrix3<double> rotation() {
    const auto angle = [&] { return std::numbers::pi / 2 * static_cast<int>(number(0, 4)); };
    if (chance()) return rotation_from_rpy({angle(), angle(), angle()});
    return rotation_from_rpy(3.0 * vector());
  }

  /// That of three points with mass.
  Inertia<double> inertia() {
    Inertia<double> sum{};
    for (int i = 0; i < 3; ++i) {
      const Inertia<double> point{number(0.1, 2), {}, {}};
      sum = sum + moved(Placement<double>{Matrix3<double>::identity(), vector()}, point);
    }
    return sum;
  }

  /// A tree with revolute and prismatic joints, some with parallel axes.
  template <int N>
  Mechanism<N> mechanism() {
    Mechanism<N> tree;
    tree.gravity = 9.81 * vector();
    for (int i = 0; i < N; ++i) {
      Body& body = tree.bodies[i];
      body.parent =
          i == 0 || number(0, 8) < 1 ? -1 : static_cast<int>(number(i > 2 ? i - 2 : 0, i));
      body.prismatic = number(0, 4) < 1;
      body.placement = {chance() ? rotation() : rotation_from_rpy({0, 0, number(-3, 3)}), vector()};
      body.inertia = inertia();
    }
    return tree;
  }

 private:
  std::mt19937 engine_;
};

}  // namespace articula::test

// SPDX-License-Identifier: Apache-2.0
/// @file Random numbers that are the same in every run.
#pragma once

#include <articula/model/vector3.hpp>

#include <Eigen/Core>

#include <random>

namespace support {

/// Numbers from a seed. Print the seed with CAPTURE where they are used.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}

  [[nodiscard]] double number(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  /// An integer from low to high, both included.
  [[nodiscard]] int integer(int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(engine_);
  }
  [[nodiscard]] bool one_in(int n) { return integer(1, n) == 1; }
  [[nodiscard]] articula::Vector3<double> vector3(double size) {
    const double x = number(-size, size), y = number(-size, size);
    return {x, y, number(-size, size)};
  }
  template <int N>
  [[nodiscard]] Eigen::Matrix<double, N, 1> vector(double size) {
    Eigen::Matrix<double, N, 1> v;
    for (double& x : v) x = number(-size, size);
    return v;
  }
  [[nodiscard]] Eigen::VectorXd vector(Eigen::Index count, double size) {
    Eigen::VectorXd v(count);
    for (double& x : v) x = number(-size, size);
    return v;
  }
  [[nodiscard]] std::mt19937& engine() { return engine_; }

 private:
  std::mt19937 engine_;
};

}  // namespace support

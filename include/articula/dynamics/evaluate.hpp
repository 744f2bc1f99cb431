// SPDX-License-Identifier: Apache-2.0
/// @file The way from Eigen vectors to an algorithm's text and back.
#pragma once

#include "articula/core/joint_vector.hpp"
#include "articula/dynamics/compiled.hpp"
#include "articula/dynamics/configuration.hpp"
#include "articula/model/robot.hpp"

#include <cstddef>
#include <type_traits>

namespace articula::detail {

template <int N>
[[nodiscard]] JointArray<double, N> to_array(const JointVector<N>& vector) noexcept {
  JointArray<double, N> array;
  for (std::size_t i = 0; i < array.size(); ++i) array[i] = vector[static_cast<Eigen::Index>(i)];
  return array;
}

template <std::size_t N>
[[nodiscard]] JointVector<static_cast<int>(N)> to_vector(
    const std::array<double, N>& array) noexcept {
  JointVector<static_cast<int>(N)> vector;
  for (std::size_t i = 0; i < N; ++i) vector[static_cast<Eigen::Index>(i)] = array[i];
  return vector;
}

template <int N>
[[nodiscard]] JointRows<double, N> to_rows(const JointMatrix<N>& matrix) noexcept {
  JointRows<double, N> rows;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = 0; j < rows.size(); ++j) {
      rows[i][j] = matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    }
  }
  return rows;
}

template <std::size_t N>
[[nodiscard]] JointMatrix<static_cast<int>(N)> to_matrix(
    const std::array<std::array<double, N>, N>& rows) noexcept {
  JointMatrix<static_cast<int>(N)> matrix;
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t j = 0; j < N; ++j) {
      matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = rows[i][j];
    }
  }
  return matrix;
}

/// Runs an algorithm on a robot at positions q: the one place that knows how. For a described robot
/// that is the program which the compiler made of `Algorithm::evaluate`; for a model the function
/// itself is called with the mechanism, the configuration at q and the other inputs as arrays.
template <class Algorithm, Robot R, class... Inputs>
[[nodiscard]] auto evaluate(const R& robot, const JointVector<joint_count<R>>& q,
                            const Inputs&... inputs) noexcept {
  if constexpr (DescribedRobot<R>) {
    return compiled::run<Algorithm, R>(to_array(q), to_array(inputs)...);
  } else {
    constexpr int n = R::joint_count, b = R::body_count;
    const Mechanism<n, b>& mechanism = compiled::mechanism_for<Algorithm>(robot);
    const auto configuration = configuration_of<double, n, b>(mechanism, to_array(q));
    return Algorithm::template evaluate<double, n, b>(mechanism, configuration,
                                                      to_array(inputs)...);
  }
}

}  // namespace articula::detail

// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Core>
#include <cmath>

using Vector = Eigen::Matrix<double, 7, 1>;

void wave(Vector& q, double t) noexcept {
  for (Eigen::Index i = 0; i < q.size(); ++i) q[i] = std::sin(t) * std::cos(q[i]) + std::sqrt(t);
}

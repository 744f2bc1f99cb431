// SPDX-License-Identifier: Apache-2.0
/// @file From articula's vectors of space to Eigen's, and comparing what Eigen holds.
#pragma once

#include <articula/model/placement.hpp>

#include <Eigen/Dense>

namespace support {

[[nodiscard]] inline Eigen::Vector3d to_eigen(const articula::Vector3<double>& a) {
  return {a.x, a.y, a.z};
}

[[nodiscard]] inline Eigen::Matrix3d to_eigen(const articula::Matrix3<double>& m) {
  Eigen::Matrix3d matrix;
  for (int i = 0; i < 3; ++i) {
    matrix.row(i) = to_eigen(m.rows[static_cast<std::size_t>(i)]).transpose();
  }
  return matrix;
}

[[nodiscard]] inline Eigen::Matrix3d to_eigen(const articula::Symmetric3<double>& m) {
  Eigen::Matrix3d matrix;
  matrix << m.xx, m.xy, m.xz, m.xy, m.yy, m.yz, m.xz, m.yz, m.zz;
  return matrix;
}

[[nodiscard]] inline Eigen::Isometry3d to_eigen(const articula::Placement<double>& placement) {
  Eigen::Isometry3d isometry = Eigen::Isometry3d::Identity();
  isometry.linear() = to_eigen(placement.rotation);
  isometry.translation() = to_eigen(placement.translation);
  return isometry;
}

/// URDF's roll, pitch, yaw as three turns about fixed axes, the first about x.
[[nodiscard]] inline Eigen::Matrix3d rotation_of_rpy(const articula::Vector3<double>& rpy) {
  return (Eigen::AngleAxisd(rpy.z, Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(rpy.y, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(rpy.x, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

/// How far apart two vectors, matrices or isometries are: the root of the sum of squares. It is
/// NaN, which fails every comparison, where an element is.
[[nodiscard]] inline double distance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).norm();
}
[[nodiscard]] inline double distance(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return (a.matrix() - b.matrix()).norm();
}

}  // namespace support

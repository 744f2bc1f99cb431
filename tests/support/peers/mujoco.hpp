// SPDX-License-Identifier: Apache-2.0
/// @file A robot in MuJoCo.
#pragma once

#include "eigen.hpp"
#include "scratch_file.hpp"

#include <articula/model/mechanism.hpp>

#include <mujoco/mujoco.h>

#include <fstream>
#include <limits>
#include <memory>
#include <ostream>
#include <span>
#include <stdexcept>
#include <string>

namespace support {

struct FreeMujoco {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
  void operator()(mjData* data) const { mj_deleteData(data); }
};

/// A model of MuJoCo with the data that belong to it.
struct Mujoco {
  std::unique_ptr<mjModel, FreeMujoco> model{};
  std::unique_ptr<mjData, FreeMujoco> data{};
};

namespace mjcf {

inline std::ostream& operator<<(std::ostream& out, const Eigen::Vector3d& a) {
  return out << a.x() << ' ' << a.y() << ' ' << a.z();
}

/// One body and those that it carries. MuJoCo numbers bodies in the order of the file, depth first,
/// which is articula's.
inline void write_body(std::ostream& out, std::span<const articula::Body> bodies,
                       std::size_t index) {
  const articula::Body& body = bodies[index];
  const Eigen::Quaterniond turn(to_eigen(body.placement.rotation));
  const double mass = body.inertia.mass;
  const Eigen::Vector3d center = to_eigen(body.inertia.first_moment) / mass;
  const Eigen::Matrix3d inertia =
      to_eigen(body.inertia.moment) -
      mass * (center.squaredNorm() * Eigen::Matrix3d::Identity() - center * center.transpose());
  out << "<body pos='" << to_eigen(body.placement.translation) << "' quat='" << turn.w() << ' '
      << Eigen::Vector3d(turn.vec()) << "'>\n<joint axis='0 0 1' type='"
      << (body.prismatic ? "slide" : "hinge") << "'/>\n<inertial mass='" << mass << "' pos='"
      << center << "' fullinertia='" << Eigen::Vector3d(inertia.diagonal()) << ' ' << inertia(0, 1)
      << ' ' << inertia(0, 2) << ' ' << inertia(1, 2) << "'/>\n";
  for (std::size_t child = index + 1; child < bodies.size(); ++child) {
    if (bodies[child].parent == static_cast<int>(index)) write_body(out, bodies, child);
  }
  out << "</body>\n";
}

}  // namespace mjcf

/// Bodies of a mechanism in MuJoCo, each on a joint of its own: without contacts, limits, damping
/// and couplings. Steps are taken by its Runge-Kutta integrator.
/// @param gravity  [m/s^2]
/// @param step     [s]
/// @throws std::runtime_error with MuJoCo's reason if it refuses
[[nodiscard]] inline Mujoco load_mujoco(std::span<const articula::Body> bodies,
                                        const articula::Vector3<double>& gravity,
                                        double step = 1e-3) {
  using mjcf::operator<<;
  const ScratchFile file("robot.xml");
  {
    std::ofstream out(file.path());
    out.precision(std::numeric_limits<double>::max_digits10);
    out << "<mujoco>\n<compiler angle='radian'/>\n<option integrator='RK4' timestep='" << step
        << "' gravity='" << to_eigen(gravity)
        << "'><flag contact='disable' constraint='disable'/></option>\n<worldbody>\n";
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (bodies[i].parent < 0) mjcf::write_body(out, bodies, i);
    }
    out << "</worldbody>\n</mujoco>\n";
  }
  std::string error(1000, '\0');
  Mujoco robot;
  robot.model.reset(mj_loadXML(file.path().c_str(), nullptr, error.data(), 1000));
  if (!robot.model) throw std::runtime_error("MuJoCo: " + std::string(error.c_str()));
  robot.data.reset(mj_makeData(robot.model.get()));
  return robot;
}

/// A robot in MuJoCo, where couplings are soft constraints: q_all = C q + offset is worked out
/// here.
class MujocoRobot {
 public:
  template <int N, int B>
  explicit MujocoRobot(const articula::Mechanism<N, B>& mechanism)
      : mujoco_(load_mujoco(mechanism.bodies, mechanism.gravity)),
        coupling_(Eigen::MatrixXd::Zero(B, N)),
        offset_(Eigen::VectorXd::Zero(B)) {
    for (int i = 0; i < B; ++i) {
      const articula::Coupling& coupling = mechanism.couplings[static_cast<std::size_t>(i)];
      coupling_(i, coupling.joint) = coupling.multiplier;
      offset_[i] = coupling.offset;
    }
  }

  [[nodiscard]] Eigen::VectorXd inverse_dynamics(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                                 const Eigen::VectorXd& a) {
    set(q, v);
    numbers(mujoco_.data->qacc) = coupling_ * a;
    mj_inverse(mujoco_.model.get(), mujoco_.data.get());
    return coupling_.transpose() * numbers(mujoco_.data->qfrc_inverse);
  }
  [[nodiscard]] Eigen::MatrixXd mass_matrix(const Eigen::VectorXd& q) {
    set(q, Eigen::VectorXd::Zero(q.size()));
    mj_fwdPosition(mujoco_.model.get(), mujoco_.data.get());
    const int n = mujoco_.model->nv;
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> matrix(n, n);
    mj_fullM(mujoco_.model.get(), matrix.data(), mujoco_.data->qM);
    return coupling_.transpose() * matrix * coupling_;
  }

 private:
  [[nodiscard]] Eigen::Map<Eigen::VectorXd> numbers(mjtNum* first) const {
    return {first, mujoco_.model->nv};
  }
  void set(const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
    numbers(mujoco_.data->qpos) = coupling_ * q + offset_;
    numbers(mujoco_.data->qvel) = coupling_ * v;
  }

  Mujoco mujoco_;
  Eigen::MatrixXd coupling_;  ///< from the joints that can be commanded to all that move
  Eigen::VectorXd offset_;
};

}  // namespace support

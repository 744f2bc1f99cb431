// SPDX-License-Identifier: Apache-2.0
#include <articula/articula.hpp>
#include <articula/urdf/urdf.hpp>

#include <cmath>
#include <cstdio>
#include <pendulum.hpp>

int main() {
  const auto loaded = articula::load_urdf<1>(PENDULUM);
  const articula::JointVector<1> q(0.5);
  const double effort = articula::gravity(loaded, q)[0];
  std::printf("%g %g\n", effort, articula::gravity(lab::Pendulum{}, q)[0]);
  return std::abs(effort - articula::gravity(lab::Pendulum{}, q)[0]) < 1e-12 ? 0 : 1;
}

// SPDX-License-Identifier: Apache-2.0
// Prints the mass matrix of a pendulum at the end of a rod of 1 m: its mass and inertia.
#include <articula/dynamics/mass_matrix.hpp>

#include <cstdio>

#include "pendulum.hpp"

int main() {
  std::printf("%g\n", articula::mass_matrix(Pendulum(), articula::JointVector<1>(0.0))(0, 0));
}

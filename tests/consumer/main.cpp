// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdio>

#include <articula/articula.hpp>
#include <articula/robots/q2d.hpp>

int main() {
  articula::Loop<articula::Q2dSim, articula::PidPlusGravity> loop;  // the course's gains, 1 kHz
  loop.reference().position = {-1.0, 1.0};                          // rad
  for (int k = 0; k < 2000; ++k)
    if (loop.update() != articula::Status::ok) return 1;  // read, control, limit, write
  std::printf("%g %g\n", loop.state().position[0], loop.state().position[1]);

  const bool arrived = std::abs(loop.state().position[0] + 1.0) < 0.2 &&
                       std::abs(loop.state().position[1] - 1.0) < 0.2;
  return arrived ? 0 : 2;
}

// SPDX-License-Identifier: Apache-2.0
#include <articula/config/load_pid_gains.hpp>
#include <articula/robots/q2d.hpp>

#include <cstdio>

int main() {
  const auto config = articula::load_pid_gains(articula::Q2d(), GAINS, "arm");
  std::printf("%g %g\n", config.gains[0].proportional, config.gains[1].proportional);
  return config.gains[0].proportional == 100 && config.gains[1].proportional == 50.5 ? 0 : 1;
}

// SPDX-License-Identifier: Apache-2.0
// Trying out what surrounds an arm without one: mock hardware does what it is told, and fails by a
// script. Here it goes silent for a while; the loop notices, is safe, and goes on when asked to.
#include <articula/articula.hpp>
#include <articula/hardware/mock/mock_hardware.hpp>
#include <articula/robots/q2d.hpp>

#include <cstdio>
#include <utility>

using namespace articula;

using Drives = MockHardware<Q2d, PositionCommand<2>>;

int main() {
  Drives drives({{.kind = MockFaultKind::goes_silent, .first = 100, .count = 50}});
  SupervisedLoop<Drives, ForwardPosition> arm(std::move(drives), SupervisionOptions{});

  const auto run = [&](int cycles) {
    for (int k = 0; k < cycles; ++k) static_cast<void>(arm.update());
    std::printf("%3.0f ms: %s, at (%.2f, %.2f) rad\n", arm.time() * 1e3,
                to_string(arm.mode()).data(), arm.state().position[0], arm.state().position[1]);
  };
  run(10);
  arm.request_activation();
  run(2);
  arm.post({.position = {-0.5, 0.5}});
  run(20);
  run(100);  // silent from the 100th reading on: three such cycles are borne with
  std::printf("why: %s\n", to_string(arm.fault()).data());
  run(100);  // it stays there until somebody has looked
  arm.acknowledge_fault();
  run(1);
  arm.request_activation();
  run(10);  // and nobody's old wish is carried out
}
//   9 ms: inactive, at (0.00, 0.00) rad
//  11 ms: active, at (0.00, 0.00) rad
//  31 ms: active, at (-0.50, 0.50) rad
// 131 ms: fault, at (-0.50, 0.50) rad
// why: stale state
// 231 ms: fault, at (-0.50, 0.50) rad
// 233 ms: inactive, at (-0.50, 0.50) rad
// 243 ms: active, at (-0.50, 0.50) rad

// SPDX-License-Identifier: Apache-2.0
// A test of supervision without an arm. Mock hardware follows every command, and fails by a script.
// Here it sends no measurements for a while. The loop reports a fault, writes safe commands, and
// continues after a request.
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
  run(100);  // silent from the 100th reading on: three such cycles are tolerated
  std::printf("why: %s\n", to_string(arm.fault()).data());
  run(100);  // the fault lasts until it is acknowledged
  arm.acknowledge_fault();
  run(1);
  arm.request_activation();
  run(10);  // older references are dropped
}
//   9 ms: inactive, at (0.00, 0.00) rad
//  11 ms: active, at (0.00, 0.00) rad
//  31 ms: active, at (-0.50, 0.50) rad
// 131 ms: fault, at (-0.50, 0.50) rad
// why: stale state
// 231 ms: fault, at (-0.50, 0.50) rad
// 233 ms: inactive, at (-0.50, 0.50) rad
// 243 ms: active, at (-0.50, 0.50) rad

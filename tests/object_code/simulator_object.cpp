// SPDX-License-Identifier: Apache-2.0
// A run-time model may have stops and friction and its sensors noise: all paths are compiled.
#include <articula/sim/simulator.hpp>

using namespace articula;

extern "C" bool period(Simulator<Model<3>>& simulator, const EffortCommand<3>& command,
                       JointState<3>& state) noexcept {
  const Status written = simulator.write(command);
  return simulator.read(state) == Status::ok && written == Status::ok;
}

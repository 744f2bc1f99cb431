// SPDX-License-Identifier: Apache-2.0
// A simulated robot behind transmissions, under all commands.
#include <articula/hardware/transmission/differential_transmission.hpp>
#include <articula/hardware/transmission/simple_transmission.hpp>
#include <articula/hardware/transmission/transmitted_hardware.hpp>
#include <articula/sim/simulator.hpp>

using namespace articula;

using Geared = TransmittedHardware<Simulator<Model<3>>, Model<3>, SimpleTransmission,
                                   DifferentialTransmission>;

extern "C" bool period(Geared& arm, Simulator<Model<3>>& direct, const EffortCommand<3>& effort,
                       const PositionCommand<3>& position, const VelocityCommand<3>& velocity,
                       const MultiModeCommand<3>& spring, JointState<3>& state) noexcept {
  const bool written = arm.write(effort) == Status::ok && arm.write(position) == Status::ok &&
                       arm.write(velocity) == Status::ok && direct.write(spring) == Status::ok;
  return arm.read(state) == Status::ok && written;
}

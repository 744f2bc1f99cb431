// SPDX-License-Identifier: Apache-2.0
// The object code of the whole cycle over SocketCAN: nothing but the bus's own system calls and the
// clock may be reached from it.
#include <articula/hardware/cia402/cia402_codec.hpp>
#include <articula/robots/q2d_can.hpp>

using namespace articula;

Status read_joints(Q2dCan& arm, JointState<2>& state) noexcept { return arm.read(state); }
Status write_command(Q2dCan& arm, const EffortCommand<2>& command) noexcept {
  return arm.write(command);
}

using PacedArm =
    CanHardware<Q2d, Cia402Codec<Q2d, EffortCommand<2>, SyncProducer::another_node>, SocketCan>;

Status read_joints(PacedArm& arm, JointState<2>& state) noexcept { return arm.read(state); }
Status write_command(PacedArm& arm, const EffortCommand<2>& command) noexcept {
  return arm.write(command);
}

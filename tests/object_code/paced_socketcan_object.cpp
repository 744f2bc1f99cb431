// SPDX-License-Identifier: Apache-2.0
// The object code of the wait for a cycle of the bus: the bus's system calls, the clock, and the
// wait.
#include <articula/hardware/can/can_hardware.hpp>
#include <articula/hardware/can/socketcan.hpp>
#include <articula/hardware/cia402/cia402_codec.hpp>
#include <articula/robots/q2d.hpp>

using namespace articula;

using PacedArm =
    CanHardware<Q2d, Cia402Codec<Q2d, EffortCommand<2>, SyncProducer::another_node>, SocketCan>;

Status wait_for_cycle(PacedArm& arm, std::chrono::nanoseconds timeout) noexcept {
  return arm.wait_for_cycle(timeout);
}

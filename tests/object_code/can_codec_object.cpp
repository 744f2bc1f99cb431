// SPDX-License-Identifier: Apache-2.0
// The object code of both codecs and of a cycle with each.
#include <articula/core/hardware.hpp>
#include <articula/hardware/can/can_hardware.hpp>
#include <articula/hardware/cia402/cia402_codec.hpp>
#include <articula/hardware/quanser/quanser_codec.hpp>
#include <articula/robots/q2d.hpp>

using namespace articula;

CanDecoding decode_quanser(QuanserCodec<Q2d>& codec, const CanFrame& frame) noexcept {
  return codec.decode(frame);
}
void encode_quanser(QuanserCodec<Q2d>& codec, const EffortCommand<2>& command,
                    CanBatch& batch) noexcept {
  codec.encode(command, batch);
}
CanSetUp set_up_quanser(QuanserCodec<Q2d>& codec, std::chrono::nanoseconds elapsed,
                        CanBatch& batch) noexcept {
  return codec.set_up(elapsed, batch);
}
CanDecoding decode_cia402(Cia402Codec<Q2d>& codec, const CanFrame& frame) noexcept {
  return codec.decode(frame);
}
void encode_cia402(Cia402Codec<Q2d>& codec, const EffortCommand<2>& command,
                   CanBatch& batch) noexcept {
  codec.encode(command, batch);
}
CanSetUp set_up_cia402(Cia402Codec<Q2d>& codec, std::chrono::nanoseconds elapsed,
                       CanBatch& batch) noexcept {
  return codec.set_up(elapsed, batch);
}

// SPDX-License-Identifier: Apache-2.0
// What is a codec, a transport and a robot on a bus, and what is not. Compiling is passing.
#include <articula/core/hardware.hpp>
#include <articula/hardware/can/can_hardware.hpp>
#include <articula/hardware/cia402/cia402_codec.hpp>
#include <articula/hardware/quanser/quanser_codec.hpp>
#include <articula/hardware/quanser/simulated_quanser_drives.hpp>
#include <articula/robots/q2d.hpp>

#include "catch.hpp"
#include "hardware/fake_can_bus.hpp"

#include <array>

using namespace articula;

namespace {

/// The least that is a codec.
struct SmallestCodec {
  static constexpr int joint_count = 2;
  using Command = EffortCommand<2>;
  CanSubscription subscription() const { return {}; }
  void restart() noexcept {}
  CanSetUp set_up(std::chrono::nanoseconds, CanBatch&) noexcept { return CanSetUp::done; }
  void encode(const Command&, CanBatch&) noexcept {}
  void encode_stop(CanBatch&) noexcept {}
  CanDecoding decode(const CanFrame&) noexcept { return CanDecoding::foreign; }
  std::span<const DriveReport, 2> reports() const noexcept { return reports_; }
  std::array<DriveReport, 2> reports_{};
};
struct CodecThatMayThrow : SmallestCodec {
  CanDecoding decode(const CanFrame&) { return CanDecoding::foreign; }
};
struct CodecForOneJoint : SmallestCodec {
  static constexpr int joint_count = 1;
};
struct CodecWithoutStop : SmallestCodec {
  void encode_stop(CanBatch&) noexcept = delete;
};

/// The least that is a transport.
struct SmallestTransport {
  Status open(const CanSubscription&) { return Status::ok; }
  std::size_t receive(std::span<ReceivedCanFrame>) noexcept { return 0; }
  CanSending send(const CanBatch&) noexcept { return CanSending::sent; }
  void wait(std::chrono::nanoseconds time) noexcept { now_ += time; }
  std::chrono::nanoseconds now() const noexcept { return now_; }
  CanLink link() const noexcept { return CanLink::up; }
  std::chrono::nanoseconds now_{};
};
struct TransportThatMayThrow : SmallestTransport {
  CanSending send(const CanBatch&) { return CanSending::sent; }
};
struct TransportThatKeepsSilent : SmallestTransport {
  void send(const CanBatch&) noexcept {}
};

static_assert(CanCodec<SmallestCodec>);
static_assert(!CanCodec<CodecThatMayThrow>);
static_assert(!CanCodec<CodecForOneJoint>);
static_assert(!CanCodec<CodecWithoutStop>);
static_assert(CanCodec<QuanserCodec<Q2d>>);
static_assert(CanCodec<Cia402Codec<Q2d>>);
static_assert(CanCodec<Cia402Codec<Q2d, PositionCommand<2>>>);
static_assert(CanCodec<Cia402Codec<Q2d, VelocityCommand<2>>>);

static_assert(CanTransport<SmallestTransport>);
static_assert(!CanTransport<TransportThatMayThrow>);
static_assert(!CanTransport<TransportThatKeepsSilent>);
static_assert(CanTransport<support::FakeCanTransport<SimulatedQuanserDrives<Q2d>>>);

using Arm = CanHardware<Q2d, SmallestCodec, SmallestTransport>;
static_assert(Hardware<Arm>);
static_assert(!Hardware<Arm, PositionCommand<2>>);
static_assert(Hardware<CanHardware<Q2d, Cia402Codec<Q2d, PositionCommand<2>>, SmallestTransport>,
                       PositionCommand<2>>);

}  // namespace

TEST_CASE("a robot on the smallest bus is never ready") {
  Arm arm(SmallestCodec{}, SmallestTransport{});
  JointState<2> state;
  CHECK(arm.activate() == Status::ok);
  CHECK(arm.read(state) == Status::hardware_fault);
  CHECK(arm.fault().cause == CanCause::drive_disabled);
}

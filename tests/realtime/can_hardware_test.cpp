// SPDX-License-Identifier: Apache-2.0
// Codecs, drivers and simulated drives in the loop do not touch the heap.
#include <articula/articula.hpp>
#include <articula/hardware/can/can_hardware.hpp>
#include <articula/hardware/cia402/cia402_codec.hpp>
#include <articula/hardware/cia402/simulated_cia402_drives.hpp>
#include <articula/hardware/quanser/quanser_codec.hpp>
#include <articula/hardware/quanser/simulated_quanser_drives.hpp>
#include <articula/robots/q2d.hpp>

#include "allocation_guard.hpp"
#include "catch.hpp"

#include <array>

using namespace articula;
using articula::testing::heap_calls_in;

namespace {

constexpr QuanserModules<2> modules{
    {{.node = 1, .gear_ratio = 100}, {.node = 2, .gear_ratio = 80}}};
constexpr Cia402DriveList<2> drives{
    {{.node = 1, .rated_effort = 30}, {.node = 2, .rated_effort = 30}}};

/// A bus without memory of its own on the heap.
template <class Drives>
class DirectTransport {
 public:
  explicit DirectTransport(const Drives& the_drives) : drives_(the_drives) {}
  Status open(const CanSubscription&) noexcept { return Status::ok; }
  std::size_t receive(std::span<ReceivedCanFrame> frames) noexcept {
    std::size_t count = 0;
    for (; count < frames.size() && count < answers_.size(); ++count) {
      frames[count] = {answers_[count], {}};
    }
    answers_.clear();
    return count;
  }
  CanSending send(const CanBatch& batch) noexcept {
    for (const CanFrame& frame : batch) drives_.receive(frame, answers_);
    return CanSending::sent;
  }
  void wait(std::chrono::nanoseconds time) noexcept {
    if (!answers_.empty()) return;
    now_ += time;
    drives_.pass_silent_period(answers_);
  }
  std::chrono::nanoseconds now() const noexcept { return now_; }
  CanLink link() const noexcept { return CanLink::up; }

 protected:
  void hear(const CanFrame& frame) noexcept { answers_.push_back(frame); }
  void advance(std::chrono::nanoseconds time) noexcept { now_ += time; }

 private:
  Drives drives_;
  CanBatch answers_{};
  std::chrono::nanoseconds now_{};
};

/// A bus without memory on the heap, on which another node sends SYNC when it is waited for.
template <class Drives>
class PacingTransport : public DirectTransport<Drives> {
 public:
  using DirectTransport<Drives>::DirectTransport;
  void wait(std::chrono::nanoseconds time) noexcept {
    CanBatch sync;
    sync.push_back(canopen::encode_sync());
    this->hear(sync[0]);
    static_cast<void>(this->send(sync));
    this->advance(time);
  }
};

template <class Codec, class Drives>
void check(Codec codec, const Drives& the_drives) {
  Loop<CanHardware<Q2d, Codec, DirectTransport<Drives>>, PidPlusGravity> loop(
      CanHardware<Q2d, Codec, DirectTransport<Drives>>(codec, DirectTransport<Drives>(the_drives)));
  loop.reference().position = {-1, 1};
  Status status = Status::ok;
  CHECK(heap_calls_in([&] {
          for (int k = 0; k < 1000 && status == Status::ok; ++k) status = loop.update();
        }) == 0);
  CHECK(status == Status::ok);
}

}  // namespace

TEST_CASE("a cycle over the Quanser protocol does not touch the heap") {
  check(QuanserCodec<Q2d>(modules), SimulatedQuanserDrives<Q2d>(modules));
}

TEST_CASE("a cycle over CiA 402 does not touch the heap") {
  check(Cia402Codec<Q2d>(drives), SimulatedCia402Drives<Q2d>(drives));
}

TEST_CASE("a cycle that the bus paces does not touch the heap, nor does the wait for it") {
  using PacedCodec = Cia402Codec<Q2d, EffortCommand<2>, SyncProducer::another_node>;
  using Drives = SimulatedCia402Drives<Q2d>;
  using Arm = CanHardware<Q2d, PacedCodec, PacingTransport<Drives>>;
  Arm arm{PacedCodec(drives), PacingTransport<Drives>(Drives(drives))};
  Loop<Arm, PidPlusGravity> loop(std::move(arm));
  loop.reference().position = {-1, 1};
  Status status = Status::ok;
  CHECK(heap_calls_in([&] {
          for (int k = 0; k < 1000 && status == Status::ok; ++k) {
            status = loop.hardware().wait_for_cycle(std::chrono::milliseconds(1));
            if (status == Status::ok) status = loop.update();
          }
        }) == 0);
  CHECK(status == Status::ok);
}

// SPDX-License-Identifier: Apache-2.0
// The CAN bus: encoding and decoding a cycle, and the whole cycle over SocketCAN where there is a
// vcan0 (sudo ip link add vcan0 type vcan && sudo ip link set vcan0 up), with its system calls.
#include <articula/articula.hpp>
#include <articula/hardware/cia402/cia402_codec.hpp>
#include <articula/hardware/quanser/simulated_quanser_drives.hpp>
#include <articula/robots/q2d_can.hpp>

#include <benchmark/benchmark.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>

#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace {

using namespace articula;

long system_calls = 0;

constexpr Cia402DriveList<2> cia402_drives{
    {{.node = 1, .rated_effort = 30, .position_scale = 1e5},
     {.node = 2, .rated_effort = 15, .position_scale = 1e5}}};

/// Commands that change from call to call.
std::array<EffortCommand<2>, 256> make_commands() {
  std::array<EffortCommand<2>, 256> commands;
  for (std::size_t i = 0; i < commands.size(); ++i) {
    const double phase = static_cast<double>(i);
    commands[i].effort = {20 * std::sin(phase), 10 * std::cos(1.7 * phase)};
  }
  return commands;
}

void empty_body(benchmark::State& bench) {
  const auto commands = make_commands();
  std::size_t i = 0;
  for (auto _ : bench) {
    EffortCommand<2> command = commands[i++ % commands.size()];
    benchmark::DoNotOptimize(command);
  }
}

/// A cycle's commands for both joints, and SYNC.
template <class Codec>
void encode(benchmark::State& bench, Codec codec) {
  const auto commands = make_commands();
  std::size_t i = 0;
  CanBatch batch;
  for (auto _ : bench) {
    batch.clear();
    codec.encode(commands[i++ % commands.size()], batch);
    benchmark::DoNotOptimize(batch);
  }
}

/// A cycle's feedback of both joints: four frames.
void decode_quanser(benchmark::State& bench) {
  QuanserCodec<Q2d> codec(q2d_modules);
  CanBatch batch;
  std::uint8_t counter = 0;
  for (auto _ : bench) {
    batch.clear();
    codec.encode_stop(batch);
    ++counter;
    for (const std::uint8_t node : {std::uint8_t{1}, std::uint8_t{2}}) {
      const auto first =
          quanser::encode(quanser::Position{counter * 100, -counter, counter, 1}, node);
      const auto second = quanser::encode(quanser::Motion{counter, 5, counter, 0}, node);
      if (codec.decode(first) != CanDecoding::accepted ||
          codec.decode(second) != CanDecoding::accepted) {
        bench.SkipWithError("a frame was not accepted");
      }
    }
    benchmark::DoNotOptimize(codec);
  }
}

void decode_cia402(benchmark::State& bench) {
  Cia402Codec<Q2d> codec(cia402_drives);
  CanBatch batch;
  std::uint8_t counter = 0;
  for (auto _ : bench) {
    batch.clear();
    codec.encode_stop(batch);
    ++counter;
    for (const std::uint32_t node : {1U, 2U}) {
      CanFrame first, second;
      first.identifier = canopen::transmit_pdo_1_base + node;
      first.length = 8;
      first.data = {0x37, 0x02, counter, 0, 0, 0, counter, 0};
      second.identifier = canopen::transmit_pdo_2_base + node;
      second.length = 6;
      second.data = {counter, 0, 0, 0, 0, 0};
      if (codec.decode(first) != CanDecoding::accepted ||
          codec.decode(second) != CanDecoding::accepted) {
        bench.SkipWithError("a frame was not accepted");
      }
    }
    benchmark::DoNotOptimize(codec);
  }
}

/// The drives' end, in the same thread and thus without a scheduler in between.
struct FarEnd {
  FarEnd() : socket("vcan0") {
    static_cast<void>(
        socket.open({.identifiers = {quanser::sync_identifier, 0x041, 0x042, 0x081, 0x082}}));
  }
  void answer() {
    std::array<ReceivedCanFrame, 32> frames;
    const std::size_t count = socket.receive(frames);
    CanBatch answers;
    for (std::size_t i = 0; i < count; ++i) drives.receive(frames[i].frame, answers);
    static_cast<void>(socket.send(answers));
  }
  SocketCan socket;
  SimulatedQuanserDrives<Q2d> drives{q2d_modules};
};

/// The way to the bus, with the drives answering whenever the host waits.
struct WithFarEnd {
  SocketCan socket{"vcan0"};
  FarEnd* far_end;
  Status open(const CanSubscription& subscription) { return socket.open(subscription); }
  std::size_t receive(std::span<ReceivedCanFrame> frames) noexcept {
    return socket.receive(frames);
  }
  CanSending send(const CanBatch& batch) noexcept { return socket.send(batch); }
  void wait(std::chrono::nanoseconds time) noexcept {
    far_end->answer();
    socket.wait(time);
  }
  std::chrono::nanoseconds now() const noexcept { return socket.now(); }
  CanLink link() const noexcept { return socket.link(); }
};

/// Read, control, limit, write: two frames of efforts and SYNC out, four of feedback in.
void cycle_over_socketcan(benchmark::State& bench) {
  try {
    FarEnd far_end;
    using Arm = CanHardware<Q2d, QuanserCodec<Q2d>, WithFarEnd>;
    Loop<Arm, PidPlusGravity> loop(
        Arm(QuanserCodec<Q2d>(q2d_modules), WithFarEnd{.far_end = &far_end}));
    long calls = 0, cycles = 0;
    for (auto _ : bench) {
      const long calls_before = system_calls;
      const auto begin = std::chrono::steady_clock::now();
      const Status status = loop.update();
      const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
      calls += system_calls - calls_before;
      ++cycles;
      bench.SetIterationTime(time.count());
      if (status != Status::ok) bench.SkipWithError("a cycle went wrong");
      far_end.answer();
    }
    bench.counters["system_calls_per_cycle"] =
        static_cast<double>(calls) / static_cast<double>(cycles);
  } catch (const std::runtime_error& error) {
    bench.SkipWithError(error.what());
  }
}

BENCHMARK(empty_body);
BENCHMARK_CAPTURE(encode, Quanser, QuanserCodec<Q2d>(q2d_modules));
BENCHMARK_CAPTURE(encode, Cia402, Cia402Codec<Q2d>(cia402_drives));
BENCHMARK(decode_quanser)->Name("decode/Quanser");
BENCHMARK(decode_cia402)->Name("decode/Cia402");
BENCHMARK(cycle_over_socketcan)->UseManualTime();

}  // namespace

// The program's own take precedence over those of the C library: all that the driver calls is
// counted.
extern "C" int recvmmsg(int socket, mmsghdr* messages, unsigned count, int flags,
                        timespec* timeout) {
  ++system_calls;
  return static_cast<int>(::syscall(SYS_recvmmsg, socket, messages, count, flags, timeout));
}
extern "C" int sendmmsg(int socket, mmsghdr* messages, unsigned count, int flags) {
  ++system_calls;
  return static_cast<int>(::syscall(SYS_sendmmsg, socket, messages, count, flags));
}

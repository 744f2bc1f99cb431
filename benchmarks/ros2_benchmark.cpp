// SPDX-License-Identifier: Apache-2.0
// What a bridge to ROS 2 costs the loop: the same cycles with a Remote alone and with a Bridge; and
// how late a loop at 1 kHz wakes up without a bridge, with one, and with one whose topics are busy.
#include <articula/articula.hpp>
#include <articula/loop/realtime/run_realtime.hpp>
#include <articula/loop/supervision/supervised_loop.hpp>
#include <articula/remote/remote.hpp>
#include <articula/robots/q2d.hpp>
#include <articula/ros2/bridge/bridge.hpp>
#include <articula/ros2/dds/fast_dds_transport.hpp>
#include <articula/ros2/messages/sensor_msgs.hpp>
#include <articula/ros2/messages/trajectory_msgs.hpp>
#include <articula/ros2/node/publisher.hpp>
#include <articula/ros2/node/subscription.hpp>

#include <benchmark/benchmark.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <thread>

namespace {

using namespace articula;
using LoopType = SupervisedLoop<Q2dSim, PidPlusGravity>;

constexpr unsigned domain = 77;

void activate(LoopType& loop, Remote<LoopType>& remote) {
  loop.request_activation();
  for (int k = 0; k < 10; ++k) static_cast<void>(remote.update());
}

/// Batches of cycles that the rings hold. Between them the bridge's thread takes them over.
void cycle(benchmark::State& bench, bool has_bridge) {
  auto loop = std::make_unique<LoopType>();
  Remote remote(*loop);
  activate(*loop, remote);
  std::optional<ros2::Bridge> bridge;
  if (has_bridge) bridge.emplace(remote, ros2::BridgeOptions{.dds = {.domain = domain}});
  std::size_t cycles = 0;
  RunReport report;
  for (auto _ : bench) {
    Status status = remote.update();
    remote.report(report);
    benchmark::DoNotOptimize(status);
    if (++cycles % 512 == 0) {
      bench.PauseTiming();
      static_cast<void>(remote.statistics());
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      bench.ResumeTiming();
    }
  }
  bench.counters["dropped"] = static_cast<double>(remote.statistics().dropped);
}

/// A ROS program that reads the joint states and sends 500 references a second.
class BusyPeer {
 public:
  BusyPeer() : thread_([this] { run(); }) {}
  BusyPeer(const BusyPeer&) = delete;
  BusyPeer& operator=(const BusyPeer&) = delete;
  ~BusyPeer() {
    runs_ = false;
    thread_.join();
  }

 private:
  using Point = ros2::trajectory_msgs::msg::JointTrajectoryPoint<ros2::Jazzy>;
  void run() {
    ros2::FastDdsTransport transport({.domain = domain}, ros2::Distribution::jazzy);
    ros2::Context context(transport, ros2::Distribution::jazzy);
    const ros2::Node node(context, "busy_peer");
    ros2::Publisher<Point> references(node, "/controller/reference",
                                      ros2::quality_of_service::states);
    using States = ros2::sensor_msgs::msg::JointState<ros2::Jazzy>;
    ros2::subscribe<States>(node, "/joint_states", ros2::quality_of_service::states,
                            [](const States&) {});
    Point point;
    for (int k = 0; runs_; ++k) {
      point.positions = {0.01 * (k % 10), -0.01 * (k % 10)};
      references.publish(point);
      transport.poll(std::chrono::milliseconds(2));
    }
  }
  std::atomic<bool> runs_ = true;
  std::thread thread_;
};

/// 10 s at 1 kHz, at priority 80 of SCHED_FIFO.
void latency(benchmark::State& bench, bool has_bridge, bool is_busy) {
  for (auto _ : bench) {
    LoopType loop;
    Remote remote(loop);
    activate(loop, remote);
    std::optional<ros2::Bridge> bridge;  // in threads of the usual priority
    std::optional<BusyPeer> peer;
    if (has_bridge) bridge.emplace(remote, ros2::BridgeOptions{.dds = {.domain = domain}});
    if (is_busy) peer.emplace();
    std::this_thread::sleep_for(std::chrono::seconds(2));  // until they have found each other
    RealtimeOptions options;
    options.thread.priority = 80;
    options.run.cycles = 10'000;
    RunReport report;
    std::thread([&] { report = run(remote, options, remote.each()); }).join();
    const auto us = [&](double share) {
      return static_cast<double>(report.latency.percentile(share).count()) * 1e-3;
    };
    bench.counters["p50_us"] = us(0.5);
    bench.counters["p90_us"] = us(0.9);
    bench.counters["p99_us"] = us(0.99);
    bench.counters["overruns"] = static_cast<double>(report.overruns);
  }
}

BENCHMARK_CAPTURE(cycle, with_remote, false);
BENCHMARK_CAPTURE(cycle, with_bridge, true);
BENCHMARK_CAPTURE(latency, alone, false, false)->Iterations(1);
BENCHMARK_CAPTURE(latency, with_bridge, true, false)->Iterations(1);
BENCHMARK_CAPTURE(latency, with_busy_bridge, true, true)->Iterations(1);

}  // namespace

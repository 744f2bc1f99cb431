// SPDX-License-Identifier: Apache-2.0
#include "articula/ros2/bridge/bridge.hpp"

#include "articula/core/refuse.hpp"
#include "articula/ros2/bridge/bridge_nodes.hpp"
#include "articula/ros2/dds/fast_dds_transport.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

namespace articula::ros2 {

namespace {

/// Half of the shortest period at which something is published.
std::chrono::microseconds pause_of(const BridgeOptions& options) {
  constexpr std::chrono::microseconds shortest{200}, longest{2000};
  const double rate =
      std::max({options.state_rate, options.controller_state_rate, options.feedback_rate});
  const auto half = std::chrono::duration<double>(0.5 / rate);
  return std::clamp(std::chrono::duration_cast<std::chrono::microseconds>(half), shortest, longest);
}

}  // namespace

struct Bridge::Parts {
  Parts(remote::Port& port, std::unique_ptr<Transport> own_transport, const BridgeOptions& options)
      : transport(std::move(own_transport)),
        nodes(port, checked(), options),
        pause(pause_of(options)) {}

  [[nodiscard]] Transport& checked() const {
    if (transport == nullptr) articula::detail::refuse({"ros2: there is no transport"});
    return *transport;
  }

  void run() {
    while (runs) {
      std::string caught_error;
      try {
        transport->poll(pause);
        nodes.update(std::chrono::system_clock::now().time_since_epoch());
      } catch (const std::exception& caught) {  // of one message: the others go on
        caught_error = caught.what();
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
      }
      const std::lock_guard lock(mutex);
      dropped = nodes.dropped();
      if (!caught_error.empty()) error = std::move(caught_error);
    }
  }

  std::unique_ptr<Transport> transport;
  BridgeNodes nodes;                ///< ends before the transport
  std::chrono::microseconds pause;  ///< longest, between two looks at the loop
  std::atomic<bool> runs = true;
  std::mutex mutex{};
  DroppedMessages dropped{};  ///< under the mutex
  std::string error{};        ///< likewise
  std::thread thread{};
};

Bridge::Bridge(remote::Port& port, const BridgeOptions& options)
    : Bridge(port, std::make_unique<FastDdsTransport>(options.dds, options.distribution), options) {
}

Bridge::Bridge(remote::Port& port, std::unique_ptr<Transport> transport,
               const BridgeOptions& options)
    : parts_(std::make_unique<Parts>(port, std::move(transport), options)) {
  parts_->thread = std::thread([parts = parts_.get()] { parts->run(); });
}

Bridge::~Bridge() {
  parts_->runs = false;
  parts_->thread.join();
}

DroppedMessages Bridge::dropped() const {
  const std::lock_guard lock(parts_->mutex);
  return parts_->dropped;
}

std::string Bridge::error() const {
  const std::lock_guard lock(parts_->mutex);
  return parts_->error;
}

}  // namespace articula::ros2

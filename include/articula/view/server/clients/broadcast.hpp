// SPDX-License-Identifier: Apache-2.0
/// @file The data of a loop to all clients of a view.
#pragma once

#include "articula/remote/port.hpp"
#include "articula/view/server/clients/client.hpp"
#include "articula/view/server/clients/latest.hpp"

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace articula::view {

/// Takes the cycles, events and state of a port, writes each message once, and hands it to all
/// clients.
class Broadcast {
 public:
  static constexpr std::size_t cycles_a_message = 256;
  static constexpr std::size_t messages_a_tick = 16;
  using TimePoint = Client::TimePoint;

  /// @param port  outlives this
  explicit Broadcast(remote::Port& port);

  /// Clients are added until they are removed.
  void add(Client& client) { clients_.insert(&client); }
  void remove(Client& client) { clients_.erase(&client); }

  /// Hands on what is new. To be called at the rate at which clients draw.
  /// @param wall  the time of the day, for time stamps
  void tick(TimePoint now, WallTime wall);

  [[nodiscard]] const Latest& latest() const noexcept { return latest_; }

 private:
  [[nodiscard]] bool anybody_wants(Topic topic) const;
  void stream(Topic topic, std::string message);
  void tell_cycles();
  void tell_newest(const remote::Cycle& cycle);
  void tell_events();
  void tell_situation();
  void tell_statistics();
  void tell_parameters();
  [[nodiscard]] std::size_t read_cycles();
  [[nodiscard]] WallTime stamp_of(double time);

  remote::Port& port_;
  std::unique_ptr<remote::Session> session_;
  Latest latest_;
  std::set<Client*> clients_{};
  std::vector<remote::Cycle> cycles_{};  ///< of a message; reused
  std::optional<remote::Cycle> newest_{};
  std::uint64_t next_number_ = 0;  ///< of the cycle that follows the last one; 0: unknown
  double loop_start_ = 0;          ///< time of the day at the loop's time 0 [s]; 0: unknown
  std::string situation_{};        ///< as text, to see changes
  std::vector<remote::Parameter> parameters_{};
  TimePoint half_second_{};
};

}  // namespace articula::view

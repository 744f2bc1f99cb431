// SPDX-License-Identifier: Apache-2.0
/// @file The clients of a port: who operates, and which answers each still gets.
#pragma once

#include "articula/remote/port.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace articula::remote {

/// The clients of a port, the one that has the controls, the answers and events that they have not
/// taken yet. Not for several threads at a time.
class Clients {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::size_t most_events = 1000;  ///< that are kept
  static constexpr std::size_t first_events = 100;  ///< that a new client gets

  /// What is known of a client.
  struct Client {
    std::string name{};
    bool operates = false;  ///< may take the controls
    std::uint64_t last_request = 0;
    std::uint64_t next_cycle = 0;  ///< the next one that it takes
    std::uint64_t next_event = 0;  ///< likewise
    std::deque<Answer> answers{};
  };

  /// @param lifetime  of a silent operator [s]
  explicit Clients(double lifetime) : lifetime_(lifetime) {}

  /// @return the number of the new client, from 1
  [[nodiscard]] std::uint64_t add(std::string name, bool operates, std::uint64_t next_cycle) {
    const std::uint64_t end = first_event_ + events_.size();
    const std::uint64_t begin = events_.size() > first_events ? end - first_events : first_event_;
    clients_[++last_client_] = {std::move(name), operates, 0, next_cycle, begin, {}};
    return last_client_;
  }
  void remove(std::uint64_t client) { clients_.erase(client); }
  [[nodiscard]] Client& of(std::uint64_t client) { return clients_.at(client); }
  [[nodiscard]] Client* find(std::uint64_t client) {
    const auto found = clients_.find(client);
    return found == clients_.end() ? nullptr : &found->second;
  }

  /// Gives the controls to a client if they are free.
  /// @return empty if it has them now, else the reason
  [[nodiscard]] std::string take_controls(std::uint64_t client) {
    if (!of(client).operates) return "this client may watch only";
    if (operator_ != 0 && operator_ != client) {
      return "somebody else has the controls: " + operator_name();
    }
    operator_ = client;
    return {};
  }
  void release_controls() { operator_ = 0; }
  [[nodiscard]] bool has_controls(std::uint64_t client) const { return operator_ == client; }
  /// Of the client that has the controls; empty if there is none.
  [[nodiscard]] std::string operator_name() const {
    const auto found = clients_.find(operator_);
    return found == clients_.end() ? std::string() : found->second.name;
  }

  /// The operator has given a sign of life.
  void note_sign(Clock::time_point now) { last_sign_ = now; }
  [[nodiscard]] bool has_operator() const { return operator_ != 0; }
  /// Whether there is an operator that has been silent for too long.
  [[nodiscard]] bool operator_is_silent(Clock::time_point now) const {
    return operator_ != 0 && std::chrono::duration<double>(now - last_sign_).count() > lifetime_;
  }

  /// Adds an event for all clients.
  void tell(Event event) {
    events_.push_back(std::move(event));
    if (events_.size() <= most_events) return;
    events_.pop_front();
    ++first_event_;
  }
  /// The oldest event that a client has not taken yet.
  [[nodiscard]] std::optional<Event> next_event(std::uint64_t client) {
    std::uint64_t& next = of(client).next_event;
    if (next < first_event_) next = first_event_;
    if (next == first_event_ + events_.size()) return std::nullopt;
    return events_[static_cast<std::size_t>(next++ - first_event_)];
  }

 private:
  double lifetime_;  ///< [s]
  std::map<std::uint64_t, Client> clients_{};
  std::uint64_t last_client_ = 0;
  std::uint64_t operator_ = 0;  ///< 0: nobody
  Clock::time_point last_sign_{};
  std::deque<Event> events_{};
  std::uint64_t first_event_ = 0;  ///< number of events_.front()
};

}  // namespace articula::remote

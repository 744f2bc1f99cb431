// SPDX-License-Identifier: Apache-2.0
/// @file The clients of a port: who operates, and which answers each still gets.
#pragma once

#include "articula/remote/engine/operator_watch.hpp"
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
/// taken yet. The loop learns of the operator by an OperatorWatch, the clients by events. Times are
/// the loop's [s]. Not for several threads at a time.
class Clients {
 public:
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
  /// @param watch     outlives this
  Clients(double lifetime, OperatorWatch& watch) : lifetime_(lifetime), watch_(watch) {}

  /// @return the number of the new client, from 1
  [[nodiscard]] std::uint64_t add(std::string name, bool operates, std::uint64_t next_cycle) {
    const std::uint64_t end = first_event_ + events_.size();
    const std::uint64_t begin = events_.size() > first_events ? end - first_events : first_event_;
    clients_[++last_client_] = {std::move(name), operates, 0, next_cycle, begin, {}};
    return last_client_;
  }
  void remove(std::uint64_t client, double time) {
    if (has_controls(client)) lose_operator("has left", time);
    clients_.erase(client);
  }
  [[nodiscard]] Client& of(std::uint64_t client) { return clients_.at(client); }
  [[nodiscard]] Client* find(std::uint64_t client) {
    const auto found = clients_.find(client);
    return found == clients_.end() ? nullptr : &found->second;
  }

  /// Gives the controls to a client if they are free.
  /// @return empty if it has them now, else the reason
  [[nodiscard]] std::string take_controls(std::uint64_t client, double time) {
    if (!of(client).operates) return "this client may watch only";
    if (operator_ != 0 && operator_ != client) {
      return "somebody else has the controls: " + operator_name() + "; it must release them first";
    }
    if (std::exchange(operator_, client) == 0) {
      tell({time, Event::Level::info, operator_name() + " has taken the controls"});
    }
    note_sign(client);
    return {};
  }
  /// Takes the controls back from a client, if it has them.
  void release_controls(std::uint64_t client, double time) {
    if (!has_controls(client)) return;
    watch_.report_release();
    tell({time, Event::Level::info, operator_name() + " has released the controls"});
    operator_ = 0;
  }
  [[nodiscard]] bool has_controls(std::uint64_t client) const { return operator_ == client; }
  /// Of the client that has the controls; empty if there is none.
  [[nodiscard]] std::string operator_name() const {
    const auto found = clients_.find(operator_);
    return found == clients_.end() ? std::string() : found->second.name;
  }

  /// A client has given a sign of life. That of the operator counts.
  void note_sign(std::uint64_t client) {
    if (!has_controls(client)) return;
    last_sign_ = Clock::now();
    watch_.report_alive();
  }
  /// Notices an operator that has been silent for too long. The silence is measured in the host's
  /// time. The loop counts its periods, which a simulation may make much faster: it learns here
  /// that the operator is not silent yet.
  void watch_operator(double time) {
    if (operator_ == 0) return;
    if (std::chrono::duration<double>(Clock::now() - last_sign_).count() > lifetime_) {
      lose_operator("is silent", time);
    } else {
      watch_.report_alive();
    }
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
  using Clock = std::chrono::steady_clock;

  void lose_operator(const std::string& how, double time) {
    tell({time, Event::Level::warning, "the operator " + operator_name() + " " + how});
    watch_.report_loss();
    operator_ = 0;
  }

  double lifetime_;  ///< [s]
  OperatorWatch& watch_;
  std::map<std::uint64_t, Client> clients_{};
  std::uint64_t last_client_ = 0;
  std::uint64_t operator_ = 0;  ///< 0: nobody
  Clock::time_point last_sign_{};
  std::deque<Event> events_{};
  std::uint64_t first_event_ = 0;  ///< number of events_.front()
};

}  // namespace articula::remote

// SPDX-License-Identifier: Apache-2.0
/// @file A connection to the view of a running loop.
#pragma once

#include "program.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace terminal {

/// A message of a topic.
struct Message {
  std::string topic{};
  Json content{};
};

/// A client of the Foxglove WebSocket protocol. All calls wait; none of them for ever.
class Connection {
 public:
  /// Connects to the address, port and token of the program.
  /// @throws NoConnection telling what is wrong and what to do
  explicit Connection(const Program& program);
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// Calls a service.
  /// @param service   as "/go"
  /// @param request   a JSON object
  /// @param patience  how long to wait for the answer [s]
  /// @return          its answer
  /// @throws Refusal if it answers with success false; NoConnection if there is no such service,
  ///         the connection breaks, or there is no answer in time
  Json call(const std::string& service, const Json& request = Json::object(),
            double patience = default_patience);
  /// The same for requests that move or change something. The controls are given back afterwards,
  /// so that what was asked for goes on after this program's end.
  Json operate(const std::string& service, const Json& request = Json::object(),
               double patience = default_patience);

  /// Prints a note on standard error if the simulation is paused. For a command that waits for its
  /// cycles.
  void note_pause();
  /// For a command that would wait for the end of a motion with the controls, so that nobody could
  /// resume the simulation.
  /// @throws Refusal if the simulation is paused
  void refuse_pause();

  /// Receives the messages of a topic from now on.
  void subscribe(const std::string& topic);
  /// The oldest message that was not taken yet; nothing if none comes within the time, or the user
  /// ends the program by Ctrl-C.
  /// @param seconds  how long to wait [s]
  std::optional<Message> next(double seconds);

  static constexpr double default_patience = 5;  ///< [s]

 private:
  class Client;
  std::unique_ptr<Client> client_;
};

/// Raised by Ctrl-C once `end_on_signal` was called, for commands that go on until then.
[[nodiscard]] bool is_ended();
/// From now on Ctrl-C does not end the program at once.
void end_on_signal();

}  // namespace terminal

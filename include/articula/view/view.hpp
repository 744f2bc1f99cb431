// SPDX-License-Identifier: Apache-2.0
/// @file A running loop in browsers and other programs, by HTTP and WebSocket. Target
/// articula::view.
#pragma once

#include "articula/remote/port.hpp"
#include "articula/view/view_options.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace articula {

/// Serves a page that shows a running loop, and the data and requests that the page uses:
///
///     SupervisedLoop<Q2dSim, PidPlusGravity> arm;
///     Remote remote(arm);
///     View view(remote, {.operates = true});  // http://127.0.0.1:8765
///     MonotonicClock clock;
///     run(remote, clock, {});
///
/// The data are those of the Foxglove WebSocket protocol. Other programs that speak it connect to
/// the same address; see docs/view.md for what was tried. Everything happens in a thread of the
/// view's own, which the loop never waits for.
class View {
 public:
  /// Opens the port and starts the thread.
  /// @param port     outlives the view
  /// @throws std::invalid_argument if an option is not valid; the message names it and the cure
  /// @throws std::system_error if the address cannot be listened on, as when the port is in use
  explicit View(remote::Port& port, const ViewOptions& options = {});
  /// Closes all connections and ends the thread.
  ~View();
  View(const View&) = delete;
  View& operator=(const View&) = delete;

  /// What to open in a browser, with the token, as "http://127.0.0.1:8765/".
  [[nodiscard]] const std::string& url() const noexcept;
  /// The TCP port.
  [[nodiscard]] std::uint16_t port() const noexcept;
  /// How many WebSocket clients are connected. From any thread.
  [[nodiscard]] std::size_t clients() const noexcept;

 private:
  class Server;
  std::unique_ptr<Server> server_;
};

}  // namespace articula

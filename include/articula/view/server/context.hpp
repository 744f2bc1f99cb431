// SPDX-License-Identifier: Apache-2.0
/// @file The context that all connections of a view share, in the view's thread.
#pragma once

#include "articula/remote/port.hpp"
#include "articula/view/server/access.hpp"
#include "articula/view/server/clients/broadcast.hpp"
#include "articula/view/server/futures/futures_thread.hpp"
#include "articula/view/server/printable.hpp"
#include "articula/view/view_options.hpp"

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <list>
#include <set>
#include <string>

namespace articula::view {

class HttpSession;
class WebSocketSession;

/// Options, data and counts of all connections.
struct Context {
  Context(remote::Port& loop_port, const ViewOptions& view_options, bool is_loopback)
      : options(view_options),
        access(options, is_loopback),
        port(loop_port),
        broadcast(loop_port),
        futures(loop_port) {}

  /// Warns of something, at most once a second, so that a hostile client cannot fill a disk.
  /// @param text  may contain what a client has sent
  void warn(const std::string& text) {
    const auto now = std::chrono::steady_clock::now();
    if (now - warned < std::chrono::seconds(1)) return;
    warned = now;
    const std::string line = "view: " + printable(text);
    if (options.warn) {
      options.warn(line);
    } else {
      std::fprintf(stderr, "%s\n", line.c_str());
    }
  }

  /// Connections that have not become WebSockets are at most this many.
  static constexpr std::size_t http_limit = 32;

  ViewOptions options;
  Access access;
  remote::Port& port;
  Broadcast broadcast;
  FuturesThread futures;
  std::set<WebSocketSession*> sessions{};
  std::list<HttpSession*> http_sessions{};  ///< the oldest first
  std::uint64_t names = 0;                  ///< given to clients so far
  std::atomic<std::size_t> clients = 0;     ///< size of `sessions`, for other threads
  std::chrono::steady_clock::time_point warned{};
};

}  // namespace articula::view

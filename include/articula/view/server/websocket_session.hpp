// SPDX-License-Identifier: Apache-2.0
/// @file The WebSocket connection of one client. Boost.Beast.
#pragma once

#include "articula/view/server/clients/client.hpp"
#include "articula/view/server/context.hpp"

#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/websocket/stream.hpp>

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace articula::view {

/// The subprotocol to answer with: the first one offered that this server speaks.
/// @param offered  the header Sec-WebSocket-Protocol
/// @return         empty if there is none
[[nodiscard]] std::string_view choose_subprotocol(std::string_view offered);

/// Carries frames between a client and its connection. Reads no faster than
/// ViewOptions::messages_per_second allows, and never waits for a client that reads slowly.
class WebSocketSession : public std::enable_shared_from_this<WebSocketSession> {
 public:
  using Request = boost::beast::http::request<boost::beast::http::empty_body>;
  using TimePoint = Client::TimePoint;

  /// @param name  of the client, for others to see
  WebSocketSession(boost::beast::tcp_stream&& stream, Context& context, std::string name);
  ~WebSocketSession();
  WebSocketSession(const WebSocketSession&) = delete;
  WebSocketSession& operator=(const WebSocketSession&) = delete;

  /// Answers the request to upgrade and begins to read.
  void start(Request request);
  /// Pings the client, sends what waits, and drops a client that takes nothing.
  void tick(TimePoint now);
  /// Says good-bye.
  void close();

 private:
  using Error = boost::beast::error_code;

  void accepted(Error error);
  void read();
  void got(Error error, std::size_t size);
  void read_when_allowed(std::size_t size);
  void send();
  void sent(Error error);
  void drop(const std::string& reason);

  Context& context_;
  boost::beast::websocket::stream<boost::beast::tcp_stream> stream_;
  boost::asio::steady_timer pause_;
  std::string name_;
  Request request_{};
  boost::beast::flat_buffer buffer_;
  std::optional<Client> client_{};  ///< from the end of the handshake on
  Frame sending_{};
  bool is_sending_ = false;
  bool is_pinging_ = false;
  bool is_closing_ = false;
  double allowance_;  ///< messages that may come at once
  TimePoint allowed_at_;
  TimePoint sending_since_{};
  TimePoint pinged_{};
};

}  // namespace articula::view

// SPDX-License-Identifier: Apache-2.0
/// @file One HTTP connection: files, and the way to a WebSocket. Boost.Beast.
#pragma once

#include "articula/view/server/context.hpp"

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/string_body.hpp>

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace articula::view {

/// Answers the requests of one connection, until it closes or becomes a WebSocket. It takes
/// requests for ten seconds, so that no connection stays for ever.
class HttpSession : public std::enable_shared_from_this<HttpSession> {
 public:
  using Request = boost::beast::http::request<boost::beast::http::empty_body>;
  using Response = boost::beast::http::response<boost::beast::http::string_body>;

  HttpSession(boost::asio::ip::tcp::socket&& socket, Context& context);
  ~HttpSession();
  HttpSession(const HttpSession&) = delete;
  HttpSession& operator=(const HttpSession&) = delete;

  /// Reads the next request.
  void read();
  /// Ends the connection, to make room for another.
  void close();

 private:
  using Error = boost::beast::error_code;

  void got(Error error);
  [[nodiscard]] std::optional<Response> refusal(const Request& request, const Target& target) const;
  [[nodiscard]] Response answer(const Request& request, const Target& target) const;
  void upgrade(Request request);
  void send(Response response);

  Context& context_;
  boost::beast::tcp_stream stream_;
  boost::beast::flat_buffer buffer_;
  std::chrono::steady_clock::time_point end_;  ///< of its requests
  std::optional<boost::beast::http::request_parser<boost::beast::http::empty_body>> parser_{};
};

}  // namespace articula::view

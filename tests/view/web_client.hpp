// SPDX-License-Identifier: Apache-2.0
/// @file HTTP and WebSocket clients for tests of the view. Boost.Beast.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>

namespace support {

namespace asio = boost::asio;
namespace beast = boost::beast;
using Json = nlohmann::json;
using Error = boost::system::error_code;

/// Starts an operation and waits for its end. A test that waits for a minute has failed.
template <class Start>
Error wait_for(asio::io_context& io, Start&& start) {
  std::optional<Error> result;
  start([&](Error error, auto&&...) { result = error; });
  io.restart();
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!result && std::chrono::steady_clock::now() < end) io.run_one_for(std::chrono::seconds(1));
  if (!result) throw std::runtime_error("nothing has come for a minute");
  return *result;
}

/// A connection over which a test sends any bytes.
class RawClient {
 public:
  explicit RawClient(std::uint16_t port) {
    stream_.connect({asio::ip::make_address("127.0.0.1"), port});
  }
  /// Sends bytes; the server may have closed the connection.
  void send(const std::string& bytes) {
    (void)wait_for(io_, [&](auto done) { asio::async_write(stream_, asio::buffer(bytes), done); });
  }
  /// The response of the server; nothing if it closes the connection instead.
  std::optional<beast::http::response<beast::http::string_body>> response(bool to_head = false) {
    beast::http::response_parser<beast::http::string_body> parser;
    parser.body_limit(1 << 30);
    parser.skip(to_head);
    const Error error =
        wait_for(io_, [&](auto done) { beast::http::async_read(stream_, buffer_, parser, done); });
    if (error) return std::nullopt;
    return parser.release();
  }
  /// Waits until the server closes the connection.
  void wait_for_end() {
    std::string bytes(4096, '\0');
    while (!wait_for(io_, [&](auto done) { stream_.async_read_some(asio::buffer(bytes), done); })) {
    }
  }

 private:
  asio::io_context io_{};
  beast::tcp_stream stream_{io_};
  beast::flat_buffer buffer_{};
};

/// The response to a GET of a target, with further header lines.
inline auto get(std::uint16_t port, const std::string& target, const std::string& headers = {}) {
  RawClient client(port);
  const std::string host = headers.find("Host:") == std::string::npos ? "Host: localhost\r\n" : "";
  client.send("GET " + target + " HTTP/1.1\r\n" + host + headers + "\r\n");
  return client.response().value();
}

/// A WebSocket client that knows the frames of the Foxglove protocol.
class WebClient {
 public:
  /// Connects, and offers subprotocols.
  /// @param origin  empty: none, as programs do
  explicit WebClient(std::uint16_t port, const std::string& subprotocols = "foxglove.websocket.v1",
                     const std::string& origin = {}, const std::string& target = "/",
                     int receive_buffer = 0) {
    auto& socket = beast::get_lowest_layer(stream_).socket();
    socket.open(asio::ip::tcp::v4());
    if (receive_buffer > 0) {
      socket.set_option(asio::socket_base::receive_buffer_size(receive_buffer));
    }
    socket.connect({asio::ip::make_address("127.0.0.1"), port});
    stream_.read_message_max(1 << 30);
    stream_.set_option(
        beast::websocket::stream_base::decorator([&](beast::websocket::request_type& request) {
          if (!subprotocols.empty()) {
            request.set(beast::http::field::sec_websocket_protocol, subprotocols);
          }
          if (!origin.empty()) request.set(beast::http::field::origin, origin);
        }));
    error_ = wait_for(io_, [&](auto done) {
      stream_.async_handshake(response_, "127.0.0.1:" + std::to_string(port), target, done);
    });
  }

  /// The response to the handshake, also if it was refused.
  [[nodiscard]] const auto& response() const { return response_; }
  [[nodiscard]] bool is_connected() const { return !error_; }
  [[nodiscard]] auto close_code() const { return stream_.reason().code; }

  void send(const std::string& bytes, bool is_text = true) {
    stream_.text(is_text);
    error_ = wait_for(io_, [&](auto done) { stream_.async_write(asio::buffer(bytes), done); });
  }
  /// The next frame; nothing if the connection is closed.
  std::optional<std::string> next() {
    beast::flat_buffer buffer;
    error_ = wait_for(io_, [&](auto done) { stream_.async_read(buffer, done); });
    if (error_) return std::nullopt;
    return beast::buffers_to_string(buffer.data());
  }
  /// Reads until the connection is closed.
  void wait_for_end() {
    while (next()) {
    }
  }
  /// The text of an operation, whatever comes before it.
  Json text(const std::string& op) {
    while (const auto frame = next()) {
      if (!stream_.got_text()) continue;
      Json json = Json::parse(*frame);
      if (json["op"] == "advertiseServices") {
        for (const Json& service : json["services"]) services_[service["name"]] = service["id"];
      }
      if (json["op"] == op) return json;
    }
    throw std::runtime_error("closed before " + op);
  }
  /// Subscribes to a channel under its own number.
  void subscribe(int channel) {
    send(R"({"op":"subscribe","subscriptions":[{"id":)" + std::to_string(channel) +
         R"(,"channelId":)" + std::to_string(channel) + "}]}");
  }
  /// The next message of a subscription.
  Json message(std::uint32_t subscription) {
    const std::string begin = "\x01" + number(subscription);
    while (const auto frame = next()) {
      if (!stream_.got_text() && frame->starts_with(begin)) return Json::parse(frame->substr(13));
    }
    throw std::runtime_error("closed before a message");
  }
  void send_call(const std::string& name, const Json& request) {
    if (services_.empty()) (void)text("advertiseServices");
    send("\x02" + number(services_.at(name)) + number(++calls_) + number(4) + "json" +
             request.dump(),
         false);
  }
  Json answer() {
    while (const auto frame = next()) {
      if (!stream_.got_text() && frame->front() == '\x03') return Json::parse(frame->substr(17));
    }
    throw std::runtime_error("closed before an answer");
  }
  Json call(const std::string& name, const Json& request) {
    send_call(name, request);
    return answer();
  }

  /// Ends the TCP connection without good-bye.
  void cut() { beast::get_lowest_layer(stream_).close(); }
  /// Sends bytes beneath the WebSocket.
  void send_raw(const std::string& bytes) {
    error_ = wait_for(io_, [&](auto done) {
      asio::async_write(beast::get_lowest_layer(stream_), asio::buffer(bytes), done);
    });
  }

  /// Four bytes, the lowest first.
  static std::string number(std::uint32_t x) {
    std::string bytes;
    for (int i = 0; i < 4; ++i, x >>= 8) bytes += static_cast<char>(x & 255);
    return bytes;
  }

 private:
  asio::io_context io_{};
  beast::websocket::stream<beast::tcp_stream> stream_{io_};
  beast::websocket::response_type response_{};
  Error error_{};
  std::map<std::string, std::uint32_t> services_{};
  std::uint32_t calls_ = 0;
};

}  // namespace support

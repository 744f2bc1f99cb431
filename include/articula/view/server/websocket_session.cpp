// SPDX-License-Identifier: Apache-2.0
#include "articula/view/server/websocket_session.hpp"

#include <boost/asio/buffer.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/http/rfc7230.hpp>
#include <boost/beast/websocket/rfc6455.hpp>

#include <algorithm>
#include <array>
#include <exception>
#include <utility>

namespace articula::view {

namespace {

namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using Clock = std::chrono::steady_clock;

constexpr auto ping_period = std::chrono::milliseconds(500);
constexpr double bytes_a_message = 1024;  // longer messages count as several

}  // namespace

std::string_view choose_subprotocol(std::string_view offered) {
  for (const auto name : http::token_list(offered)) {
    for (const std::string_view known : {"foxglove.websocket.v1", "foxglove.sdk.v1"}) {
      if (name == known) return known;
    }
  }
  return {};
}

WebSocketSession::WebSocketSession(beast::tcp_stream&& stream, Context& context, std::string name)
    : context_(context),
      stream_(std::move(stream)),
      pause_(stream_.get_executor()),
      name_(std::move(name)),
      buffer_(context.options.message_limit),
      allowance_(static_cast<double>(context.options.messages_per_second)),
      allowed_at_(Clock::now()) {
  context_.sessions.insert(this);
  context_.clients = context_.sessions.size();
}

WebSocketSession::~WebSocketSession() {
  if (client_) context_.broadcast.remove(*client_);
  context_.sessions.erase(this);
  context_.clients = context_.sessions.size();
}

void WebSocketSession::start(Request request) {
  request_ = std::move(request);
  beast::get_lowest_layer(stream_).expires_never();  // the WebSocket has its own limits
  const std::chrono::duration<double> patience(context_.options.patience);
  stream_.set_option(websocket::stream_base::timeout{
      std::chrono::seconds(10), std::chrono::duration_cast<Clock::duration>(patience), true});
  stream_.read_message_max(context_.options.message_limit);
  const auto protocol = choose_subprotocol(request_[http::field::sec_websocket_protocol]);
  stream_.set_option(
      websocket::stream_base::decorator([protocol](websocket::response_type& answer) {
        answer.set(http::field::sec_websocket_protocol, protocol);
        answer.set(http::field::server, "articula");
      }));
  stream_.control_callback([this](websocket::frame_type type, beast::string_view) {
    if (type == websocket::frame_type::pong && client_) client_->alive();
  });
  stream_.async_accept(request_,
                       [self = shared_from_this()](Error error) { self->accepted(error); });
}

void WebSocketSession::accepted(Error error) {
  if (error) return;
  try {
    client_.emplace(context_.port, context_.futures, context_.broadcast.latest(), context_.options,
                    name_);
  } catch (const std::exception& failure) {
    return drop(failure.what());
  }
  context_.broadcast.add(*client_);
  send();
  read();
}

// --- reading -----------------------------------------------------------------------------------

void WebSocketSession::read() {
  stream_.async_read(buffer_, [self = shared_from_this()](Error error, std::size_t size) {
    self->got(error, size);
  });
}

void WebSocketSession::got(Error error, std::size_t size) {
  if (error) return drop({});
  try {
    const auto bytes = buffer_.cdata();
    client_->receive(stream_.got_text(), {static_cast<const char*>(bytes.data()), bytes.size()});
  } catch (const std::exception& failure) {
    return drop(std::string("a client's message failed: ") + failure.what());
  }
  buffer_.consume(buffer_.size());
  send();
  read_when_allowed(size);
}

void WebSocketSession::read_when_allowed(std::size_t size) {
  const auto now = Clock::now();
  const double rate = static_cast<double>(context_.options.messages_per_second);
  allowance_ += rate * std::chrono::duration<double>(now - allowed_at_).count();
  allowed_at_ = now;
  const double cost = std::max(1.0, static_cast<double>(size) / bytes_a_message);
  allowance_ = std::min(allowance_, rate) - cost;
  if (allowance_ >= 0) return read();
  const std::chrono::duration<double> wait(-allowance_ / rate);
  pause_.expires_after(std::chrono::duration_cast<Clock::duration>(wait));
  pause_.async_wait([self = shared_from_this()](Error error) {
    if (!error) self->read();
  });
}

// --- writing -----------------------------------------------------------------------------------

void WebSocketSession::send() {
  if (is_sending_ || is_closing_ || !client_) return;
  auto frame = client_->take();
  if (!frame) return;
  sending_ = std::move(*frame);
  is_sending_ = true;
  sending_since_ = Clock::now();
  stream_.text(sending_.is_text);
  const std::string_view body = sending_.body ? std::string_view(*sending_.body) : "";
  const std::array<boost::asio::const_buffer, 2> buffers{
      boost::asio::buffer(sending_.head), boost::asio::buffer(body.data(), body.size())};
  stream_.async_write(buffers,
                      [self = shared_from_this()](Error error, std::size_t) { self->sent(error); });
}

void WebSocketSession::sent(Error error) {
  is_sending_ = false;
  if (!error) send();
}

void WebSocketSession::tick(TimePoint now) {
  if (!client_ || is_closing_) return;
  if (client_->overflowed()) return drop("a client was dropped: it does not take its answers");
  if (is_sending_ &&
      now - sending_since_ > std::chrono::duration<double>(context_.options.patience)) {
    return drop("a client was dropped: it has taken nothing for " +
                std::to_string(static_cast<int>(context_.options.patience)) + " s");
  }
  if (!is_pinging_ && now - pinged_ >= ping_period) {
    pinged_ = now;
    is_pinging_ = true;
    stream_.async_ping({}, [self = shared_from_this()](Error) { self->is_pinging_ = false; });
  }
  send();
}

void WebSocketSession::close() {
  if (is_closing_) return;
  is_closing_ = true;
  if (!client_) return beast::get_lowest_layer(stream_).close();
  stream_.async_close(websocket::close_code::going_away,
                      [self = shared_from_this()](Error) { self->drop({}); });
}

void WebSocketSession::drop(const std::string& reason) {
  if (!reason.empty()) context_.warn(reason);
  is_closing_ = true;
  pause_.cancel();
  beast::get_lowest_layer(stream_).close();  // ends all that waits, and so this
}

}  // namespace articula::view

// SPDX-License-Identifier: Apache-2.0
#include "connection.hpp"

#include <articula/loop/realtime/stop_on_signal.hpp>
#include <articula/ros2/cdr_decoder.hpp>
#include <articula/ros2/messages/sensor_msgs.hpp>
#include <articula/version.hpp>

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>

#include <algorithm>
#include <chrono>
#include <deque>
#include <iostream>
#include <map>
#include <span>
#include <string_view>
#include <utility>

namespace terminal {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using boost::system::error_code;
using Clock = std::chrono::steady_clock;

articula::StopFlag ended;  // NOLINT: a signal's handler can only use globals

constexpr const char* protocols = "foxglove.websocket.v1, foxglove.sdk.v1";
constexpr std::size_t largest_message = std::size_t{256} << 20;  // [bytes]

Clock::time_point after(double seconds) {
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(
                            std::chrono::duration<double>(std::min(seconds, 1e6)));
}

void append_u32(std::string& bytes, std::uint32_t number) {
  for (int i = 0; i < 4; ++i, number >>= 8) bytes += static_cast<char>(number & 0xff);
}

/// Takes a number of four bytes, least significant first, from the beginning.
std::uint32_t take_u32(std::string_view& bytes) {
  if (bytes.size() < 4) throw NoConnection("the server sent a message that is too short");
  std::uint32_t number = 0;
  for (std::size_t i = 4; i-- > 0;) number = number << 8 | static_cast<unsigned char>(bytes[i]);
  bytes.remove_prefix(4);
  return number;
}

/// A text in a URL: only letters, digits and -._~ stay as they are.
std::string in_url(std::string_view text) {
  constexpr std::string_view digits = "0123456789ABCDEF";
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool stays = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       std::string_view("-._~").find(c) != std::string_view::npos;
    if (stays) {
      result += c;
    } else {
      result += '%';
      result += digits[byte >> 4];
      result += digits[byte & 15];
    }
  }
  return result;
}

Json parsed(std::string_view text) {
  Json json = Json::parse(text.begin(), text.end(), nullptr, false);
  if (json.is_discarded()) throw NoConnection("the server sent a message that is not JSON");
  return json;
}

/// A message of ROS 2, with the members that one of /joint_states has.
Json joint_state(std::string_view bytes) {
  articula::ros2::sensor_msgs::msg::JointState<articula::ros2::Jazzy> message;
  if (articula::ros2::decode(std::as_bytes(std::span(bytes)), message) !=
      articula::ros2::CdrError::none) {
    throw NoConnection("the server sent a message that is not CDR");
  }
  return {{"name", message.name},
          {"position", message.position},
          {"velocity", message.velocity},
          {"effort", message.effort}};
}

}  // namespace

bool is_ended() { return ended.requested(); }
void end_on_signal() { static const articula::StopOnSignal on_signal(ended); }

class Connection::Client {
 public:
  explicit Client(const Program& program)
      : place_(program.address + ":" + std::to_string(program.port)), stream_(context_) {
    connect(program);
    shake_hands(program);
    stream_.read_message_max(largest_message);
    read();
    wait_for(Connection::default_patience, "its greeting",
             [&] { return !services_.empty() && !channels_.empty(); });
  }

  ~Client() {
    if (is_broken_) return;
    // A server that is waited for closes the connection, too; if not, nobody waits for it.
    stream_.async_close(websocket::close_code::normal, [](error_code) {});
    context_.restart();
    context_.run_for(std::chrono::milliseconds(200));
  }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  Json call(const std::string& service, const Json& request, double patience) {
    const auto known = services_.find(service);
    if (known == services_.end()) {
      throw NoConnection("the server at " + place_ + " has no service " + service +
                         "; is it a loop of articula " + std::string(articula::library_version) +
                         "?");
    }
    const std::uint32_t number = ++calls_;
    std::string bytes{'\x02'};
    append_u32(bytes, known->second);
    append_u32(bytes, number);
    append_u32(bytes, 4);
    bytes += "json" + request.dump(-1, ' ', false, Json::error_handler_t::replace);
    send(bytes, true);
    wait_for(patience, "an answer to " + service, [&] { return answers_.contains(number); });
    const Json answer = std::move(answers_.at(number));
    answers_.erase(number);
    if (!answer.is_object())
      throw NoConnection("the server's answer to " + service + " is no object");
    if (!answer.value("success", true)) {
      throw Refusal(answer.value("message", service + " was refused, without a reason"));
    }
    return answer;
  }

  void subscribe(const std::string& topic) {
    const auto channel = channels_.find(topic);
    if (channel == channels_.end()) {
      throw NoConnection("the server at " + place_ + " has no topic " + topic);
    }
    const auto number = static_cast<std::uint32_t>(topics_.size() + 1);
    topics_[number] = topic;
    const Json subscription{{"id", number}, {"channelId", channel->second}};
    send(Json{{"op", "subscribe"}, {"subscriptions", {subscription}}}.dump(), false);
  }

  std::optional<Message> next(double seconds) {
    const auto end = after(seconds);
    while (messages_.empty() && !is_ended() && Clock::now() < end) pump(end);
    if (messages_.empty()) return std::nullopt;
    Message message = std::move(messages_.front());
    messages_.pop_front();
    return message;
  }

 private:
  [[noreturn]] void fail(const std::string& reason) {
    is_broken_ = true;
    throw NoConnection(reason);
  }

  /// Runs until the flag is set.
  /// @return false if the time ends before
  bool run_until(const bool& flag, double seconds) {
    const auto end = after(seconds);
    while (!flag && Clock::now() < end) {
      context_.restart();
      context_.run_one_until(end);
    }
    return flag;
  }

  /// Runs an operation to its end. Without an end in time it closes the connection and fails.
  /// @param begin        starts the operation, called with the handler for its end
  /// @param when_silent  why the connection fails without an end
  error_code complete(auto begin, const std::string& when_silent) {
    error_code error;
    bool is_over = false;
    begin([&error, &is_over](error_code result, auto&&...) {
      error = result;
      is_over = true;
    });
    if (run_until(is_over, Connection::default_patience)) return error;
    error_code ignored;
    stream_.next_layer().close(ignored);
    run_until(is_over, 1);
    fail(when_silent);
  }

  void connect(const Program& program) {
    const std::string advice =
        "; start the program with the loop, or name it by --address and --port";
    error_code error;
    asio::ip::tcp::resolver resolver(context_);
    const auto found = resolver.resolve(program.address, std::to_string(program.port), error);
    if (error) fail("there is no address " + program.address + ": " + error.message());
    error =
        complete([&](auto handler) { asio::async_connect(stream_.next_layer(), found, handler); },
                 "nothing answers at " + place_ + advice);
    if (error) fail("no connection to " + place_ + ": " + error.message() + advice);
    stream_.next_layer().set_option(asio::ip::tcp::no_delay(true), error);
  }

  void shake_hands(const Program& program) {
    stream_.set_option(websocket::stream_base::decorator([](websocket::request_type& request) {
      request.set(beast::http::field::sec_websocket_protocol, protocols);
      request.set(beast::http::field::user_agent,
                  "articula " + std::string(articula::library_version));
    }));
    const std::string target = program.token.empty() ? "/" : "/?token=" + in_url(program.token);
    websocket::response_type response;
    const bool is_ipv6 = program.address.find(':') != std::string::npos;
    const std::string host = (is_ipv6 ? "[" + program.address + "]" : program.address) + ":" +
                             std::to_string(program.port);
    const error_code error =
        complete([&](auto handler) { stream_.async_handshake(response, host, target, handler); },
                 "the program at " + place_ + " does not answer as a view of articula does");
    if (error) {
      const unsigned status = response.result_int();
      if (status == 401 || status == 403) {
        fail("the server at " + place_ + " refuses this client" +
             (program.token.empty()
                  ? "; give its token by --token"
                  : "; the token is not its own, see the address that it prints"));
      }
      fail("the program at " + place_ + " is no view of articula: " + error.message());
    }
    const auto chosen = response[beast::http::field::sec_websocket_protocol];
    if (chosen != "foxglove.websocket.v1" && chosen != "foxglove.sdk.v1") {
      fail("the program at " + place_ + " does not speak the Foxglove WebSocket protocol");
    }
  }

  void read() {
    stream_.async_read(buffer_, [this](error_code error, std::size_t) {
      if (error) {
        is_broken_ = true;
        break_ = error.message();
        return;
      }
      const auto data = buffer_.data();
      received_.emplace_back(stream_.got_text(),
                             std::string(static_cast<const char*>(data.data()), data.size()));
      buffer_.consume(buffer_.size());
      read();
    });
  }

  /// Lets one thing happen, or a moment pass, and takes what has come.
  void pump(Clock::time_point end) {
    if (is_broken_) fail("the connection to " + place_ + " has ended: " + break_);
    context_.restart();
    context_.run_one_until(std::min(end, Clock::now() + std::chrono::milliseconds(50)));
    while (!received_.empty()) {
      const auto [is_text, bytes] = std::move(received_.front());
      received_.pop_front();
      is_text ? take_text(parsed(bytes)) : take_binary(bytes);
    }
  }

  template <class Condition>
  void wait_for(double seconds, const std::string& what, Condition condition) {
    const auto end = after(seconds);
    while (!condition()) {
      if (Clock::now() >= end) fail("the server at " + place_ + " does not send " + what);
      pump(end);
    }
  }

  void send(const std::string& bytes, bool is_binary) {
    if (is_broken_) fail("the connection to " + place_ + " has ended: " + break_);
    stream_.binary(is_binary);
    const error_code error =
        complete([&](auto handler) { stream_.async_write(asio::buffer(bytes), handler); },
                 "the server at " + place_ + " takes nothing");
    if (error) fail("the connection to " + place_ + " has ended: " + error.message());
  }

  void take_text(const Json& message) {
    if (!message.is_object()) return;
    const std::string op = message.value("op", "");
    if (op == "advertise") {
      for (const Json& channel : message.value("channels", Json::array())) {
        channels_[channel.value("topic", "")] = channel.value("id", std::uint32_t{0});
      }
    } else if (op == "advertiseServices") {
      for (const Json& service : message.value("services", Json::array())) {
        services_[service.value("name", "")] = service.value("id", std::uint32_t{0});
      }
    } else if (op == "serviceCallFailure") {
      answers_[message.value("callId", std::uint32_t{0})] =
          Json{{"success", false}, {"message", message.value("message", "the call failed")}};
    }
  }

  void take_binary(std::string_view bytes) {
    if (bytes.empty()) return;
    const char op = bytes.front();
    bytes.remove_prefix(1);
    if (op == 1) {
      const std::uint32_t subscription = take_u32(bytes);
      take_u32(bytes);  // time of the log, which the messages have inside
      take_u32(bytes);
      const auto topic = topics_.find(subscription);
      if (topic == topics_.end()) return;
      const bool is_ros = topic->second.starts_with("/ros/");
      messages_.push_back({topic->second, is_ros ? joint_state(bytes) : parsed(bytes)});
    } else if (op == 3) {
      take_u32(bytes);
      const std::uint32_t number = take_u32(bytes);
      const std::uint32_t length = take_u32(bytes);
      if (bytes.size() < length) throw NoConnection("the server sent an answer that is too short");
      answers_[number] = parsed(bytes.substr(length));
    }
  }

  std::string place_;
  asio::io_context context_{1};
  websocket::stream<asio::ip::tcp::socket> stream_;
  beast::flat_buffer buffer_;
  bool is_broken_ = false;
  std::string break_{};  ///< why it is broken
  std::deque<std::pair<bool, std::string>> received_;
  std::map<std::string, std::uint32_t> services_, channels_;
  std::map<std::uint32_t, std::string> topics_;  ///< by subscription
  std::map<std::uint32_t, Json> answers_;        ///< by call
  std::deque<Message> messages_;
  std::uint32_t calls_ = 0;
};

Connection::Connection(const Program& program) : client_(std::make_unique<Client>(program)) {}
Connection::~Connection() = default;

Json Connection::call(const std::string& service, const Json& request, double patience) {
  return client_->call(service, request, patience);
}

Json Connection::operate(const std::string& service, const Json& request, double patience) {
  Json answer = client_->call(service, request, patience);
  client_->call("/release_controls", Json::object(), default_patience);
  return answer;
}

void Connection::note_pause() {
  if (!call("/situation").value("paused", false)) return;
  std::cerr << "note: the simulation is paused; 'articula resume' in another terminal goes on\n";
}
void Connection::refuse_pause() {
  if (!call("/situation").value("paused", false)) return;
  throw Refusal("the simulation is paused: 'articula resume' first");
}

void Connection::subscribe(const std::string& topic) { client_->subscribe(topic); }
std::optional<Message> Connection::next(double seconds) { return client_->next(seconds); }

}  // namespace terminal

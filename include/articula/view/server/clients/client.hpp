// SPDX-License-Identifier: Apache-2.0
/// @file One client of a view, without its connection: frames in, frames out.
#pragma once

#include "articula/remote/port.hpp"
#include "articula/view/protocol/protocol.hpp"
#include "articula/view/server/clients/latest.hpp"
#include "articula/view/server/clients/send_queue.hpp"
#include "articula/view/server/futures/futures_desk.hpp"
#include "articula/view/view_options.hpp"

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace articula::view {

/// Answers the frames of one client from a port, and collects what is to be sent to it.
class Client {
 public:
  static constexpr std::size_t pending_limit = 256;       ///< requests without their answer
  static constexpr std::size_t complaints_a_second = 20;  ///< more are left out
  using TimePoint = std::chrono::steady_clock::time_point;

  /// Connects to the port, and queues what a new client gets. All arguments outlive the client.
  Client(remote::Port& port, FuturesDesk& futures, const Latest& latest, const ViewOptions& options,
         const std::string& name);
  ~Client();
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  /// A frame came from the client. Any bytes may come.
  void receive(bool is_text, std::string_view bytes);
  /// The client has answered a ping.
  void alive() { session_->keep_alive(); }

  /// Sends answers of the loop and changes of the situation. To be called often.
  void tick(TimePoint now);
  /// Whether the client has subscribed to a topic.
  [[nodiscard]] bool wants(Topic topic) const noexcept {
    return protocol_.subscription(topic).has_value();
  }
  /// Sends a message of a topic of which the newest counts, if the client wants it.
  void stream(Topic topic, const SharedText& message);
  /// Whether the client has asked for states of the joints since the last call.
  [[nodiscard]] bool take_lack_of_state() noexcept { return std::exchange(lacks_state_, false); }
  /// Sends a message of a topic of which each counts, if the client wants it.
  void announce(Topic topic, const SharedText& message);
  /// Sends parameters that have changed, as far as the client watches them.
  void tell_changes(const std::vector<remote::Parameter>& changed);

  /// The frame to be sent next.
  [[nodiscard]] std::optional<Frame> take();
  /// Whether answers were lost, so that the connection is to be closed.
  [[nodiscard]] bool overflowed() const noexcept { return queue_.overflowed(); }

 private:
  // What an answer of the loop is sent as.
  struct CallReply {
    std::uint32_t service = 0, call = 0;
  };
  struct SettingReply {
    std::optional<std::string> id{};
    std::vector<std::string> names{};
  };
  struct PublicationReply {};
  using Reply = std::variant<CallReply, SettingReply, PublicationReply>;

  void act(const Subscribed& action);
  void act(const ParameterQuestion& action);
  void act(const ParameterSetting& action);
  void act(const MalformedParameters& action);
  void act(const ParameterWatch& action);
  void act(const ServiceCall& action);
  void act(const MalformedCall& action);
  void act(const Published& action);
  void act(const AssetQuestion& action);
  void act(const Complaint& action);

  void ask(const remote::Request& request, const Reply& reply);
  void reply(const Reply& reply, bool success, const std::string& text,
             unsigned long long cycle = 0);
  void ask(const remote::FuturesQuestion& question, const CallReply& reply);
  void take_answers();
  void take_futures();
  void tell_situation();
  void send_parameters(const std::vector<std::string>& names, const std::optional<std::string>& id);
  void complain(const std::string& text);
  [[nodiscard]] Json answer_of(Query query);
  [[nodiscard]] std::string change_controls(bool take);
  [[nodiscard]] Frame asset(const AssetQuestion& question) const;

  remote::Port& port_;
  FuturesDesk& futures_;
  FuturesDesk::ClientNumber number_;  ///< at that desk
  const Latest& latest_;
  const ViewOptions& options_;
  const bool operates_;  ///< the client may take the controls
  std::unique_ptr<remote::Session> session_;
  Protocol protocol_{};
  SendQueue queue_;
  std::map<std::uint64_t, Reply> pending_{};
  std::optional<CallReply> futures_call_{};  ///< that waits for its futures
  std::deque<AssetQuestion> assets_{};       ///< read one by one, when the last one is sent
  std::set<std::string> watched_{};
  bool watches_all_ = false;
  bool lacks_state_ = false;
  std::uint64_t told_situation_ = 0;
  bool told_controls_ = false;
  std::size_t complaints_ = 0;
  TimePoint second_{};
};

}  // namespace articula::view

// SPDX-License-Identifier: Apache-2.0
/// @file The Foxglove WebSocket protocol from a client to the server. Pure: frames in, actions out.
#pragma once

#include "articula/view/protocol/action.hpp"
#include "articula/view/protocol/json/json.hpp"
#include "articula/view/protocol/messages/channels.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace articula::view {

/// The server's side of one connection: reads the frames of the client and remembers what it has
/// subscribed to and advertised. Any bytes may come. Its memory is bounded.
class Protocol {
 public:
  static constexpr std::size_t client_channel_limit = 64;

  /// What a frame of text asks for.
  [[nodiscard]] std::vector<Action> read_text(std::string_view text);
  /// What a binary frame asks for.
  [[nodiscard]] std::vector<Action> read_bytes(std::string_view bytes);

  /// The number that the client has given to its subscription of a topic, if it has one.
  [[nodiscard]] std::optional<std::uint32_t> subscription(Topic topic) const noexcept {
    return subscriptions_[static_cast<std::size_t>(topic)];
  }

 private:
  using Actions = std::vector<Action>;

  void subscribe(const Json& message, Actions& actions);
  void unsubscribe(const Json& message, Actions& actions);
  void advertise(const Json& message, Actions& actions);
  void unadvertise(const Json& message, Actions& actions);
  void publish(std::string_view bytes, Actions& actions) const;

  std::array<std::optional<std::uint32_t>, topic_count> subscriptions_{};
  /// Topics that nobody listens to have no value.
  std::map<std::uint32_t, std::optional<ClientTopic>> client_channels_{};
};

}  // namespace articula::view

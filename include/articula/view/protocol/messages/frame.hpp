// SPDX-License-Identifier: Apache-2.0
/// @file Frames of the Foxglove WebSocket protocol from the server to a client.
#pragma once

#include "articula/view/protocol/json/json.hpp"
#include "articula/view/protocol/messages/stream_messages.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace articula::view {

/// A text that many clients get.
using SharedText = std::shared_ptr<const std::string>;

/// The text of a value, for many clients.
[[nodiscard]] SharedText share(const Json& json);

/// A WebSocket frame: a head of its client's own and a body that may be shared between clients.
struct Frame {
  bool is_text = true;
  std::string head{};
  SharedText body{};

  [[nodiscard]] std::size_t size() const noexcept {
    return head.size() + (body ? body->size() : 0);
  }
};

/// A frame of text, as {"op": "status", ..}.
[[nodiscard]] Frame text_frame(const Json& json);
/// The same of a text that many clients get.
[[nodiscard]] Frame text_frame(SharedText text);

/// The protocol's "status": level 0 information, 1 warning, 2 error.
[[nodiscard]] Frame status_frame(int level, std::string_view message);

/// Message data of a subscription.
[[nodiscard]] Frame message_frame(std::uint32_t subscription, WallTime time, SharedText message);

/// The response to a service call.
[[nodiscard]] Frame response_frame(std::uint32_t service, std::uint32_t call, const Json& response);

/// A service call that was malformed.
[[nodiscard]] Frame failure_frame(std::uint32_t service, std::uint32_t call,
                                  std::string_view message);

/// A file that was asked for, or why there is none.
/// @param file  null: the text of `error` is sent
[[nodiscard]] Frame asset_frame(std::uint32_t request, SharedText file, std::string_view error);

}  // namespace articula::view

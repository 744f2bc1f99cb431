// SPDX-License-Identifier: Apache-2.0
#include "articula/view/protocol/messages/frame.hpp"

#include <utility>

namespace articula::view {

namespace {

/// Appends an unsigned integer, the lowest byte first.
template <class Integer>
void append_bytes(std::string& bytes, Integer x) {
  for (std::size_t i = 0; i < sizeof x; ++i) {
    bytes += static_cast<char>(static_cast<unsigned char>(x >> (8 * i)));
  }
}

void append_text(std::string& bytes, std::string_view text) {
  append_bytes(bytes, static_cast<std::uint32_t>(text.size()));
  bytes += text;
}

}  // namespace

SharedText share(const Json& json) { return std::make_shared<const std::string>(to_text(json)); }

Frame text_frame(const Json& json) { return {true, to_text(json), nullptr}; }

Frame text_frame(SharedText text) { return {true, {}, std::move(text)}; }

Frame status_frame(int level, std::string_view message) {
  return text_frame(Json{{"op", "status"}, {"level", level}, {"message", message}});
}

Frame message_frame(std::uint32_t subscription, WallTime time, SharedText message) {
  Frame frame{false, "\x01", std::move(message)};
  append_bytes(frame.head, subscription);
  append_bytes(frame.head, time);
  return frame;
}

Frame response_frame(std::uint32_t service, std::uint32_t call, const Json& response) {
  Frame frame{false, "\x03", nullptr};
  append_bytes(frame.head, service);
  append_bytes(frame.head, call);
  append_text(frame.head, "json");
  frame.head += to_text(response);
  return frame;
}

Frame failure_frame(std::uint32_t service, std::uint32_t call, std::string_view message) {
  return text_frame(Json{{"op", "serviceCallFailure"},
                         {"serviceId", service},
                         {"callId", call},
                         {"message", message}});
}

Frame asset_frame(std::uint32_t request, SharedText file, std::string_view error) {
  Frame frame{false, "\x04", std::move(file)};
  append_bytes(frame.head, request);
  frame.head += static_cast<char>(frame.body ? 0 : 1);
  append_text(frame.head, frame.body ? std::string_view() : error);
  return frame;
}

}  // namespace articula::view

// SPDX-License-Identifier: Apache-2.0
/// @file The functions that a page's JavaScript calls, see page/src/live_socket.ts.
#include "articula/view/live/live_loop.hpp"

#include <cstddef>
#include <exception>
#include <memory>
#include <optional>
#include <string>

namespace {

std::unique_ptr<articula::view::LiveLoop> loop;
std::string incoming;
std::string outgoing;

}  // namespace

#if defined(__wasm__)
#define ARTICULA_DETAIL_EXPORT(name) extern "C" [[gnu::used, clang::export_name(#name)]]
#else
#define ARTICULA_DETAIL_EXPORT(name) extern "C"
#endif

/// Makes the loop.
/// @return 0, or the length of the reason why it cannot be made, which is in the outgoing bytes
ARTICULA_DETAIL_EXPORT(articula_open) std::size_t articula_open() {
  try {
    loop = articula::live_loop();
    return 0;
  } catch (const std::exception& error) {
    outgoing = error.what();
  }
  return outgoing.size();
}

/// Memory for a frame from the page.
ARTICULA_DETAIL_EXPORT(articula_incoming) char* articula_incoming(std::size_t size) {
  incoming.resize(size);
  return incoming.data();
}
/// Takes the frame that is in this memory.
ARTICULA_DETAIL_EXPORT(articula_receive) void articula_receive(int is_text) {
  loop->receive(is_text != 0, incoming);
}

/// Lets time pass. See LiveLoop::advance.
ARTICULA_DETAIL_EXPORT(articula_advance) void articula_advance(double seconds, double wall) {
  loop->advance(seconds, static_cast<articula::view::WallTime>(wall));
}

/// Prepares the next frame to the page.
/// @return 0: there is none, 1: bytes, 2: text
ARTICULA_DETAIL_EXPORT(articula_take) int articula_take() {
  const std::optional<articula::view::Frame> frame = loop->take();
  if (!frame) return 0;
  outgoing = frame->head;
  if (frame->body) outgoing += *frame->body;
  return frame->is_text ? 2 : 1;
}
/// Its bytes.
ARTICULA_DETAIL_EXPORT(articula_outgoing) const char* articula_outgoing() {
  return outgoing.data();
}
/// Their number.
ARTICULA_DETAIL_EXPORT(articula_outgoing_size) std::size_t articula_outgoing_size() {
  return outgoing.size();
}

// SPDX-License-Identifier: Apache-2.0
/// @file The futures that clients have asked for.
#pragma once

#include "articula/remote/port.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>

namespace articula::view {

/// Answers questions for futures. This one answers at once, in the thread of the caller, as a page
/// without threads needs it. FuturesThread answers in a thread of its own.
class FuturesDesk {
 public:
  using ClientNumber = std::uint64_t;
  /// An answer, or the reason why there is none.
  using Answer = std::variant<remote::FuturesAnswer, std::string>;

  /// @param port  outlives this
  explicit FuturesDesk(remote::Port& port) : port_(port) {}
  virtual ~FuturesDesk() = default;
  FuturesDesk(const FuturesDesk&) = delete;
  FuturesDesk& operator=(const FuturesDesk&) = delete;

  /// The number of a new client.
  [[nodiscard]] ClientNumber next_number() noexcept { return ++last_number_; }

  /// Takes a question. It replaces the client's last one if that is not begun yet.
  virtual void ask(ClientNumber client, const remote::FuturesQuestion& question);
  /// The answer to the client's last question, if it is there.
  [[nodiscard]] virtual std::optional<Answer> take(ClientNumber client);
  /// The client has left.
  virtual void forget(ClientNumber client);

 protected:
  [[nodiscard]] Answer answer_to(const remote::FuturesQuestion& question);

 private:
  remote::Port& port_;
  ClientNumber last_number_ = 0;
  std::map<ClientNumber, Answer> answers_{};
};

}  // namespace articula::view

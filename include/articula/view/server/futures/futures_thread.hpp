// SPDX-License-Identifier: Apache-2.0
/// @file Futures, computed in a thread of their own.
#pragma once

#include "articula/loop/stop_flag.hpp"
#include "articula/view/server/futures/futures_desk.hpp"

#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <thread>

namespace articula::view {

/// A FuturesDesk whose thread answers the clients in the order in which they began to wait, one
/// question of each. Nobody waits for it. The thread begins with the first question.
class FuturesThread final : public FuturesDesk {
 public:
  using FuturesDesk::FuturesDesk;
  /// Ends the simulation that is under way.
  ~FuturesThread() override;

  void ask(ClientNumber client, const remote::FuturesQuestion& question) override;
  [[nodiscard]] std::optional<Answer> take(ClientNumber client) override;
  void forget(ClientNumber client) override;

 private:
  /// What is known of a client.
  struct Client {
    std::optional<remote::FuturesQuestion> question{};  ///< not begun yet
    std::optional<Answer> answer{};
    std::uint64_t number = 0;  ///< of its last question, of all clients'
    std::uint64_t place = 0;   ///< number of the first question since its last one was begun
  };

  void work();

  std::mutex mutex_{};
  std::condition_variable asked_{};
  std::map<ClientNumber, Client> clients_{};
  std::optional<ClientNumber> answered_{};  ///< the client whose question is being answered
  StopFlag stop_{};                         ///< of that answer
  std::uint64_t questions_ = 0;
  bool ends_ = false;
  std::thread thread_{};
};

}  // namespace articula::view

// SPDX-License-Identifier: Apache-2.0
#include "articula/view/server/futures/futures_thread.hpp"

#include <utility>

namespace articula::view {

FuturesThread::~FuturesThread() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
    stop_.request();
  }
  asked_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void FuturesThread::ask(ClientNumber client, const remote::FuturesQuestion& question) {
  const std::lock_guard lock(mutex_);
  Client& own = clients_[client];
  ++questions_;
  if (!own.question) own.place = questions_;
  own.question = question;
  own.answer.reset();
  own.number = questions_;
  if (!thread_.joinable()) thread_ = std::thread([this] { work(); });
  asked_.notify_one();
}

std::optional<FuturesDesk::Answer> FuturesThread::take(ClientNumber client) {
  const std::lock_guard lock(mutex_);
  const auto found = clients_.find(client);
  if (found == clients_.end() || !found->second.answer) return std::nullopt;
  return std::exchange(found->second.answer, std::nullopt);
}

void FuturesThread::forget(ClientNumber client) {
  const std::lock_guard lock(mutex_);
  clients_.erase(client);
  if (answered_ == client) stop_.request();
}

void FuturesThread::work() {
  std::unique_lock lock(mutex_);
  // The client that has waited longest.
  const auto next = [this] {
    auto first = clients_.end();
    for (auto own = clients_.begin(); own != clients_.end(); ++own) {
      const bool waits = own->second.question.has_value();
      if (waits && (first == clients_.end() || own->second.place < first->second.place))
        first = own;
    }
    return first;
  };
  while (true) {
    auto client = clients_.end();
    asked_.wait(lock, [&] { return ends_ || (client = next()) != clients_.end(); });
    if (ends_) return;
    answered_ = client->first;
    stop_.clear();
    const std::uint64_t number = client->second.number;
    remote::FuturesQuestion question = *std::exchange(client->second.question, std::nullopt);
    question.stop = &stop_;
    lock.unlock();
    Answer answer = answer_to(question);
    lock.lock();
    const auto found = clients_.find(*std::exchange(answered_, std::nullopt));
    if (found != clients_.end() && found->second.number == number) {
      found->second.answer = std::move(answer);
    }
  }
}

}  // namespace articula::view

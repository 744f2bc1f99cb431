// SPDX-License-Identifier: Apache-2.0
#include "articula/view/server/futures/futures_desk.hpp"

#include <exception>
#include <utility>

namespace articula::view {

void FuturesDesk::ask(ClientNumber client, const remote::FuturesQuestion& question) {
  answers_.insert_or_assign(client, answer_to(question));
}

std::optional<FuturesDesk::Answer> FuturesDesk::take(ClientNumber client) {
  auto found = answers_.extract(client);
  if (found.empty()) return std::nullopt;
  return std::move(found.mapped());
}

void FuturesDesk::forget(ClientNumber client) { answers_.erase(client); }

FuturesDesk::Answer FuturesDesk::answer_to(const remote::FuturesQuestion& question) {
  try {
    return port_.futures(question);
  } catch (const std::exception& error) {
    return std::string(error.what());
  }
}

}  // namespace articula::view

// SPDX-License-Identifier: Apache-2.0
#include "articula/view/server/clients/broadcast.hpp"

#include "articula/view/protocol/messages/messages.hpp"
#include "articula/view/protocol/messages/stream_messages.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace articula::view {

Broadcast::Broadcast(remote::Port& port)
    : port_(port),
      session_(port.connect("view", false)),
      latest_(port.robot(),
              std::to_string(std::chrono::system_clock::now().time_since_epoch().count())),
      cycles_(cycles_a_message) {}

void Broadcast::tick(TimePoint now, WallTime wall) {
  latest_.now = wall;
  tell_cycles();
  tell_events();
  tell_situation();
  if (now - half_second_ >= std::chrono::milliseconds(500)) {
    half_second_ = now;
    tell_statistics();
    tell_parameters();
  }
  for (Client* client : clients_) client->tick(now);
}

bool Broadcast::anybody_wants(Topic topic) const {
  return std::any_of(clients_.begin(), clients_.end(),
                     [&](const Client* client) { return client->wants(topic); });
}

void Broadcast::stream(Topic topic, std::string message) {
  const auto shared = std::make_shared<const std::string>(std::move(message));
  for (Client* client : clients_) client->stream(topic, shared);
}

std::size_t Broadcast::read_cycles() {
  std::size_t count = 0;
  while (count < cycles_.size() && session_->next(cycles_[count])) ++count;
  return count;
}

void Broadcast::tell_cycles() {
  const remote::Cycle* newest = nullptr;
  for (std::size_t message = 0; message < messages_a_tick; ++message) {
    const std::size_t count = read_cycles();
    if (count == 0) break;
    const std::span<const remote::Cycle> cycles(cycles_.data(), count);
    newest = &cycles.back();
    const std::uint64_t first = cycles.front().number;
    const std::uint64_t dropped =
        next_number_ > 0 && first > next_number_ ? first - next_number_ : 0;
    next_number_ = newest->number + 1;
    if (anybody_wants(Topic::cycles)) {
      stream(Topic::cycles, cycles_message(port_.robot(), cycles, dropped));
    }
    if (count < cycles_.size()) break;
  }
  if (newest != nullptr) newest_ = *newest;
  // A loop that stands still, as a paused simulation, has no new cycle for a new client.
  bool is_lacking = false;
  for (Client* client : clients_) is_lacking |= client->take_lack_of_state();
  if (newest_ && (newest != nullptr || is_lacking)) tell_newest(*newest_);
}

void Broadcast::tell_newest(const remote::Cycle& cycle) {
  const WallTime stamp = stamp_of(cycle.time);
  if (anybody_wants(Topic::joint_states)) {
    stream(Topic::joint_states, joint_states_message(port_.robot(), cycle, stamp));
  }
  if (anybody_wants(Topic::ros_joint_states)) {
    stream(Topic::ros_joint_states, ros_states_message(port_.robot(), cycle, stamp));
  }
  if (anybody_wants(Topic::ros_reference)) {
    stream(Topic::ros_reference, ros_reference_message(port_.robot(), cycle, stamp));
  }
  if (anybody_wants(Topic::ros_command)) {
    stream(Topic::ros_command, ros_command_message(port_.robot(), cycle, stamp));
  }
  const auto& links = port_.robot().links;
  if (!links.empty() && anybody_wants(Topic::transforms)) {
    stream(Topic::transforms,
           transforms_message(port_.link_poses(cycle.position), links.front(), stamp));
  }
}

void Broadcast::tell_events() {
  while (const auto event = session_->event()) {
    const auto message =
        std::make_shared<const std::string>(to_text(log_json(*event, stamp_of(event->time))));
    latest_.log.push_back(message);
    if (latest_.log.size() > Latest::log_length) latest_.log.pop_front();
    for (Client* client : clients_) client->announce(Topic::log, message);
  }
}

void Broadcast::tell_situation() {
  latest_.situation = port_.situation();
  std::string text = to_text(situation_json(latest_.situation, false, false));
  if (text == situation_) return;
  situation_ = std::move(text);
  ++latest_.situation_version;  // Each client tells it in its tick, with its own part.
}

void Broadcast::tell_statistics() {
  const auto message =
      std::make_shared<const std::string>(to_text(statistics_json(port_.statistics())));
  latest_.statistics = message;
  for (Client* client : clients_) client->stream(Topic::statistics, message);
}

void Broadcast::tell_parameters() {
  std::vector<remote::Parameter> now = port_.parameters(), changed;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const bool same = i < parameters_.size() && parameters_[i].name == now[i].name &&
                      parameters_[i].value == now[i].value;
    if (!same) changed.push_back(now[i]);
  }
  parameters_ = std::move(now);
  if (changed.empty()) return;
  for (Client* client : clients_) client->tell_changes(changed);
}

WallTime Broadcast::stamp_of(double time) {
  // Viewers compare stamps with the time of the day.
  if (loop_start_ == 0) loop_start_ = static_cast<double>(latest_.now) * 1e-9 - time;
  return static_cast<WallTime>(std::max(0.0, (loop_start_ + time) * 1e9));
}

}  // namespace articula::view

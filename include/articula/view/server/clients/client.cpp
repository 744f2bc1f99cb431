// SPDX-License-Identifier: Apache-2.0
#include "articula/view/server/clients/client.hpp"

#include "articula/view/protocol/messages/messages.hpp"
#include "articula/view/protocol/requests/futures_messages.hpp"
#include "articula/view/server/clients/files.hpp"

#include <algorithm>
#include <utility>

namespace articula::view {

namespace {

constexpr const char* only_shows =
    "this view only shows: its program runs with --read-only, or without ViewOptions::operates";
constexpr std::size_t watch_limit = 4096;  // names of parameters
constexpr std::size_t asset_limit = 1024;  // files that wait to be read

}  // namespace

Client::Client(remote::Port& port, FuturesDesk& futures, const Latest& latest,
               const ViewOptions& options, const std::string& name)
    : port_(port),
      futures_(futures),
      number_(futures.next_number()),
      latest_(latest),
      options_(options),
      operates_(options.operates.value_or(false)),
      session_(port.connect(name, operates_)),
      queue_(options.queue_limit) {
  queue_.add_answer(text_frame(latest.server_info));
  queue_.add_answer(text_frame(latest.advertise));
  queue_.add_answer(text_frame(latest.advertise_services));
}

Client::~Client() { futures_.forget(number_); }

void Client::receive(bool is_text, std::string_view bytes) {
  const auto actions = is_text ? protocol_.read_text(bytes) : protocol_.read_bytes(bytes);
  for (const Action& action : actions) std::visit([&](const auto& x) { act(x); }, action);
  take_answers();
}

void Client::tick(TimePoint now) {
  take_answers();
  take_futures();
  tell_situation();
  if (now - second_ < std::chrono::seconds(1)) return;
  second_ = now;
  complaints_ = 0;
  if (const auto dropped = queue_.take_dropped(); dropped > 0) {
    queue_.add_answer(status_frame(
        1, std::to_string(dropped) + " messages were dropped: this client reads too slowly"));
  }
}

void Client::stream(Topic topic, const SharedText& message) {
  const auto subscription = protocol_.subscription(topic);
  if (subscription) queue_.add_stream(message_frame(*subscription, latest_.now, message));
}

void Client::announce(Topic topic, const SharedText& message) {
  const auto subscription = protocol_.subscription(topic);
  if (subscription && message) {
    queue_.add_answer(message_frame(*subscription, latest_.now, message));
  }
}

std::optional<Frame> Client::take() {
  if (!queue_.has_answers() && !assets_.empty()) {
    queue_.add_answer(asset(assets_.front()));
    assets_.pop_front();
  }
  return queue_.take();
}

// --- what a client asks for --------------------------------------------------------------------

void Client::act(const Subscribed& action) {
  switch (action.topic) {
    case Topic::robot_description:
      return announce(action.topic, latest_.robot_description);
    case Topic::situation:
      told_situation_ = 0;  // The next tick tells it.
      return tell_situation();
    case Topic::statistics:
      return announce(action.topic, latest_.statistics);
    case Topic::log:
      for (const SharedText& entry : latest_.log) announce(action.topic, entry);
      return;
    case Topic::joint_states:
    case Topic::transforms:
    case Topic::ros_joint_states:
    case Topic::ros_reference:
    case Topic::ros_command:
      lacks_state_ = true;
      return;
    case Topic::cycles:
      return;
  }
}

void Client::act(const ParameterQuestion& action) { send_parameters(action.names, action.id); }

void Client::act(const ParameterSetting& action) {
  SettingReply reply{action.id, {}};
  for (const remote::ParameterValue& value : action.values) reply.names.push_back(value.name);
  ask(remote::SetParameters{action.values}, reply);
}

void Client::act(const MalformedParameters& action) {
  complain(action.text);
  send_parameters({}, action.id);
}

void Client::act(const ParameterWatch& action) {
  if (action.names.empty()) {
    watches_all_ = action.watch;
    watched_.clear();
  }
  for (const std::string& name : action.names) {
    if (!action.watch) {
      watched_.erase(name);
    } else if (watched_.size() < watch_limit) {
      watched_.insert(name);
    }
  }
}

void Client::act(const ServiceCall& action) {
  const CallReply to{action.service, action.call};
  if (const auto* refusal = std::get_if<Refusal>(&action.asked)) {
    reply(to, false, std::string(services()[action.service - 1].name) + ": " + refusal->text);
  } else if (const auto* query = std::get_if<Query>(&action.asked)) {
    queue_.add_answer(response_frame(action.service, action.call, answer_of(*query)));
  } else if (const auto* controls = std::get_if<ControlsRequest>(&action.asked)) {
    const std::string reason = change_controls(controls->take);
    reply(to, reason.empty(), reason.empty() ? "done" : reason);
  } else if (const auto* question = std::get_if<remote::FuturesQuestion>(&action.asked)) {
    ask(*question, to);
  } else {
    ask(std::get<remote::Request>(action.asked), to);
  }
}

void Client::act(const MalformedCall& action) {
  queue_.add_answer(failure_frame(action.service, action.call, action.text));
}

void Client::act(const Published& action) {
  if (const auto* request = std::get_if<remote::Request>(&action.asked)) {
    ask(*request, PublicationReply{});
  } else if (const auto* refusal = std::get_if<Refusal>(&action.asked)) {
    complain(refusal->text);
  }
}

void Client::act(const AssetQuestion& action) {
  if (assets_.size() < asset_limit) {
    assets_.push_back(action);
  } else {
    queue_.add_answer(asset_frame(action.request, nullptr, "too many files are asked for at once"));
  }
}

void Client::act(const Complaint& action) { complain(action.text); }

// --- answers -----------------------------------------------------------------------------------

void Client::ask(const remote::Request& request, const Reply& to) {
  if (!operates_) return reply(to, false, only_shows);
  if (pending_.size() >= pending_limit) {
    return reply(to, false, "too many requests of this client wait for their answer; wait for it");
  }
  pending_.emplace(session_->ask(request), to);  // takes the controls, if the request needs them
}

// They take a core's time, so those who only watch cannot ask.
void Client::ask(const remote::FuturesQuestion& question, const CallReply& to) {
  if (!operates_) return reply(to, false, only_shows);
  if (futures_call_)
    reply(*futures_call_, false, "futures: a newer question has replaced this one");
  futures_call_ = to;
  futures_.ask(number_, question);
}

void Client::take_futures() {
  if (!futures_call_) return;
  const auto answer = futures_.take(number_);
  if (!answer) return;
  const CallReply to = *std::exchange(futures_call_, std::nullopt);
  if (const auto* reason = std::get_if<std::string>(&*answer)) return reply(to, false, *reason);
  Json json = futures_json(std::get<remote::FuturesAnswer>(*answer), port_.robot());
  json["success"] = true;
  json["message"] = "done";
  queue_.add_answer(response_frame(to.service, to.call, json));
}

void Client::take_answers() {
  while (const auto answer = session_->answer()) {
    const auto found = pending_.find(answer->request);
    if (found == pending_.end()) continue;
    const Reply to = std::move(found->second);
    pending_.erase(found);
    reply(to, answer->verdict == remote::Verdict::done, answer->text, answer->cycle);
  }
}

void Client::reply(const Reply& to, bool success, const std::string& text,
                   unsigned long long cycle) {
  if (const auto* call = std::get_if<CallReply>(&to)) {
    Json json = {{"success", success}, {"message", text.empty() ? "done" : text}};
    if (cycle > 0) json["cycle"] = cycle;
    queue_.add_answer(response_frame(call->service, call->call, json));
    return;
  }
  if (!success) complain(text);
  if (const auto* setting = std::get_if<SettingReply>(&to)) {
    send_parameters(setting->names, setting->id);
  }
}

void Client::complain(const std::string& text) {
  if (++complaints_ <= complaints_a_second) queue_.add_answer(status_frame(2, text));
}

std::string Client::change_controls(bool take) {
  if (!take) {
    session_->release_controls();
    return {};
  }
  if (!operates_) return only_shows;
  return session_->has_controls() ? std::string() : session_->take_controls();
}

Json Client::answer_of(Query query) {
  Json json;
  switch (query) {
    case Query::robot:
      json = robot_json(port_.robot());
      break;
    case Query::parameters:
      json = parameters_json(port_.parameters());
      break;
    case Query::situation:
      json = situation_json(port_.situation(), operates_, session_->has_controls());
      break;
    case Query::statistics:
      json = statistics_json(port_.statistics());
      break;
  }
  json["success"] = true;
  json["message"] = "done";
  return json;
}

void Client::tell_situation() {
  if (!wants(Topic::situation)) return;
  const bool controls = session_->has_controls();
  if (told_situation_ == latest_.situation_version && told_controls_ == controls) return;
  told_situation_ = latest_.situation_version;
  told_controls_ = controls;
  announce(Topic::situation, share(situation_json(latest_.situation, operates_, controls)));
}

void Client::send_parameters(const std::vector<std::string>& names,
                             const std::optional<std::string>& id) {
  const auto wanted = [&](const std::string& name) {
    return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
  };
  Json json = {{"op", "parameterValues"}, {"parameters", Json::array()}};
  if (id) json["id"] = *id;
  for (const char* name : {"/robot_description", "robot_description"}) {
    if (!wanted(name)) continue;
    json["parameters"].push_back({{"name", name}, {"value", port_.robot().urdf}});
  }
  for (const remote::Parameter& parameter : port_.parameters()) {
    if (!wanted(parameter.name)) continue;
    json["parameters"].push_back(
        {{"name", parameter.name}, {"value", parameter.value}, {"type", "float64"}});
  }
  queue_.add_answer(text_frame(json));
}

void Client::tell_changes(const std::vector<remote::Parameter>& changed) {
  Json json = {{"op", "parameterValues"}, {"parameters", Json::array()}};
  for (const remote::Parameter& parameter : changed) {
    if (!watches_all_ && !watched_.contains(parameter.name)) continue;
    json["parameters"].push_back(
        {{"name", parameter.name}, {"value", parameter.value}, {"type", "float64"}});
  }
  if (!json["parameters"].empty()) queue_.add_answer(text_frame(json));
}

Frame Client::asset(const AssetQuestion& question) const {
  constexpr std::string_view scheme = "package://";
  const std::string_view uri = question.uri;
  if (uri.substr(0, scheme.size()) != scheme) {
    return asset_frame(question.request, nullptr, "only files of package:// are served");
  }
  const auto file = mesh_file(options_, uri.substr(scheme.size()));
  const SharedText contents = file ? contents_of(*file) : nullptr;
  return asset_frame(question.request, contents,
                     "there is no such file in the folders of ViewOptions::mesh_folders");
}

}  // namespace articula::view

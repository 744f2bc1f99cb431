// SPDX-License-Identifier: Apache-2.0
#include "articula/view/protocol/protocol.hpp"

#include "articula/view/protocol/read_stateless.hpp"

#include <algorithm>
#include <utility>

namespace articula::view {

std::vector<Action> Protocol::read_text(std::string_view text) {
  const auto message = parse_json(text);
  if (!message || !message->is_object()) return {Complaint{"a text must be a JSON object"}};
  const std::string op = text_of(*message, "op").value_or("");
  Actions actions;
  if (op == "subscribe") {
    subscribe(*message, actions);
  } else if (op == "unsubscribe") {
    unsubscribe(*message, actions);
  } else if (op == "advertise") {
    advertise(*message, actions);
  } else if (op == "unadvertise") {
    unadvertise(*message, actions);
  } else {
    actions.push_back(read_stateless(op, *message));
  }
  return actions;
}

std::vector<Action> Protocol::read_bytes(std::string_view bytes) {
  Actions actions;
  const char code = bytes.empty() ? '\0' : bytes.front();
  bytes.remove_prefix(bytes.empty() ? 0 : 1);
  if (code == 1) {
    publish(bytes, actions);
  } else if (code == 2) {
    actions.push_back(read_service_call(bytes));
  } else {
    actions.push_back(Complaint{"there is no binary message " +
                                std::to_string(static_cast<unsigned char>(code))});
  }
  return actions;
}

void Protocol::subscribe(const Json& message, Actions& actions) {
  const Json* list = list_of(message, "subscriptions");
  if (list == nullptr) {
    actions.push_back(expected("subscribe", "\"subscriptions\", an array"));
    return;
  }
  for (const Json& entry : *list) {
    const auto id = number_of(entry, "id"), channel = number_of(entry, "channelId");
    if (!id || !channel || *channel == 0 || *channel > topic_count) {
      actions.push_back(expected("subscribe", "an \"id\" and the \"channelId\" of a channel"));
      continue;
    }
    if (std::find(subscriptions_.begin(), subscriptions_.end(), id) != subscriptions_.end()) {
      actions.push_back(Complaint{"subscribe: the id " + std::to_string(*id) + " is in use"});
      continue;
    }
    auto& subscription = subscriptions_[*channel - 1];
    if (subscription) {
      actions.push_back(Complaint{"subscribe: channel " + std::to_string(*channel) +
                                  " has a subscription already"});
      continue;
    }
    subscription = id;
    actions.push_back(Subscribed{static_cast<Topic>(*channel - 1)});
  }
}

void Protocol::unsubscribe(const Json& message, Actions& actions) {
  const Json* list = list_of(message, "subscriptionIds");
  if (list == nullptr) {
    actions.push_back(expected("unsubscribe", "\"subscriptionIds\", an array"));
    return;
  }
  for (const Json& id : *list) {
    for (auto& subscription : subscriptions_) {
      if (subscription && id == *subscription) subscription.reset();
    }
  }
}

void Protocol::advertise(const Json& message, Actions& actions) {
  const Json* list = list_of(message, "channels");
  if (list == nullptr) {
    actions.push_back(expected("advertise", "\"channels\", an array"));
    return;
  }
  for (const Json& entry : *list) {
    const auto id = number_of(entry, "id");
    const auto topic = text_of(entry, "topic");
    if (!id || !topic) {
      actions.push_back(expected("advertise", "an \"id\" and a \"topic\" in each channel"));
      continue;
    }
    if (client_channels_.size() >= client_channel_limit && !client_channels_.contains(*id)) {
      actions.push_back(Complaint{"advertise: a client has at most " +
                                  std::to_string(client_channel_limit) + " channels"});
      return;
    }
    // Foxglove's panels advertise topics that nobody uses. That is no fault.
    std::optional<ClientTopic> known;
    if (*topic == "/reference") known = ClientTopic::reference;
    if (*topic == "/joint_trajectory") known = ClientTopic::joint_trajectory;
    if (known && text_of(entry, "encoding") != "json") {
      actions.push_back(expected("advertise", "the encoding \"json\" for " + *topic));
      continue;
    }
    client_channels_[*id] = known;
  }
}

void Protocol::unadvertise(const Json& message, Actions& actions) {
  const Json* list = list_of(message, "channelIds");
  if (list == nullptr) {
    actions.push_back(expected("unadvertise", "\"channelIds\", an array"));
    return;
  }
  for (const Json& id : *list) {
    std::erase_if(client_channels_, [&](const auto& channel) { return id == channel.first; });
  }
}

void Protocol::publish(std::string_view bytes, Actions& actions) const {
  const auto id = take_number(bytes);
  const auto channel = id ? client_channels_.find(*id) : client_channels_.end();
  if (channel == client_channels_.end()) {
    actions.push_back(Complaint{"a message was published to a channel that is not advertised"});
  } else if (!channel->second) {
    actions.push_back(
        Complaint{"nobody listens to this topic; publish to /reference or /joint_trajectory"});
  } else if (const auto json = parse_json(bytes)) {
    actions.push_back(Published{read_message(*channel->second, *json)});
  } else {
    actions.push_back(Complaint{"a published message is not JSON"});
  }
}

}  // namespace articula::view

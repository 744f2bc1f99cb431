// SPDX-License-Identifier: Apache-2.0
/// @file The actions that a client's frame asks of the server.
#pragma once

#include "articula/remote/gains/parameter.hpp"
#include "articula/view/protocol/messages/channels.hpp"
#include "articula/view/protocol/requests/requests.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace articula::view {

/// A client wants the messages of a topic.
struct Subscribed {
  Topic topic = Topic::joint_states;
};
/// A client asks for parameters; for all if there is no name.
struct ParameterQuestion {
  std::vector<std::string> names{};
  std::optional<std::string> id{};  ///< comes back with the answer
};
/// A client sets parameters.
struct ParameterSetting {
  std::vector<remote::ParameterValue> values{};
  std::optional<std::string> id{};  ///< likewise
};
/// A client asked for parameters or set them in a way that is not the protocol's.
struct MalformedParameters {
  std::string text{};
  std::optional<std::string> id{};  ///< likewise: the client may wait for it
};
/// A client subscribes to changes of parameters, or unsubscribes. No name: all.
struct ParameterWatch {
  std::vector<std::string> names{};
  bool watch = true;
};
/// A client calls a service.
struct ServiceCall {
  std::uint32_t service = 0;
  std::uint32_t call = 0;
  Asked asked{};
};
/// A client called a service in a way that is not the protocol's.
struct MalformedCall {
  std::uint32_t service = 0;
  std::uint32_t call = 0;
  std::string text{};
};
/// A client published a message.
struct Published {
  Asked asked{};
};
/// A client wants a file.
struct AssetQuestion {
  std::string uri{};
  std::uint32_t request = 0;
};
/// A client did something else that cannot be done.
struct Complaint {
  std::string text{};
};

/// What a client's frame asks of the server.
using Action =
    std::variant<Subscribed, ParameterQuestion, ParameterSetting, MalformedParameters,
                 ParameterWatch, ServiceCall, MalformedCall, Published, AssetQuestion, Complaint>;

}  // namespace articula::view

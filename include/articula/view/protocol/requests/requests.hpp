// SPDX-License-Identifier: Apache-2.0
/// @file Requests to the loop, read from JSON. Pure: texts in, requests or refusals out.
#pragma once

#include "articula/remote/forecast/futures_question.hpp"
#include "articula/remote/request.hpp"
#include "articula/view/protocol/json/json.hpp"
#include "articula/view/protocol/json/members.hpp"

#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace articula::view {

/// Questions that need no controls and are answered at once.
enum class Query : unsigned char { robot, parameters, situation, statistics };

/// Takes or gives back the controls.
struct ControlsRequest {
  bool take = true;
};

/// Why a request was not read.
struct Refusal {
  std::string text{};
};

/// What a service call asks for.
using Asked =
    std::variant<Refusal, Query, ControlsRequest, remote::FuturesQuestion, remote::Request>;

/// A service: a request that clients call by name.
struct Service {
  std::string_view name{};
  std::span<const Member> members{};  ///< of the JSON object in the call
  Asked (*read)(const Json&) = nullptr;
};

/// All services. The number of a service in the protocol is its index plus 1.
[[nodiscard]] std::span<const Service> services();

/// What a call of a service asks for.
/// @param call  a JSON object
[[nodiscard]] Asked read_call(const Service& service, const Json& call);

/// Topics that clients publish to.
enum class ClientTopic : unsigned char { reference, joint_trajectory };

/// What a message published to a topic asks for: a request or a refusal.
/// @param message  a JSON object
[[nodiscard]] Asked read_message(ClientTopic topic, const Json& message);

}  // namespace articula::view

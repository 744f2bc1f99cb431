// SPDX-License-Identifier: Apache-2.0
#include "articula/view/protocol/requests/requests.hpp"

#include "articula/recording/change_json.hpp"
#include "articula/view/protocol/requests/futures_messages.hpp"
#include "articula/view/protocol/requests/read_motion.hpp"

#include <array>

namespace articula::view {

namespace {

using enum Kind;

constexpr std::array go_members{Member{"positions", number_by_name, true}, Member{"speed", number}};
constexpr std::array reference_members{Member{"positions", number_by_name},
                                       Member{"velocities", number_by_name},
                                       Member{"efforts", number_by_name}};
constexpr std::array switch_members{Member{"start", texts}, Member{"stop", texts},
                                    Member{"best_effort", boolean}, Member{"replace", boolean}};
constexpr std::array stop_members{Member{"joints", texts}};
constexpr std::array parameter_members{Member{"values", gain_by_name, true}};
constexpr std::array pause_members{Member{"paused", boolean, true}};
constexpr std::array step_members{Member{"cycles", integer}};
constexpr std::array speed_members{Member{"factor", number, true}};
constexpr std::array reset_members{Member{"positions", number_by_name}};
constexpr std::array pull_members{Member{"link", text, true}, Member{"point", three_numbers, true},
                                  Member{"force", three_numbers, true}};

std::vector<std::string> texts_of(const Json& call, const char* name) {
  return call.value(name, std::vector<std::string>{});
}

/// The request of a type without members.
template <class Request>
Asked plain(const Json&) {
  return remote::Request(Request{});
}

template <Query query>
Asked question(const Json&) {
  return query;
}

Asked go(const Json& call) {
  return remote::Request(
      remote::Go{joint_values(call, "positions"), call.value("speed", remote::Go{}.speed)});
}

Asked set_reference(const Json& call) {
  return remote::Request(remote::SetReference{joint_values(call, "positions"),
                                              joint_values(call, "velocities"),
                                              joint_values(call, "efforts")});
}

Asked switch_controllers(const Json& call) {
  return remote::Request(remote::SwitchControllers{texts_of(call, "start"), texts_of(call, "stop"),
                                                   call.value("best_effort", false),
                                                   call.value("replace", false)});
}

Asked set_parameters(const Json& call) {
  remote::SetParameters request;
  for (const auto& [name, value] : call.at("values").items()) {
    request.values.push_back({name, gain_of_json(value).value()});
  }
  return remote::Request(request);
}

Asked step(const Json& call) {
  return remote::Request(remote::Step{call.value("cycles", remote::Step{}.cycles)});
}

Asked pull(const Json& call) {
  using Three = std::array<double, 3>;
  return remote::Request(remote::Pull{call.at("link").get<std::string>(),
                                      call.at("point").get<Three>(),
                                      call.at("force").get<Three>()});
}

constexpr std::array<Member, 0> none{};

const std::array table{
    Service{"/take_controls", none, [](const Json&) -> Asked { return ControlsRequest{true}; }},
    Service{"/release_controls", none, [](const Json&) -> Asked { return ControlsRequest{false}; }},
    Service{"/activate", none, plain<remote::Activate>},
    Service{"/deactivate", none, plain<remote::Deactivate>},
    Service{"/acknowledge_fault", none, plain<remote::AcknowledgeFault>},
    Service{"/go", go_members, go},
    Service{"/set_reference", reference_members, set_reference},
    Service{"/play_trajectory", trajectory_members, read_trajectory},
    Service{"/play_signals", play_signals_members, read_signals},
    Service{"/stop", stop_members,
            [](const Json& call) -> Asked {
              return remote::Request(remote::Stop{texts_of(call, "joints")});
            }},
    Service{"/switch_controllers", switch_members, switch_controllers},
    Service{"/set_parameters", parameter_members, set_parameters},
    Service{"/pause", pause_members,
            [](const Json& call) -> Asked {
              return remote::Request(remote::Pause{call.at("paused").get<bool>()});
            }},
    Service{"/step", step_members, step},
    Service{"/set_speed", speed_members,
            [](const Json& call) -> Asked {
              return remote::Request(remote::SetSpeed{call.at("factor").get<double>()});
            }},
    Service{"/reset", reset_members,
            [](const Json& call) -> Asked {
              return remote::Request(remote::Reset{joint_values(call, "positions")});
            }},
    Service{"/pull", pull_members, pull},
    Service{"/robot", none, question<Query::robot>},
    Service{"/describe_parameters", none, question<Query::parameters>},
    Service{"/situation", none, question<Query::situation>},
    Service{"/statistics", none, question<Query::statistics>},
    Service{"/futures", futures_members, read_futures},
};

Asked read(std::span<const Member> members, Asked (*read)(const Json&), const Json& object) {
  if (!object.is_object()) return Refusal{"expected a JSON object"};
  if (std::string fault = fault_of(object, members); !fault.empty()) return Refusal{fault};
  return read(object);
}

}  // namespace

std::span<const Service> services() { return table; }

Asked read_call(const Service& service, const Json& call) {
  return read(service.members, service.read, call);
}

Asked read_message(ClientTopic topic, const Json& message) {
  return topic == ClientTopic::reference
             ? read(published_reference_members, read_published_reference, message)
             : read(trajectory_members, read_trajectory, message);
}

}  // namespace articula::view

// SPDX-License-Identifier: Apache-2.0
#include "articula/view/protocol/protocol.hpp"

#include "articula/view/protocol/json/json.hpp"
#include "articula/view/protocol/messages/frame.hpp"
#include "articula/view/protocol/read_stateless.hpp"
#include "catch.hpp"

#include <limits>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

using namespace articula::view;
namespace remote = articula::remote;

namespace {

/// The only action that a text asks for.
template <class Wanted>
Wanted only(Protocol& protocol, const std::string& text) {
  const auto actions = protocol.read_text(text);
  REQUIRE(actions.size() == 1);
  REQUIRE(std::holds_alternative<Wanted>(actions.front()));
  return std::get<Wanted>(actions.front());
}

std::string number(std::uint32_t x) {
  std::string bytes;
  for (int i = 0; i < 4; ++i, x >>= 8) bytes += static_cast<char>(x & 255);
  return bytes;
}

std::uint32_t id_of(std::string_view name) {
  for (std::size_t i = 0; i < services().size(); ++i) {
    if (services()[i].name == name) return static_cast<std::uint32_t>(i + 1);
  }
  FAIL("no service " << name);
  return 0;
}

std::string call_bytes(std::uint32_t service, const std::string& json,
                       const std::string& encoding = "json") {
  return "\x02" + number(service) + number(77) +
         number(static_cast<std::uint32_t>(encoding.size())) + encoding + json;
}

/// What a call of a service asks for.
Asked called(const std::string& name, const std::string& json) {
  Protocol protocol;
  const auto actions = protocol.read_bytes(call_bytes(id_of(name), json));
  REQUIRE(actions.size() == 1);
  REQUIRE(std::holds_alternative<ServiceCall>(actions.front()));
  const auto& call = std::get<ServiceCall>(actions.front());
  CHECK(call.call == 77);
  return call.asked;
}

template <class Request>
Request request_of(const std::string& name, const std::string& json) {
  const Asked asked = called(name, json);
  INFO(name << ' ' << json);
  if (const auto* refusal = std::get_if<Refusal>(&asked)) FAIL(refusal->text);
  REQUIRE(std::holds_alternative<remote::Request>(asked));
  return std::get<Request>(std::get<remote::Request>(asked));
}

std::string refusal_of(const std::string& name, const std::string& json) {
  const Asked asked = called(name, json);
  INFO(name << ' ' << json);
  REQUIRE(std::holds_alternative<Refusal>(asked));
  return std::get<Refusal>(asked).text;
}

}  // namespace

TEST_CASE("a client subscribes to a channel once, under a number of its own") {
  Protocol protocol;
  const auto actions = protocol.read_text(
      R"({"op":"subscribe","subscriptions":[{"id":0,"channelId":4},{"id":9,"channelId":1}]})");
  REQUIRE(actions.size() == 2);
  CHECK(std::get<Subscribed>(actions[0]).topic == Topic::cycles);
  CHECK(std::get<Subscribed>(actions[1]).topic == Topic::joint_states);
  CHECK(protocol.subscription(Topic::cycles) == 0u);
  CHECK(protocol.subscription(Topic::joint_states) == 9u);
  CHECK_FALSE(protocol.subscription(Topic::log));

  only<Complaint>(protocol, R"({"op":"subscribe","subscriptions":[{"id":9,"channelId":2}]})");
  only<Complaint>(protocol, R"({"op":"subscribe","subscriptions":[{"id":5,"channelId":1}]})");
  CHECK(protocol.read_text(R"({"op":"unsubscribe","subscriptionIds":[9,123,"x",-9]})").empty());
  CHECK_FALSE(protocol.subscription(Topic::joint_states));
  CHECK(protocol.subscription(Topic::cycles) == 0u);
  only<Subscribed>(protocol, R"({"op":"subscribe","subscriptions":[{"id":9,"channelId":1}]})");
}

TEST_CASE("texts that are no messages of the protocol are complained about") {
  Protocol protocol;
  for (const char* text :
       {"",
        "x",
        "[]",
        "{}",
        "null",
        R"({"op":1})",
        R"({"op":"fly"})",
        R"({"op":"subscribe"})",
        R"({"op":"subscribe","subscriptions":{}})",
        R"({"op":"unsubscribe"})",
        R"({"op":"subscribe","subscriptions":[7]})",
        R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":0}]})",
        R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":11}]})",
        R"({"op":"subscribe","subscriptions":[{"id":-1,"channelId":1}]})",
        R"({"op":"subscribe","subscriptions":[{"id":4294967296,"channelId":1}]})",
        R"({"op":"subscribe","subscriptions":[{"id":1.5,"channelId":1}]})",
        R"({"op":"advertise"})",
        R"({"op":"advertise","channels":[{"id":1}]})",
        R"({"op":"unadvertise"})",
        R"({"op":"advertise","channels":[{"id":1,"topic":"/reference","encoding":"cdr"}]})",
        R"({"op":"subscribeParameterUpdates"})",
        R"({"op":"fetchAsset","uri":"a"})",
        R"({"op":"fetchAsset","requestId":1})",
        "{\"op\":\"\xff\"}"}) {
    INFO(text);
    only<Complaint>(protocol, text);
  }
  // Nesting beyond the limit is refused before it is read.
  const std::string deep(100000, '[');
  only<Complaint>(protocol, deep);
  only<Complaint>(protocol, R"({"op":"getParameters","parameterNames":)" + deep + "}");
}

TEST_CASE("a malformed request for parameters keeps its id") {
  Protocol protocol;
  const std::string many = Json(std::vector<std::string>(longest_list + 1, "a")).dump();
  for (const std::string& members :
       {std::string(R"("op":"getParameters")"),
        std::string(R"("op":"getParameters","parameterNames":[1])"),
        R"("op":"getParameters","parameterNames":)" + many, std::string(R"("op":"setParameters")"),
        R"("op":"setParameters","parameters":)" + many,
        std::string(R"("op":"setParameters","parameters":[{"value":1}])"),
        std::string(R"("op":"setParameters","parameters":[{"name":"a","value":"b"}])"),
        std::string(R"("op":"setParameters","parameters":[{"name":"a"}])")}) {
    INFO(members);
    const auto kept = only<MalformedParameters>(protocol, "{" + members + R"(,"id":"x"})");
    CHECK(kept.id == "x");
    CHECK(kept.text.find("expected") != std::string::npos);
    CHECK_FALSE(only<MalformedParameters>(protocol, "{" + members + "}").id);
  }
}

TEST_CASE("parameters are asked for, set and watched by name") {
  Protocol protocol;
  const auto question = only<ParameterQuestion>(
      protocol, R"({"op":"getParameters","parameterNames":["a","b"],"id":"x"})");
  CHECK(question.names == std::vector<std::string>{"a", "b"});
  CHECK(question.id == "x");
  CHECK_FALSE(
      only<ParameterQuestion>(protocol, R"({"op":"getParameters","parameterNames":[]})").id);

  const auto setting = only<ParameterSetting>(
      protocol,
      R"({"op":"setParameters","parameters":[{"name":"a","value":3},{"name":"b","value":-0.5,"type":"float64"}]})");
  REQUIRE(setting.values.size() == 2);
  CHECK(setting.values[0].name == "a");
  CHECK(setting.values[0].value == 3);
  CHECK(setting.values[1].value == -0.5);

  CHECK(
      only<ParameterWatch>(protocol, R"({"op":"subscribeParameterUpdates","parameterNames":["a"]})")
          .watch);
  CHECK_FALSE(
      only<ParameterWatch>(protocol, R"({"op":"unsubscribeParameterUpdates","parameterNames":[]})")
          .watch);
}

TEST_CASE("messages are published to two topics, and to others in vain") {
  Protocol protocol;
  CHECK(protocol
            .read_text(R"({"op":"advertise","channels":[
      {"id":1,"topic":"/reference","encoding":"json","schemaName":"any"},
      {"id":2,"topic":"/joint_trajectory","encoding":"json","schemaName":"any"},
      {"id":3,"topic":"/clicked_point","encoding":"cdr","schemaName":"any"}]})")
            .empty());
  const auto publish = [&](std::uint32_t channel, const std::string& json) {
    const auto actions = protocol.read_bytes("\x01" + number(channel) + json);
    REQUIRE(actions.size() == 1);
    return actions.front();
  };
  const auto set = std::get<Published>(publish(
      1, R"({"header":{},"name":["a","b"],"position":[1,2],"velocity":[3,4],"effort":[]})"));
  const auto reference = std::get<remote::SetReference>(std::get<remote::Request>(set.asked));
  REQUIRE(reference.positions.size() == 2);
  CHECK(reference.positions[1].joint == "b");
  CHECK(reference.positions[1].value == 2);
  CHECK(reference.velocities[0].value == 3);
  CHECK(reference.efforts.empty());

  const auto play = std::get<Published>(publish(
      2,
      R"({"joint_names":["a"],"points":[{"positions":[1],"time_from_start":{"sec":2,"nanosec":500000000}}]})"));
  const auto trajectory =
      std::get<remote::PlayTrajectory>(std::get<remote::Request>(play.asked)).trajectory;
  CHECK(trajectory.points[0].time_from_start == 2.5);

  const auto wrong = std::get<Published>(publish(1, R"({"name":["a"],"position":[1,2]})"));
  CHECK(std::get<Refusal>(wrong.asked).text ==
        "position: has 2 numbers; expected none, or one for each of 1 names");
  CHECK(std::holds_alternative<Refusal>(std::get<Published>(publish(1, "[]")).asked));
  CHECK(std::holds_alternative<Complaint>(publish(1, "{")));
  CHECK(std::holds_alternative<Complaint>(publish(3, "{}")));
  CHECK(std::holds_alternative<Complaint>(publish(4, "{}")));
  CHECK(protocol.read_text(R"({"op":"unadvertise","channelIds":[1]})").empty());
  CHECK(std::holds_alternative<Complaint>(publish(1, R"({"name":[]})")));
}

TEST_CASE("a client's channels are bounded in number") {
  Protocol protocol;
  std::size_t complaints = 0;
  for (int id = 0; id < 1000; ++id) {
    complaints += protocol
                      .read_text(R"({"op":"advertise","channels":[{"id":)" + std::to_string(id) +
                                 R"(,"topic":"/x"}]})")
                      .size();
  }
  CHECK(complaints == 1000 - Protocol::client_channel_limit);
}

TEST_CASE("services become requests") {
  CHECK(std::get<ControlsRequest>(called("/take_controls", "{}")).take);
  CHECK_FALSE(std::get<ControlsRequest>(called("/release_controls", "")).take);
  CHECK(std::get<Query>(called("/robot", "{}")) == Query::robot);
  CHECK(std::get<Query>(called("/describe_parameters", "{}")) == Query::parameters);
  CHECK(std::get<Query>(called("/situation", "{}")) == Query::situation);
  CHECK(std::get<Query>(called("/statistics", "{}")) == Query::statistics);
  (void)request_of<remote::Activate>("/activate", "{}");
  (void)request_of<remote::Deactivate>("/deactivate", "{}");
  (void)request_of<remote::AcknowledgeFault>("/acknowledge_fault", "{}");
  (void)request_of<remote::Stop>("/stop", "{}");

  const auto go = request_of<remote::Go>("/go", R"({"positions":{"a":0.5,"b":-1},"speed":0.25})");
  REQUIRE(go.positions.size() == 2);
  CHECK(go.positions[0].joint == "a");
  CHECK(go.positions[0].value == 0.5);
  CHECK(go.speed == 0.25);
  CHECK(request_of<remote::Go>("/go", R"({"positions":{}})").speed == 1);

  const auto set = request_of<remote::SetReference>(
      "/set_reference", R"({"positions":{"a":1},"velocities":{"a":2},"efforts":{"b":3}})");
  CHECK(set.velocities.at(0).value == 2);
  CHECK(set.efforts.at(0).joint == "b");

  const auto change = request_of<remote::SwitchControllers>(
      "/switch_controllers", R"({"start":["a"],"stop":["b","c"],"best_effort":true})");
  CHECK(change.start == std::vector<std::string>{"a"});
  CHECK(change.stop.size() == 2);
  CHECK(change.best_effort);
  CHECK_FALSE(change.replace);

  CHECK(request_of<remote::SetParameters>("/set_parameters", R"({"values":{"p":3}})")
            .values.at(0)
            .value == 3);
  CHECK(request_of<remote::SetParameters>("/set_parameters", R"({"values":{"p":"-inf"}})")
            .values.at(0)
            .value == -std::numeric_limits<double>::infinity());
  CHECK_THAT(refusal_of("/set_parameters", R"({"values":{"p":"nan"}})"),
             Catch::Contains("values: expected an object of numbers"));
  CHECK_FALSE(request_of<remote::Pause>("/pause", R"({"paused":false})").paused);
  CHECK(request_of<remote::Step>("/step", R"({"cycles":7})").cycles == 7);
  CHECK(request_of<remote::Step>("/step", "{}").cycles == 1);
  CHECK(request_of<remote::SetSpeed>("/set_speed", R"({"factor":0.5})").factor == 0.5);
  CHECK(request_of<remote::Reset>("/reset", "{}").positions.empty());
  const auto pull =
      request_of<remote::Pull>("/pull", R"({"link":"hand","point":[1,2,3],"force":[4,5.5,6]})");
  CHECK(pull.point[2] == 3);
  CHECK(pull.force[1] == 5.5);
}

TEST_CASE("trajectories and signals have the members of their types") {
  const auto play =
      request_of<remote::PlayTrajectory>("/play_trajectory",
                                         R"({"header":{"stamp":0},"joint_names":["a","b"],"points":[
        {"positions":[1,2],"velocities":[3,4],"accelerations":[5,6],"effort":[7,8],"time_from_start":0.5},
        {"positions":[1,2],"time_from_start":{"sec":1}}]})");
  CHECK(play.trajectory.joint_names.at(1) == "b");
  REQUIRE(play.trajectory.points.size() == 2);
  CHECK(play.trajectory.points[0].accelerations.at(1) == 6);
  CHECK(play.trajectory.points[0].effort.at(0) == 7);
  CHECK(play.trajectory.points[1].time_from_start == 1);
  CHECK(refusal_of("/play_trajectory", R"({"joint_names":["a"],"points":[{"positions":[1]}]})") ==
        "points[0].time_from_start: missing; expected a number of seconds, or {\"sec\": 1, "
        "\"nanosec\": 0}");

  const auto signals = request_of<remote::PlaySignals>("/play_signals",
                                                       R"({"duration":4,"signals":[
        {"joint":"a","kind":"step","height":0.1,"start":1},
        {"joint":"a","kind":"ramp","height":0.1,"duration":2},
        {"joint":"a","kind":"sine","amplitude":0.1,"frequency":2,"phase":0.5,"offset":1},
        {"joint":"a","kind":"square","amplitude":0.1,"frequency":2,"target":"effort"},
        {"joint":"b","kind":"chirp","amplitude":0.1,"first_frequency":1,"last_frequency":9,"duration":3}]})");
  CHECK(signals.duration == 4);
  REQUIRE(signals.signals.size() == 5);
  CHECK(std::get<articula::StepSignal>(signals.signals[0].signal).start == 1);
  CHECK(std::get<articula::RampSignal>(signals.signals[1].signal).duration == 2);
  CHECK(std::get<articula::SineSignal>(signals.signals[2].signal).phase == 0.5);
  CHECK(std::get<articula::SquareSignal>(signals.signals[3].signal).frequency == 2);
  CHECK(signals.signals[3].target == articula::SignalTarget::effort);
  CHECK(std::get<articula::ChirpSignal>(signals.signals[4].signal).last_frequency == 9);
  CHECK(refusal_of("/play_signals", R"({"duration":1,"signals":[{"joint":"a","kind":"saw"}]})") ==
        "signals[0].kind: expected \"step\", \"ramp\", \"sine\", \"square\" or \"chirp\"");
  CHECK(refusal_of(
            "/play_signals",
            R"({"duration":1,"signals":[{"joint":"a","kind":"step","height":1,"target":"x"}]})") ==
        "signals[0].target: expected \"position\" or \"effort\"");
}

TEST_CASE("a refusal names the member, and what was expected") {
  CHECK(refusal_of("/go", "{}") ==
        "positions: missing; expected an object of numbers, as {\"shoulder\": 0.5}");
  CHECK(refusal_of("/go", R"({"position":{}})") == "position: unknown; expected positions, speed");
  CHECK(refusal_of("/activate", R"({"now":true})") == "now: unknown; expected no members");
  CHECK(refusal_of("/stop", R"({"now":true})") == "now: unknown; expected joints");
  CHECK(refusal_of("/go", R"({"positions":{"a":"b"}})") ==
        "positions: expected an object of numbers, as {\"shoulder\": 0.5}");
  CHECK(refusal_of("/go", R"({"positions":{},"speed":"fast"})") == "speed: expected a number");
  CHECK(refusal_of("/step", R"({"cycles":1.5})") == "cycles: expected an integer of 32 bits");
  CHECK(refusal_of("/step", R"({"cycles":3000000000})") ==
        "cycles: expected an integer of 32 bits");
  CHECK(refusal_of("/pause", R"({"paused":1})") == "paused: expected true or false");
  CHECK(refusal_of("/pull", R"({"link":"a","point":[1,2],"force":[1,2,3]})") ==
        "point: expected an array of three numbers");
  CHECK(refusal_of("/switch_controllers", R"({"start":"a"})") ==
        "start: expected an array of texts of at most 256 bytes");
  // A name of a megabyte is not repeated in a message.
  CHECK(refusal_of("/go", "{\"" + std::string(1 << 20, 'x') + "\":1}").size() < 1000);
  CHECK(refusal_of("/go", "{\"positions\":{\"" + std::string(1 << 20, 'x') + "\":1}}").size() <
        1000);
}

TEST_CASE("malformed calls fail with their number") {
  Protocol protocol;
  const auto failure = [&](const std::string& bytes) {
    const auto actions = protocol.read_bytes(bytes);
    REQUIRE(actions.size() == 1);
    REQUIRE(std::holds_alternative<MalformedCall>(actions.front()));
    const auto& call = std::get<MalformedCall>(actions.front());
    CHECK(call.call == 77);
    return call.text;
  };
  CHECK(failure(call_bytes(0, "{}")) == "there is no such service");
  CHECK(failure(call_bytes(1000, "{}")) == "there is no such service");
  CHECK(failure(call_bytes(1, "{}", "cdr")) == "the encoding of a call must be \"json\"");
  CHECK(failure(call_bytes(1, "{")) == "the text of a call must be a JSON object");
  CHECK(failure(call_bytes(1, "[]")) == "the text of a call must be a JSON object");
  CHECK(failure(call_bytes(1, "{\"a\":1e999}")) == "the text of a call must be a JSON object");
  const std::string good = call_bytes(1, "{}");
  for (std::size_t size = 0; size < 1 + 12 + 4; ++size) {  // without its end
    const auto actions = protocol.read_bytes(good.substr(0, size));
    REQUIRE(actions.size() == 1);
    CHECK(std::holds_alternative<Complaint>(actions.front()));
  }
}

TEST_CASE("frames have the bytes of the protocol") {
  const auto message = std::make_shared<const std::string>("{}");
  const Frame data = message_frame(0x01020304, 0x1122334455667788, message);
  CHECK_FALSE(data.is_text);
  CHECK(data.head == std::string("\x01\x04\x03\x02\x01\x88\x77\x66\x55\x44\x33\x22\x11"));
  CHECK(data.body == message);

  const Frame response = response_frame(5, 6, Json{{"success", true}});
  CHECK(response.head == "\x03" + number(5) + number(6) + number(4) + "json{\"success\":true}");

  const Frame missing = asset_frame(9, nullptr, "no");
  CHECK(missing.head == "\x04" + number(9) + "\x01" + number(2) + "no");
  const Frame asset = asset_frame(9, message, "unused");
  CHECK(asset.head == "\x04" + number(9) + std::string(1, '\0') + number(0));
  CHECK(asset.body == message);

  const Json status = Json::parse(status_frame(2, "a\xff").head);
  CHECK(status["op"] == "status");
  CHECK(status["level"] == 2);
}

// SPDX-License-Identifier: Apache-2.0
#include "articula/view/server/clients/client.hpp"

#include "articula/ros2/cdr_decoder.hpp"
#include "articula/ros2/messages/sensor_msgs.hpp"
#include "articula/view/server/clients/broadcast.hpp"
#include "articula/view/server/futures/futures_thread.hpp"
#include "catch.hpp"
#include "fake_port.hpp"
#include "scratch_folder.hpp"

#include <chrono>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

using namespace articula::view;
using articula::ViewOptions;
using support::FakePort;

namespace ros2 = articula::ros2;

namespace {

std::string number(std::uint32_t x) {
  std::string bytes;
  for (int i = 0; i < 4; ++i, x >>= 8) bytes += static_cast<char>(x & 255);
  return bytes;
}

/// A client without a connection, and what it was sent.
struct Talk {
  explicit Talk(FakePort& port, ViewOptions view_options = {.operates = true})
      : options(std::move(view_options)),
        broadcast(port),
        futures(port),
        client(port, futures, broadcast.latest(), options, "somebody") {
    broadcast.add(client);
  }

  void tick() {
    now += std::chrono::milliseconds(17);
    broadcast.tick(now, 1'700'000'000'000'000'000);
  }
  void text(const std::string& json) { client.receive(true, json); }
  void subscribe(Topic topic) {
    const std::string id = std::to_string(static_cast<int>(topic) + 1);
    text(R"({"op":"subscribe","subscriptions":[{"id":)" + id + R"(,"channelId":)" + id + "}]}");
  }
  /// All that was sent since the last call.
  std::vector<Frame> sent() {
    std::vector<Frame> frames;
    while (auto frame = client.take()) frames.push_back(std::move(*frame));
    return frames;
  }
  /// The texts among it.
  std::vector<Json> texts() {
    std::vector<Json> found;
    for (const Frame& frame : sent()) {
      if (frame.is_text) found.push_back(Json::parse(frame.body ? *frame.body : frame.head));
    }
    return found;
  }
  /// The messages of a topic among it.
  std::vector<Json> messages(Topic topic) {
    std::vector<Json> found;
    const std::string begin = "\x01" + number(static_cast<std::uint32_t>(topic) + 1);
    for (const Frame& frame : sent()) {
      if (frame.head.starts_with(begin)) found.push_back(Json::parse(*frame.body));
    }
    return found;
  }
  void send_call(const std::string& name, const std::string& json) {
    std::uint32_t id = 1;
    while (services()[id - 1].name != name) ++id;
    client.receive(false, "\x02" + number(id) + number(1) + number(4) + "json" + json);
  }
  /// The answer to a call that is answered at once.
  Json call(const std::string& name, const std::string& json = "{}") {
    (void)sent();
    send_call(name, json);
    for (const Frame& frame : sent()) {
      if (frame.head.starts_with('\x03')) return Json::parse(frame.head.substr(1 + 12 + 4));
    }
    FAIL("no answer");
    return {};
  }

  ViewOptions options;
  Broadcast broadcast;
  FuturesDesk futures;
  Client client;
  Client::TimePoint now = std::chrono::steady_clock::now();
};

}  // namespace

TEST_CASE("a new client gets the server's name, channels and services") {
  FakePort port;
  Talk talk(port);
  const auto texts = talk.texts();
  REQUIRE(texts.size() == 3);
  CHECK(texts[0]["op"] == "serverInfo");
  CHECK(texts[0]["name"] == "articula: fake arm");
  CHECK(texts[1]["channels"].size() == topic_count);
  CHECK(texts[2]["services"].size() == services().size());
}

TEST_CASE("a client that takes nothing but ROS 2 messages sees state, reference and command") {
  FakePort port;
  Talk talk(port);
  std::map<std::string, int> taken;  // ids by topic, as PlotJuggler chooses them
  const std::vector<Json> texts = talk.texts();
  for (const Json& channel : texts.at(1).at("channels")) {
    if (channel["encoding"] != "cdr" || channel["schemaEncoding"] != "ros2msg") continue;
    CHECK(channel["schemaName"] == "sensor_msgs/msg/JointState");
    CHECK(channel["schema"].get<std::string>().find("MSG: std_msgs/Header") != std::string::npos);
    taken[channel["topic"]] = channel["id"];
  }
  REQUIRE(taken.size() == 3);
  for (const auto& [topic, id] : taken) {
    talk.text(R"({"op":"subscribe","subscriptions":[{"id":)" + std::to_string(100 + id) +
              R"(,"channelId":)" + std::to_string(id) + "}]}");
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(5));  // the port makes cycles
  talk.tick();
  std::map<int, ros2::sensor_msgs::msg::JointState<ros2::Jazzy>> states;
  for (const Frame& frame : talk.sent()) {
    for (const auto& [topic, id] : taken) {
      if (!frame.head.starts_with("\x01" + number(static_cast<std::uint32_t>(100 + id)))) continue;
      REQUIRE(ros2::decode(std::as_bytes(std::span(*frame.body)), states[id]) ==
              ros2::CdrError::none);
    }
  }
  REQUIRE(states.size() == 3);
  const auto& state = states[taken["/ros/joint_states"]];
  CHECK(state.header.stamp.sec >= 1'699'999'999);  // of the wall's time in `tick`
  CHECK(state.name == std::vector<std::string>{"shoulder", "elbow", "finger"});
  CHECK(state.position.size() == 3);
  CHECK(state.effort.size() == 3);
  const auto& command = states[taken["/ros/command"]];
  CHECK(command.name == std::vector<std::string>{"shoulder", "elbow"});
  CHECK(command.position.empty());
  CHECK(command.effort.size() == 2);
  CHECK(states[taken["/ros/reference"]].position.size() == 2);
}

TEST_CASE("futures are answered with quantiles, curves and margins") {
  FakePort port;
  Talk talk(port);
  (void)talk.sent();
  talk.send_call("/futures", R"({"gains":{"pid.elbow.p":3},"count":3,"horizon":2,"delay":4})");
  CHECK(talk.sent().empty());
  talk.tick();
  const auto frames = talk.sent();
  REQUIRE(frames.size() == 1);
  const Json answer = Json::parse(frames[0].head.substr(1 + 12 + 4));
  CHECK(answer["success"] == true);
  CHECK(answer["horizon"] == 2);
  CHECK(answer["count"] == 3);
  CHECK(answer["unstable"] == 1);
  CHECK(answer["joints"][1]["name"] == "elbow");
  CHECK(answer["joints"][1]["curves"].size() == 3);
  // The fake port's future k is at 3 (k + 1) at the second sample.
  CHECK(answer["joints"][1]["quantiles"] == Json::parse("[[0,3],[0,3],[0,6],[0,9],[0,9]]"));
  CHECK(answer["margins"][0]["joint"] == "elbow");
  CHECK(answer["margins"][0]["gain_margin"].is_null());
  CHECK(answer["margins"][0]["delay_margin"] == 4);
}

TEST_CASE("futures that cannot be simulated are refused with the reason") {
  FakePort port;
  Talk talk(port);
  CHECK(talk.call("/futures", R"({"count":"many"})")["message"].get<std::string>().find("count") !=
        std::string::npos);
  talk.send_call("/futures", R"({"gains":{"no.such.gain":3}})");
  talk.tick();
  const Json answer = Json::parse(talk.sent().at(0).head.substr(1 + 12 + 4));
  CHECK(answer["success"] == false);
  CHECK(answer["message"] == "there is no parameter 'no.such.gain'");

  Talk watcher(port, {.operates = false});
  CHECK(watcher.call("/futures")["success"] == false);
}

TEST_CASE("futures begin where the question says, and follow its references and steps") {
  FakePort port;
  Talk talk(port);
  (void)talk.sent();
  talk.send_call("/futures", R"({"count":1,"reference_step":0.01,"steps":{"elbow":0.1},
      "start":{"time":7.5,"position":[1,2],"velocity":[3,4],"effort":[5,6]},
      "history":[{"position":[1,2],"velocity":[3,4],"effort":[5,6],"command":[[7,8]],
          "reference_position":[9,10],"reference_velocity":[11,12]}],
      "references":[{"position":[1,2],"velocity":[0,1]},{"position":[2,3],"effort":[4,5]}]})");
  talk.tick();
  const Json answer = Json::parse(talk.sent().at(0).head.substr(1 + 12 + 4));
  CHECK(answer["time"] == 7.5);
  using Numbers = std::vector<double>;
  const articula::remote::FuturesQuestion& question = port.last_question;
  REQUIRE(question.start);
  CHECK(question.start->position == Numbers{1, 2});
  CHECK(question.start->velocity == Numbers{3, 4});
  CHECK(question.start->effort == Numbers{5, 6});
  REQUIRE(question.history.size() == 1);
  CHECK(question.history[0].state.position == Numbers{1, 2});
  CHECK(question.history[0].state.effort == Numbers{5, 6});
  CHECK(question.history[0].reference.position == Numbers{9, 10});
  CHECK(question.history[0].reference.velocity == Numbers{11, 12});
  CHECK(question.history[0].command == std::vector<Numbers>{{7, 8}});
  REQUIRE(question.references.size() == 2);
  CHECK(question.references[0].velocity == Numbers{0, 1});
  CHECK(question.references[0].effort.empty());
  CHECK(question.references[1].effort == Numbers{4, 5});
  CHECK(question.reference_step == 0.01);
  REQUIRE(question.steps.size() == 1);
  CHECK(question.steps[0].joint == "elbow");
  CHECK(question.steps[0].height == 0.1);
  const auto refusal = [&](const char* call) {
    return talk.call("/futures", call)["message"].get<std::string>();
  };
  CHECK(refusal(R"({"start":{"time":1}})") ==
        "/futures: start.position: missing; expected an array of numbers");
  CHECK(
      refusal(R"({"references":[{"position":[1]},{"places":[1]}]})").find("references[1].places") !=
      std::string::npos);
  CHECK(refusal(R"({"history":[{"command":[1]}]})")
            .find("history[0].command: expected an array of arrays") != std::string::npos);
}

TEST_CASE("of several questions for futures the newest one is answered") {
  FakePort port;
  Talk talk(port);
  talk.send_call("/futures", R"({"gains":{"pid.elbow.p":3},"count":1})");
  const Json first = talk.call("/futures", R"({"gains":{"pid.elbow.p":5},"count":1})");
  CHECK(first["success"] == false);
  CHECK(first["message"] == "futures: a newer question has replaced this one");
  talk.tick();
  const Json second = Json::parse(talk.sent().at(0).head.substr(1 + 12 + 4));
  CHECK(second["joints"][1]["curves"][0][1] == 5);
}

TEST_CASE("a thread for futures answers each client's last question, and no client that has left") {
  FakePort port;
  FuturesThread desk(port);
  const auto a = desk.next_number(), b = desk.next_number(), gone = desk.next_number();
  for (const double gain : {1.0, 2.0, 3.0}) {
    desk.ask(a, {.gains = {{"pid.elbow.p", gain}}, .options = {.count = 1}});
    desk.ask(gone, {});
  }
  desk.forget(gone);
  desk.ask(b, {.gains = {{"no.such.gain", 1}}});
  const auto answer_to = [&](FuturesDesk::ClientNumber client) {
    while (true) {
      if (auto answer = desk.take(client)) return *answer;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  };
  const auto answer = std::get<articula::remote::FuturesAnswer>(answer_to(a));
  CHECK(answer.futures.at(0).positions[1][1] == 3);
  CHECK(std::holds_alternative<std::string>(answer_to(b)));
  CHECK_FALSE(desk.take(a).has_value());
  CHECK_FALSE(desk.take(gone).has_value());
}

TEST_CASE(
    "a question is not answered to its end when its client has left; the longest waiting is next") {
  FakePort port;
  FuturesThread desk(port);
  const auto a = desk.next_number(), b = desk.next_number(), gone = desk.next_number();
  desk.ask(gone, {.options = {.horizon = 9}});
  while (port.questions == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  for (const auto& [client, gain] : {std::pair(b, 1.0), {a, 3.0}, {b, 2.0}}) {
    desk.ask(client, {.gains = {{"pid.elbow.p", gain}}, .options = {.count = 1}});
  }
  desk.forget(gone);
  while (!desk.take(a)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  CHECK(port.answered_gains == std::vector<double>{1, 2, 3});  // the first is the default of `gone`
}

TEST_CASE("the end of a view ends the question under way") {
  FakePort port;
  FuturesThread desk(port);
  desk.ask(desk.next_number(), {.options = {.horizon = 9}});
  while (port.questions == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

TEST_CASE("topics that change seldom are sent at once to who subscribes") {
  FakePort port;
  Talk talk(port);
  talk.tick();
  (void)talk.sent();
  talk.subscribe(Topic::robot_description);
  CHECK(talk.messages(Topic::robot_description).at(0)["data"] == port.robot().urdf);
  talk.subscribe(Topic::situation);
  CHECK(talk.messages(Topic::situation).at(0)["mode"] == "active");
  talk.subscribe(Topic::log);
  CHECK(talk.messages(Topic::log).at(0)["message"] == "view has come");
  talk.subscribe(Topic::statistics);
  CHECK(talk.messages(Topic::statistics).size() == 1);
  talk.tick();
  CHECK(talk.messages(Topic::situation).empty());  // nothing has changed
}

TEST_CASE("a change of the situation is told to each client, with its own part") {
  FakePort port;
  Talk talk(port);
  Client other(port, talk.futures, talk.broadcast.latest(), talk.options, "another");
  talk.broadcast.add(other);
  talk.subscribe(Topic::situation);
  talk.tick();
  (void)talk.sent();
  CHECK(talk.call("/pause", R"({"paused":true})")["success"] == true);
  talk.tick();
  const Json situation = talk.messages(Topic::situation).at(0);
  CHECK(situation["paused"] == true);
  CHECK(situation["operator"] == "somebody");
  CHECK(situation["you_operate"] == true);
  while (other.take()) {
  }
  other.receive(true, R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":5}]})");
  const auto frame = other.take();
  REQUIRE(frame);
  CHECK(Json::parse(*frame->body)["you_operate"] == false);
  talk.broadcast.remove(other);
}

TEST_CASE("cycles come in order and without a gap") {
  FakePort port;
  Talk talk(port);
  talk.subscribe(Topic::cycles);
  std::uint64_t next = 0;
  for (int tick = 0; tick < 20; ++tick) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    talk.tick();
    for (const Json& message : talk.messages(Topic::cycles)) {
      CHECK(message["dropped"] == 0);
      for (const Json& k : message["number"]) {
        if (next > 0) CHECK(k == next);
        next = k.get<std::uint64_t>() + 1;
      }
    }
  }
  CHECK(next > 0);
}

TEST_CASE("requests go to the port, and refusals come back with their reason") {
  FakePort port;
  Talk talk(port);
  CHECK(talk.call("/go", R"({"positions":{"elbow":0.5}})") ==
        Json{{"success", true}, {"message", "done"}, {"cycle", 8}});
  CHECK(port.reference()[1] == 0.5);
  CHECK(talk.call("/go", R"({"positions":{"knee":0.5}})") ==
        Json{{"success", false}, {"message", "there is no joint 'knee'"}});
  CHECK(talk.call("/go", "{}")["message"] ==
        "/go: positions: missing; expected an object of numbers, as {\"shoulder\": 0.5}");
  CHECK(talk.call("/robot")["joints"].size() == 2);
  CHECK(talk.call("/describe_parameters")["parameters"].size() == 2);
  CHECK(talk.call("/situation")["operator"] == "somebody");
  CHECK(talk.call("/statistics")["success"] == true);
}

TEST_CASE("one client operates at a time") {
  FakePort port;
  Talk first(port);
  Client another(port, first.futures, first.broadcast.latest(), first.options, "another");
  CHECK(first.call("/take_controls")["success"] == true);
  const std::string id = number(1), take = "\x02" + id + id + number(4) + "json{}";
  const auto last_answer = [&] {
    std::string answer;
    while (const auto frame = another.take()) answer = frame->head;
    return answer;
  };
  another.receive(false, take);
  CHECK(last_answer().find("somebody else has the controls: somebody") != std::string::npos);
  CHECK(first.call("/release_controls")["success"] == true);
  another.receive(false, take);
  CHECK(last_answer().find("true") != std::string::npos);
}

TEST_CASE("a view that does not operate shows, and refuses everything else") {
  FakePort port;
  Talk talk(port, {.operates = false});
  for (const Service& service : services()) {
    const std::string name(service.name);
    const bool asks = name == "/robot" || name == "/describe_parameters" || name == "/situation" ||
                      name == "/statistics" || name == "/release_controls";
    std::string json = "{}";
    if (name == "/go") json = R"({"positions":{}})";
    if (name == "/play_trajectory") json = R"({"joint_names":[],"points":[]})";
    if (name == "/play_signals") json = R"({"signals":[],"duration":1})";
    if (name == "/set_parameters") json = R"({"values":{}})";
    if (name == "/pause") json = R"({"paused":true})";
    if (name == "/set_speed") json = R"({"factor":1})";
    if (name == "/pull") json = R"({"link":"base","point":[0,0,0],"force":[0,0,0]})";
    const Json answer = talk.call(name, json);
    INFO(name << ' ' << answer);
    CHECK(answer["success"] == asks);
    if (!asks) CHECK(answer["message"].get<std::string>().starts_with("this view only shows"));
  }
  talk.text(R"({"op":"setParameters","parameters":[{"name":"pid.elbow.p","value":1}],"id":"a"})");
  talk.text(R"({"op":"advertise","channels":[{"id":1,"topic":"/reference","encoding":"json"}]})");
  talk.client.receive(false, "\x01" + number(1) + R"({"name":["elbow"],"position":[1]})");
  CHECK(port.requests().empty());
  CHECK(port.parameters()[1].value == 20);
}

TEST_CASE("parameters are got, set, refused and watched") {
  FakePort port;
  Talk talk(port), watcher(port);
  watcher.text(R"({"op":"subscribeParameterUpdates","parameterNames":["pid.elbow.p"]})");
  watcher.tick();
  (void)watcher.sent();
  (void)talk.sent();
  talk.text(R"({"op":"getParameters","parameterNames":[]})");
  CHECK(talk.texts().at(0)["parameters"].size() == 4);
  talk.text(R"({"op":"setParameters","parameters":[{"name":"pid.elbow.p","value":33}],"id":"a"})");
  const auto done = talk.texts();
  REQUIRE(done.size() == 1);
  CHECK(done[0]["id"] == "a");
  CHECK(done[0]["parameters"][0]["value"] == 33.0);

  talk.text(R"({"op":"setParameters","parameters":[{"name":"pid.elbow.p","value":-1}],"id":"b"})");
  const auto refused = talk.texts();
  REQUIRE(refused.size() == 2);
  CHECK(refused[0]["level"] == 2);
  CHECK(refused[0]["message"] == "pid.elbow.p is out of its range");
  CHECK(refused[1]["parameters"][0]["value"] == 33.0);

  talk.text(R"({"op":"setParameters","parameters":[{"name":"pid.elbow.p","value":"x"}],"id":"c"})");
  const auto malformed = talk.texts();
  REQUIRE(malformed.size() == 2);
  CHECK(malformed[0]["level"] == 2);
  CHECK(malformed[1]["id"] == "c");
  CHECK(malformed[1]["parameters"].size() == 4);

  for (int i = 0; i < 40; ++i) watcher.tick();  // beyond the half second of its look
  const auto told = watcher.texts();
  REQUIRE(told.size() == 1);
  CHECK(told[0]["parameters"] ==
        Json::array({{{"name", "pid.elbow.p"}, {"value", 33.0}, {"type", "float64"}}}));
}

TEST_CASE("published references move the joints, and wrong ones are complained about") {
  FakePort port;
  Talk talk(port);
  talk.text(R"({"op":"advertise","channels":[{"id":8,"topic":"/reference","encoding":"json"}]})");
  (void)talk.sent();
  talk.client.receive(false, "\x01" + number(8) + R"({"name":["elbow"],"position":[-0.5]})");
  CHECK(port.reference()[1] == -0.5);
  CHECK(talk.texts().empty());
  talk.client.receive(false, "\x01" + number(8) + R"({"name":["knee"],"position":[1]})");
  CHECK(talk.texts().at(0)["message"] == "there is no joint 'knee'");
}

TEST_CASE("complaints are bounded in number") {
  FakePort port;
  Talk talk(port);
  talk.tick();
  (void)talk.sent();
  for (int i = 0; i < 1000; ++i) talk.text("{");
  CHECK(talk.texts().size() == Client::complaints_a_second);
}

TEST_CASE("requests that wait for their answer are bounded in number") {
  FakePort port;
  port.answer_requests(false);
  Talk talk(port);
  (void)talk.sent();
  for (std::size_t i = 0; i < Client::pending_limit; ++i) talk.send_call("/stop", "{}");
  CHECK(talk.sent().empty());
  CHECK(talk.call("/stop")["message"] ==
        "too many requests of this client wait for their answer; wait for it");
}

TEST_CASE("of streams the newest are kept, and the client is told that some were dropped") {
  FakePort port;
  Talk talk(port);
  talk.subscribe(Topic::joint_states);
  const auto message = [](int i) { return std::make_shared<const std::string>(std::to_string(i)); };
  (void)talk.sent();
  const int count = static_cast<int>(SendQueue::stream_limit) + 10;
  for (int i = 0; i < count; ++i) talk.client.stream(Topic::joint_states, message(i));
  talk.client.stream(Topic::cycles, message(0));  // not subscribed
  talk.tick();
  const auto frames = talk.sent();
  REQUIRE(frames.size() >= SendQueue::stream_limit + 1);
  const Json status = Json::parse(frames.front().head);
  CHECK(status["op"] == "status");
  CHECK(status["level"] == 1);
  CHECK(*frames[1].body != "0");
  CHECK_FALSE(talk.client.overflowed());
}

TEST_CASE("of streams no more bytes are kept than the queue's limit") {
  SendQueue queue(1000);
  for (int i = 0; i < 30; ++i) queue.add_stream({false, std::string(100, 'x'), nullptr});
  std::size_t bytes = 0;
  while (const auto frame = queue.take()) bytes += frame->size();
  CHECK(bytes == 1000);
  CHECK(queue.take_dropped() == 20);
  CHECK_FALSE(queue.overflowed());
}

TEST_CASE("a client that takes none of its answers overflows, and no answer is left out") {
  FakePort port;
  Talk talk(port, {.operates = true, .queue_limit = 4096});
  for (int i = 0; i < 100 && !talk.client.overflowed(); ++i) talk.send_call("/robot", "{}");
  CHECK(talk.client.overflowed());
  std::size_t bytes = 0;
  for (const Frame& frame : talk.sent()) bytes += frame.size();
  CHECK(bytes < 4096 + 2 * 16384);  // the greeting may be longer than the limit

  SendQueue queue(1 << 20);
  for (std::size_t i = 0; i <= SendQueue::answer_limit; ++i) queue.add_answer({true, "x", nullptr});
  CHECK(queue.overflowed());
}

TEST_CASE("assets are files of the mesh folders, read one by one") {
  const support::ScratchFolder scratch("view-assets");
  scratch.write("meshes/a.stl", "solid");
  scratch.write("secret", "secret");
  FakePort port;
  Talk talk(port, {.mesh_folders = {{"arm", (scratch.path() / "meshes").string()}}});
  (void)talk.sent();
  const auto fetch = [&](const std::string& uri) {
    talk.text(R"({"op":"fetchAsset","requestId":3,"uri":")" + uri + "\"}");
    const auto frames = talk.sent();
    REQUIRE(frames.size() == 1);
    return frames.front();
  };
  CHECK(*fetch("package://arm/a.stl").body == "solid");
  for (const char* uri : {"package://arm/../secret", "package://leg/a.stl", "file:///etc/passwd",
                          "/etc/passwd", "package://arm", "http://localhost/a"}) {
    INFO(uri);
    const Frame frame = fetch(uri);
    CHECK(frame.body == nullptr);
    CHECK(frame.head[5] == 1);
  }
  // Of a thousand files that are asked for at once, none is in memory before it is sent.
  for (int i = 0; i < 2000; ++i) {
    talk.text(R"({"op":"fetchAsset","requestId":3,"uri":"package://arm/a.stl"})");
  }
  CHECK_FALSE(talk.client.overflowed());
  CHECK(talk.sent().size() == 2000);
}

// SPDX-License-Identifier: Apache-2.0
#include "articula/ros2/type_hash.hpp"

#include "all_messages.hpp"
#include "catch.hpp"

#include <nlohmann/json.hpp>

#include <fstream>
#include <map>
#include <string>

namespace {

using namespace articula::ros2;

static_assert(type_hash<sensor_msgs::msg::JointState<Jazzy>>.view() ==
              "RIHS01_a13ee3a330e346c9d87b5aa18d24e11690752bd33a0350f11c5882bc9179260e");
static_assert(type_hash<control_msgs::msg::PidState<Rolling>>.view() ==
              "RIHS01_02d464a78563dce5014a2b8f9e3d3bd5344f537891c4b9f089d71feadd7f6e4b");

using Hashes = std::map<std::string, std::string>;

Hashes published(const std::string& distribution) {
  std::ifstream file(ARTICULA_ROS2_FRAMES "/type_hashes_" + distribution + ".json");
  REQUIRE(file);
  return nlohmann::json::parse(file).get<Hashes>();
}

/// The hashes of all types: messages, services, actions, and what these consist of.
template <class Layout>
Hashes computed() {
  Hashes hashes;
  const auto add = [&]<class M> {
    hashes[std::string(M::ros_type.view())] = compute_type_hash<M>().view();
  };
  const auto add_service = [&]<class Service> {
    add.template operator()<typename Service::Request>();
    add.template operator()<typename Service::Response>();
    add.template operator()<ServiceEvent<Service>>();
    add.template operator()<ServiceType<Service>>();
  };
  test::for_each_message<Layout>(add);
  test::for_each_service<Layout>(add_service);
  test::for_each_action<Layout>([&]<class Action> {
    add.template operator()<typename Action::Goal>();
    add.template operator()<typename Action::Result>();
    add.template operator()<typename Action::Feedback>();
    add_service.template operator()<SendGoal<Action>>();
    add_service.template operator()<GetResult<Action>>();
    add.template operator()<FeedbackMessage<Action>>();
    add.template operator()<ActionType<Action>>();
  });
  return hashes;
}

std::string hash(std::string_view text) {
  Sha256 hash;
  hash.add(text);
  std::string digits;
  for (const unsigned byte : hash.finish()) {
    digits += "0123456789abcdef"[byte >> 4];
    digits += "0123456789abcdef"[byte & 15];
  }
  return digits;
}

TEST_CASE("SHA-256 of texts around the size of a block is that of other programs") {
  CHECK(hash("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  CHECK(hash("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK(hash(std::string(55, 'a')) ==
        "9f4390f8d30c2dd92ec9f095b65e2b9ae9b0a925a5258e241c9f1e910f734318");
  CHECK(hash(std::string(56, 'a')) ==
        "b35439a4ac6f0948b6d6f9e3c6af0f5f590ce20f1bde7090ef7970686ec6738a");
  CHECK(hash(std::string(64, 'a')) ==
        "ffe054fe7ae0cb6dc65c3af9b61d5209f439851db43d0ba5997337df154668eb");
}

TEST_CASE("the hashes of all types of Jazzy are the published ones") {
  const Hashes ours = computed<Jazzy>();
  for (const auto& [name, hash] : published("jazzy")) {
    INFO(name);
    REQUIRE(ours.count(name) == 1);
    CHECK(ours.at(name) == hash);
  }
}

TEST_CASE("the hashes that differ in Rolling are the published ones") {
  const Hashes ours = computed<Rolling>();
  Hashes expected = published("jazzy");
  for (const auto& [name, hash] : published("rolling")) expected[name] = hash;
  for (const auto& [name, hash] : expected) {
    INFO(name);
    REQUIRE(ours.count(name) == 1);
    CHECK(ours.at(name) == hash);
  }
}

TEST_CASE("memory that is not on the heap changes no hash") {
  using Inline = InlineLayout<Jazzy, 7>;
  CHECK(type_hash<control_msgs::msg::JointTrajectoryControllerState<Inline>>.view() ==
        type_hash<control_msgs::msg::JointTrajectoryControllerState<Jazzy>>.view());
}

}  // namespace

// SPDX-License-Identifier: Apache-2.0
// The numbers of a loop by name, as ros2_control's introspection and statistics.
#include "articula/ros2/messages/monitoring/pal_statistics_msgs.hpp"
#include "articula/ros2/messages/sensor_msgs.hpp"

#include "bridged_arm.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

using namespace articula::ros2;
using support::BridgedArm;
namespace msg = pal_statistics_msgs::msg;

namespace {

const std::string data = "/controller_manager/introspection_data/",
                  statistics = "/controller_manager/statistics/";

/// The value of a name.
double value_of(const msg::Statistics<Jazzy>& all, const std::string& name) {
  const auto found = std::ranges::find(all.statistics, name, &msg::Statistic<Jazzy>::name);
  INFO(name);
  REQUIRE(found != all.statistics.end());
  return found->value;
}

}  // namespace

TEST_CASE("interfaces are told by name: measured states and commands of the last cycle") {
  BridgedArm arm;
  REQUIRE(arm.ask(articula::remote::Activate{}).verdict == articula::remote::Verdict::done);
  arm.run(50);
  const auto full = arm.transport.last<msg::Statistics<Jazzy>>(data + "full");
  const auto states = arm.transport.last<sensor_msgs::msg::JointState<Jazzy>>("/joint_states");
  REQUIRE((full && states));
  CHECK(full->header.stamp.sec == states->header.stamp.sec);
  CHECK(full->header.stamp.nanosec == states->header.stamp.nanosec);
  CHECK(full->statistics.size() == 8);
  for (std::size_t j = 0; j < 2; ++j) {
    const std::string state = "state_interface." + states->name[j] + "/";
    CHECK(value_of(*full, state + "position") == states->position[j]);
    CHECK(value_of(*full, state + "velocity") == states->velocity[j]);
    CHECK(value_of(*full, state + "effort") == states->effort[j]);
    // A simulator measures the effort that was commanded a cycle before: no limit, no motion.
    CHECK(std::abs(value_of(*full, "command_interface." + states->name[j] + "/effort") -
                   states->effort[j]) < 1e-6);
  }
  const auto names = arm.transport.last<msg::StatisticsNames<Jazzy>>(data + "names");
  const auto values = arm.transport.last<msg::StatisticsValues<Jazzy>>(data + "values");
  REQUIRE((names && values));
  CHECK(names->header.stamp.sec > 0);
  CHECK(names->names_version == values->names_version);
  REQUIRE(names->names.size() == values->values.size());
  for (std::size_t k = 0; k < names->names.size(); ++k) {
    CHECK(value_of(*full, names->names[k]) == values->values[k]);
  }
}

TEST_CASE("statistics count the cycles, and only for those who read them") {
  BridgedArm arm;
  auto& topic = arm.transport.topics.at(statistics + "full");
  topic.clients = 0;
  const std::size_t before = topic.count;
  arm.run(50);
  CHECK(topic.count == before);
  CHECK(arm.transport.topics.at(statistics + "names").count == 1);
  topic.clients = 1;
  arm.run(50);
  CHECK(topic.count > before);
  const auto full = arm.transport.last<msg::Statistics<Jazzy>>(statistics + "full");
  REQUIRE(full);
  const std::string stats = "controller_manager.stats/";
  CHECK(value_of(*full, stats + "cycles") > 50);
  CHECK(value_of(*full, stats + "overruns") == 0);
  CHECK(value_of(*full, stats + "execution_time/max") >=
        value_of(*full, stats + "execution_time/median"));
}

TEST_CASE("Humble has no such topics") {
  BridgedArm humble({.distribution = Distribution::humble});
  CHECK_FALSE(humble.transport.topics.contains(data + "full"));
  CHECK_FALSE(humble.transport.topics.contains(statistics + "names"));
}

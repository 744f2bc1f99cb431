// SPDX-License-Identifier: Apache-2.0
// The table of ready robots in docs/notation.md lists their joints in the library's order, and
// their links.

#include "articula/articula.hpp"
#include "articula/robots/gripper_arm.hpp"
#include "articula/robots/panda.hpp"
#include "articula/robots/pr2.hpp"
#include "articula/robots/q2d.hpp"
#include "articula/robots/two_arm_torso.hpp"
#include "articula/robots/ur10.hpp"
#include "catch.hpp"

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

using namespace articula;

namespace {

/// The parts of a text between separators, without spaces around them.
std::vector<std::string> parts_of(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) {
    const auto first = part.find_first_not_of(" .");
    if (first == std::string::npos) continue;
    parts.push_back(part.substr(first, part.find_last_not_of(" .") + 1 - first));
  }
  return parts;
}

/// The columns of a robot's row: type and header, joints, links.
std::vector<std::string> row_of(const std::string& type) {
  std::ifstream file(NOTATION);
  REQUIRE(file);
  for (std::string line; std::getline(file, line);) {
    if (line.find("| `" + type + "`,") == 0) return parts_of(line, '|');
  }
  FAIL("no row of " << type);
  return {};
}

template <class R>
void check(const std::string& type, const R& robot) {
  CAPTURE(type);
  const std::vector<std::string> row = row_of(type);
  REQUIRE(row.size() == 3);
  std::vector<std::string> names;
  for (const std::string_view name : joint_names(robot)) names.emplace_back(name);
  CHECK(parts_of(row[1], ',') == names);
  for (const std::string& link : parts_of(row[2], ',')) CHECK_NOTHROW(link_index(robot, link));
}

}  // namespace

TEST_CASE("the documents list the joints of the ready robots in their order") {
  check("Q2d", Q2d());
  check("Ur10", Ur10());
  check("Panda", Panda());
  check("GripperArm", GripperArm());
  check("TwoArmTorso", TwoArmTorso());
  check("Pr2", Pr2());
}

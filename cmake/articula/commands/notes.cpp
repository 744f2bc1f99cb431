// SPDX-License-Identifier: Apache-2.0
#include "commands/notes.hpp"

#include <cstdio>

namespace terminal {

void print_notes(const ControllersPlan& controllers, const std::vector<PlannedGroup>& groups,
                 const articula::UrdfDescription& robot, const std::string& file) {
  for (const std::string& note : controllers.notes) {
    std::fprintf(stderr, "note: %s\n", note.c_str());
  }
  for (const PlannedGroup& group : groups) {
    if (!group.controllers.empty()) continue;
    for (const std::string& joint : group.joints) {
      std::fprintf(stderr, "note: %s: no controller has joint '%s', which is held at rest\n",
                   controllers.source.name().c_str(), joint.c_str());
    }
  }
  for (const std::string& notice : robot->notices) {
    std::fprintf(stderr, "note: %s: %s\n", file.c_str(), notice.c_str());
  }
}

}  // namespace terminal

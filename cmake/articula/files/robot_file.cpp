// SPDX-License-Identifier: Apache-2.0
#include "files/robot_file.hpp"

#include "program.hpp"
#include "project/process.hpp"

#include <filesystem>
#include <string_view>

namespace terminal {

articula::UrdfSource robot_source(const std::string& file) {
  if (!file.ends_with(".xacro")) return {std::filesystem::path(file)};
  const ProcessEnd xacro = run_process({"xacro", file});
  if (!xacro.is_found) {
    throw Refusal(file +
                  ": the program xacro is not installed; install it (Debian and ROS: xacro), or "
                  "expand the file elsewhere and give the URDF");
  }
  if (!xacro.is_done) throw Refusal(file + ": xacro cannot expand it, see above");
  return {std::string_view(xacro.output)};
}

}  // namespace terminal

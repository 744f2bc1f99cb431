// SPDX-License-Identifier: Apache-2.0
/// @file Loops of the program in ROS 2.
#pragma once

#include "files/controllers_file.hpp"
#include "program.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace articula::remote {
class Port;
}  // namespace articula::remote

namespace terminal {

/// Whether and where a loop is found in ROS 2.
struct Ros2Options {
  bool is_wanted = false;
  unsigned domain = 0;
  std::string distribution = "jazzy";
  std::string name_space{};
  std::string frame_prefix{};                        ///< before the names of frames, as left/
  std::vector<std::string> interfaces{"127.0.0.1"};  ///< IPv4 addresses of this host
  bool use_sim_time = false;                         ///< stamps have the loop's time
  bool operates = true;                              ///< ROS may move the robot
};

/// Adds --ros2 and what belongs to it.
void add_ros2_options(CLI::App& command, Ros2Options& options);

/// What makes something that offers a loop, until that is destroyed. Empty: nothing.
using Attach = std::function<std::shared_ptr<void>(articula::remote::Port&)>;

/// Offers a loop as a controller_manager with its controllers, if it is wanted.
/// @param plan  types, joints and quantities of the controllers
/// @throws Refusal if the program was built without ROS 2, or an option makes no sense
[[nodiscard]] Attach ros2_bridge(const Ros2Options& options, const ControllersPlan& plan);

/// Offers a loop as a robot behind topics, which controllers in ROS 2 command, if it is wanted.
/// @throws Refusal if the program was built without ROS 2, or an option makes no sense
[[nodiscard]] Attach ros2_robot(const Ros2Options& options);

}  // namespace terminal

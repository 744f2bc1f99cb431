// SPDX-License-Identifier: Apache-2.0
/// @file What a loop from files is made of.
#pragma once

#include "files/controllers_file.hpp"
#include "files/joint_groups.hpp"
#include "program.hpp"

#include <articula/urdf/description.hpp>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace articula::remote {
class Port;
}  // namespace articula::remote

namespace terminal {

/// What a loop from files is made of.
struct LoopPlan {
  articula::UrdfDescription robot;
  std::string urdf_text{};  ///< for viewers; empty: made from the model
  ControllersPlan controllers{};
  std::vector<PlannedGroup> groups{};  ///< of the robot's joints, at most 4
  bool is_mock = false;
  std::string address{};  ///< to be reached at
  std::uint16_t port = 0;
  std::string token{};
  std::string page_folder{};                          ///< of the view; empty: that of the build
  std::map<std::string, std::string> mesh_folders{};  ///< by package
  bool is_read_only = false;
  int priority = 0;    ///< of the loop's thread; 0: as any other
  double seconds = 0;  ///< of the run [s]; infinite: until Ctrl-C
  /// Makes what else offers the loop, such as a bridge to ROS 2, until the run ends. Empty:
  /// nothing.
  std::function<std::shared_ptr<void>(articula::remote::Port&)> attach{};
  /// Called when the loop can be reached, with the address of its page.
  std::function<void(const std::string& url)> ready{};
};

/// How a run has ended.
struct LoopEnd {
  std::uint64_t cycles = 0;
  std::uint64_t overruns = 0;
  std::string status{};  ///< of the last cycle
};

/// Runs a loop for a robot with N joints that take commands, and its moving bodies, in this thread.
/// @throws Refusal, articula::FileError, std::invalid_argument, std::system_error
template <int N, int Bodies>
LoopEnd run_loop(const LoopPlan& plan);

}  // namespace terminal

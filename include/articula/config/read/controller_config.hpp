// SPDX-License-Identifier: Apache-2.0
/// @file A controller's parameters from a configuration file, independent of the robot.
#pragma once

#include "articula/control/laws/pid_gains.hpp"
#include "articula/model/vector3.hpp"
#include "articula/reference/trajectory/trajectory.hpp"
#include "articula/text/file_error.hpp"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace articula {

/// A joint in a controller's parameters.
struct ConfiguredJoint {
  std::string name{};
  std::optional<PidGains> gains{};
  double path_tolerance = 0;  ///< constraints.<joint>.trajectory [rad or m]; 0: not checked
  double goal_tolerance = 0;  ///< constraints.<joint>.goal [rad or m]; 0: not checked
  /// angle_wraparound: the controller takes the position error modulo one turn
  std::optional<bool> angle_wraparound{};
  bool keeps_integral = false;  ///< save_i_term, for ControlToolboxPidLaw
  FilePlace place{};
  FilePlace angle_wraparound_place{};
};

/// When a gripper has reached a goal or is stalled. They are for ros2::GripperOptions.
struct ConfiguredGripper {
  double goal_tolerance = 0.01;             ///< distance from the goal [rad or m]
  bool allow_stalling = false;              ///< a stalled gripper has succeeded
  double stall_velocity_threshold = 0.001;  ///< the joint moves above it [rad/s or m/s]
  double stall_timeout = 1;                 ///< time without motion after which it is stalled [s]
};

/// The note on a parameter of ConfiguredGripper.
inline constexpr std::string_view gripper_note = "not used: it is for a gripper's action in ROS 2";

/// A controller's parameters. Those that the file lacks have their defaults.
struct ControllerConfig {
  std::string name{};                        ///< empty if the file has nothing but its parameters
  std::string type{};                        ///< the plugin's name; may be empty
  std::vector<ConfiguredJoint> joints{};     ///< in the order of the file
  std::optional<Vector3<double>> gravity{};  ///< acceleration of free fall in the frame of
                                             ///< chain_root (empty: of the base) [m/s^2], 3 x 1
  std::string chain_root{};                  ///< first link of the chain of the joints
  std::string chain_tip{};                   ///< its last link
  std::optional<int> priority{};             ///< of the control thread, for ThreadOptions

  double stopped_velocity_tolerance = 0.01;  ///< at the end of a trajectory [rad/s or m/s]
  double goal_time = 0;            ///< time allowed to arrive after its end [s]; 0: no limit
  TrajectoryOptions trajectory{};  ///< interpolation between points
  ConfiguredGripper gripper{};
  std::string gain_prefix{};          ///< "gains." if the file has gains below that key
  bool allow_partial_joints = false;  ///< for ArrangeOptions
  bool allow_integration = false;     ///< for ArrangeOptions

  /// Parameters without effect in this library, one line each with file, line and key.
  std::vector<std::string> notes{};

  FilePlace place{};                          ///< of the parameters
  std::map<std::string, FilePlace> places{};  ///< of gravity, root, tip and priority, by that name
};

}  // namespace articula

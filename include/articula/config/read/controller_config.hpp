// SPDX-License-Identifier: Apache-2.0
/// @file What a configuration file says about a controller, whichever robot it is for.
#pragma once

#include "articula/control/laws/pid_gains.hpp"
#include "articula/model/vector3.hpp"
#include "articula/reference/trajectory/trajectory.hpp"
#include "articula/text/file_error.hpp"

#include <optional>
#include <string>
#include <vector>

namespace articula {

/// A joint in a controller's parameters.
struct ConfiguredJoint {
  std::string name{};
  std::optional<PidGains> gains{};
  double path_tolerance = 0;  ///< constraints.<joint>.trajectory [rad or m]; 0: not checked
  double goal_tolerance = 0;  ///< constraints.<joint>.goal [rad or m]; 0: not checked
  /// angle_wraparound: the error is that of the short way round
  std::optional<bool> short_way{};
  bool keeps_integral = false;  ///< save_i_term, for ControlToolboxPidLaw
  FilePlace place{};
  FilePlace short_way_place{};
};

/// A controller's parameters as a file has them. What is not in the file keeps its default.
struct ControllerConfig {
  std::string name{};                        ///< empty where the file is nothing but parameters
  std::string type{};                        ///< the plugin's name; may be empty
  std::vector<ConfiguredJoint> joints{};     ///< in the order of the file
  std::optional<Vector3<double>> gravity{};  ///< acceleration of free fall in the frame of
                                             ///< chain_root (empty: of the base) [m/s^2], 3 x 1
  std::string chain_root{};                  ///< link at which the chain of the joints begins
  std::string chain_tip{};                   ///< link at which it ends
  std::optional<int> priority{};             ///< of the control thread, for ThreadOptions

  double stopped_velocity_tolerance = 0.01;  ///< at the end of a trajectory [rad/s or m/s]
  double goal_time = 0;                      ///< to arrive after its end [s]; 0: no matter when
  TrajectoryOptions trajectory{};            ///< what lies between points
  bool allow_partial_joints = false;         ///< for ArrangeOptions
  bool allow_integration = false;            ///< for ArrangeOptions

  /// What the file says and nothing here does, one line each with file, line and key.
  std::vector<std::string> notes{};

  FilePlace place{};  ///< where the parameters stand
  FilePlace gravity_place{};
  FilePlace chain_root_place{};
  FilePlace chain_tip_place{};
  FilePlace priority_place{};
};

}  // namespace articula

// SPDX-License-Identifier: Apache-2.0
/// @file The action by which ROS moves the joints of a controller.
#pragma once

namespace articula::ros2 {

/// The action of a controller: follow_joint_trajectory, or gripper_cmd of a gripper's.
class ControllerAction {
 public:
  virtual ~ControllerAction() = default;
  /// Accepts goals that have begun, publishes feedback, ends goals. Real-time: no (allocates).
  virtual void update() = 0;
};

}  // namespace articula::ros2

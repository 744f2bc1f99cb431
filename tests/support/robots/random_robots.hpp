// SPDX-License-Identifier: Apache-2.0
/// @file Random robots: trees or chains of all types of joints.
#pragma once

#include "random.hpp"
#include "robots/blueprint.hpp"

#include <algorithm>
#include <string>

namespace support {

enum class Shape {
  chain,  ///< every link carries one other
  tree,   ///< links branch
};

/// A link of some kilograms and a size of some decimetres. Its principal second moments of mass are
/// positive, so its inertia is that of a body that can exist.
[[nodiscard]] inline articula::Link random_link(Random& random, const articula::Name& name) {
  const double mass = random.number(0.2, 4);
  const double x = mass * random.number(1e-4, 0.1), y = mass * random.number(1e-4, 0.1),
               z = mass * random.number(1e-4, 0.1);
  return {.name = name,
          .mass = mass,
          .center_of_mass = random.vector3(0.3),
          .inertia = {.xx = y + z, .yy = x + z, .zz = x + y},
          .inertia_orientation = random.vector3(3)};
}

/// A joint with a place and, if it moves, an axis of a length other than 1; one in three stands
/// straight, at right angles and along a coordinate axis, as most do on robots that people build.
[[nodiscard]] inline articula::Joint random_joint(Random& random, articula::JointType type) {
  articula::Joint joint{.type = type, .origin = random.vector3(0.5)};
  if (random.one_in(3)) {
    const double right_angle = 1.5707963267948966;
    joint.orientation = {right_angle * random.integer(-2, 2), right_angle * random.integer(-2, 2),
                         right_angle * random.integer(-2, 2)};
    const double length = random.one_in(2) ? 1 : -0.5;
    const int along = random.integer(0, 2);
    joint.axis = {along == 0 ? length : 0, along == 1 ? length : 0, along == 2 ? length : 0};
  } else {
    joint.orientation = random.vector3(3);
    joint.axis = random.vector3(2);
  }
  return joint;
}

/// Makes some of a robot's moving joints mimic others.
inline void add_mimics(Random& random, Blueprint& robot, int mimics) {
  std::vector<articula::Joint*> moving;
  for (articula::Joint& joint : robot.joints) {
    if (joint.type != articula::JointType::fixed) moving.push_back(&joint);
  }
  std::shuffle(moving.begin(), moving.end(), random.engine());
  const int free = static_cast<int>(moving.size()) - mimics;
  for (int k = free; k < static_cast<int>(moving.size()); ++k) {
    const auto followed = static_cast<std::size_t>(random.integer(0, free - 1));
    moving[static_cast<std::size_t>(k)]->mimic = {.joint = moving[followed]->name,
                                                  .multiplier = random.number(-2, 2),
                                                  .offset = random.number(-1, 1)};
  }
}

/// A robot with as many moving joints as asked for, and fixed ones, massless frames, a gravity in
/// any direction. Links and joints are in no order; nor are the joints' names in that of the tree.
/// @param moving_joints  those that mimic others included
/// @param mimics         how many of them mimic others
[[nodiscard]] inline Blueprint random_robot(Random& random, int moving_joints,
                                            Shape shape = Shape::tree, int mimics = 0) {
  using articula::JointType;
  Blueprint robot{.gravity = random.vector3(9.81)};
  std::vector<int> numbers(static_cast<std::size_t>(4 * moving_joints + 4));
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<int>(i);
  std::shuffle(numbers.begin(), numbers.end(), random.engine());

  robot.links.push_back(random_link(random, "root"));
  const auto attach = [&](JointType type, bool massless) {
    const std::size_t last = robot.links.size() - 1;
    const std::size_t parent =
        shape == Shape::chain ? last
                              : static_cast<std::size_t>(random.integer(0, static_cast<int>(last)));
    const articula::Name child("link_" + std::to_string(last));
    articula::Joint joint = random_joint(random, type);
    joint.name = articula::Name("joint_" + std::to_string(numbers[robot.joints.size()]));
    joint.parent = robot.links[parent].name;
    joint.child = child;
    robot.joints.push_back(joint);
    robot.links.push_back(massless ? articula::Link{.name = child} : random_link(random, child));
  };
  for (int moving = 0; moving < moving_joints; ++moving) {
    if (random.one_in(4)) attach(JointType::fixed, random.one_in(2));
    constexpr JointType types[] = {JointType::revolute, JointType::continuous,
                                   JointType::prismatic};
    attach(types[random.integer(0, 2)], false);
    if (random.one_in(3)) {  // the last link's mass is a fixed joint further out
      articula::Link& hollow = robot.links.back();
      const articula::Link solid = hollow;
      hollow = {.name = solid.name};
      attach(JointType::fixed, false);
      robot.joints.back().parent = solid.name;
    }
  }
  attach(JointType::fixed, true);
  std::shuffle(robot.links.begin(), robot.links.end(), random.engine());
  std::shuffle(robot.joints.begin(), robot.joints.end(), random.engine());
  add_mimics(random, robot, mimics);
  return robot;
}

}  // namespace support

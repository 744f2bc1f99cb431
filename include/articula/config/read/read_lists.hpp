// SPDX-License-Identifier: Apache-2.0
/// @file Lists of joints and of coordinates in a configuration file.
#pragma once

#include "articula/config/read/controller_config.hpp"
#include "articula/config/yaml/reader.hpp"
#include "articula/model/vector3.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace articula::detail {

/// Names of joints, none of them twice.
[[nodiscard]] inline std::vector<ConfiguredJoint> read_joint_list(const ConfigValue& value) {
  constexpr std::size_t most = 1000;
  std::vector<ConfiguredJoint> joints;
  if (value.list().size() > most) value.refuse("at most 1000 names");
  for (const ConfigValue& item : value.list()) {
    const std::string name = item.name();
    for (const ConfiguredJoint& joint : joints) {
      if (joint.name == name)
        item.refuse("'" + shown(name) + "' a second time", "every joint once");
    }
    joints.push_back({.name = name, .place = item.place()});
  }
  if (joints.empty()) value.refuse("the names of joints");
  return joints;
}

[[nodiscard]] inline Vector3<double> read_vector(const ConfigValue& value,
                                                 std::vector<std::string>& notes) {
  if (value.node().is_list()) {
    const auto items = value.list();
    if (items.size() != 3)
      value.refuse("three numbers with decimal points, or a map of x, y and z");
    return {items[0].number(), items[1].number(), items[2].number()};
  }
  if (!value.node().is_map()) value.refuse("a map of x, y and z, or three numbers");
  ConfigMap map(value, notes);
  const auto part = [&](std::string_view key) {
    const auto found = map.find(key);
    return found ? found->number() : 0;
  };
  static_cast<void>(map.expect("z"));
  const double x = part("x"), y = part("y"), z = part("z");
  map.finish();
  return {x, y, z};
}

}  // namespace articula::detail

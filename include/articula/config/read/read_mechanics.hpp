// SPDX-License-Identifier: Apache-2.0
/// @file Lists of joint names and of numbers, and the mechanics, in a controller's parameters.
#pragma once

#include "articula/config/read/controller_config.hpp"
#include "articula/config/yaml/config_map.hpp"
#include "articula/model/vector3.hpp"
#include "articula/text/characters.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace articula::detail {

/// The joint below the key `joint` or `joint_name`, or the joints of a list, each of them once.
[[nodiscard]] inline std::vector<ConfiguredJoint> read_joint_names(const ConfigNode& value) {
  constexpr std::size_t most = 1000;
  if (value.key == "joint" || value.key == "joint_name") {
    return {{.name = value.name(), .place = value.place}};
  }
  std::vector<ConfiguredJoint> joints;
  if (value.list().size() > most) value.refuse("at most 1000 names");
  for (const ConfigNode& item : value.list()) {
    const std::string& name = item.name();
    for (const ConfiguredJoint& joint : joints) {
      if (joint.name != name) continue;
      item.refuse("'" + shown(name) + "' a second time", "every joint once");
    }
    joints.push_back({.name = name, .place = item.place});
  }
  if (joints.empty()) value.refuse("the names of joints");
  return joints;
}

/// Three coordinates, as a list or as a map of x, y and z, in which x and y may be missing.
[[nodiscard]] inline Vector3<double> read_vector(const ConfigNode& value,
                                                 std::vector<std::string>& notes) {
  if (value.is_list()) {
    const auto& items = value.list();
    if (items.size() != 3)
      value.refuse("three numbers with decimal points, or a map of x, y and z");
    return {items[0].number(), items[1].number(), items[2].number()};
  }
  if (!value.is_map()) value.refuse("a map of x, y and z, or three numbers");
  ConfigMap map(value, notes);
  map.require("z");
  Vector3<double> vector;
  map.read_number("x", vector.x);
  map.read_number("y", vector.y);
  map.read_number("z", vector.z);
  map.finish();
  return vector;
}

/// Reads gravity, chain and priority.
/// @throws FileError if one of them has the wrong type or is out of range
inline void read_mechanics(ConfigMap& map, ControllerConfig& config) {
  const auto find = [&config](ConfigMap& where, const char* key) {
    const ConfigNode* value = where.find(key);
    if (value) config.places[key] = value->place;
    return value;
  };
  if (const auto value = find(map, "gravity")) config.gravity = read_vector(*value, config.notes);
  if (auto chain = map.find_map("chain")) {
    if (const auto root = find(*chain, "root")) config.chain_root = root->name();
    if (const auto tip = find(*chain, "tip")) config.chain_tip = tip->name();
    chain->finish();
  }
  if (const auto value = find(map, "priority")) config.priority = value->integer(0, 99);
}

/// A gain of each joint: n numbers >= 0, or a diagonal n x n matrix by rows.
[[nodiscard]] inline std::vector<double> read_diagonal(const ConfigNode& value, std::size_t n) {
  const auto& items = value.list();
  const std::size_t size = items.size();
  bool has_pairs = size == 4 && n == 2;  // as in [1,0, 0,5], which may have two decimal commas
  for (std::size_t k = 0; k < size; ++k) {
    const ConfigNode& node = items[k];
    has_pairs = has_pairs && node.text.find_first_not_of("+-0123456789") == std::string::npos;
    if (k == 0) continue;
    const ConfigNode& last = items[k - 1];
    const int length = static_cast<int>(last.text.size());
    const bool has_blank = node.place.column > last.place.column + length + 1;
    has_pairs = has_pairs && node.place.line == last.place.line && has_blank == (k == 2);
  }
  if ((size != n && size != n * n) || has_pairs) {
    value.refuse("a number for each of " + std::to_string(n) + (n == 1 ? " joint" : " joints") +
                 " with decimal points, or a matrix by rows with a blank behind every comma");
  }
  std::vector<double> numbers;
  for (std::size_t k = 0; k < size; ++k) {
    if (size == n || k % (n + 1) == 0) {
      numbers.push_back(items[k].not_negative());
    } else if (items[k].number() != 0) {
      items[k].refuse("0 off the diagonal, since every joint has a controller of its own");
    }
  }
  return numbers;
}

}  // namespace articula::detail

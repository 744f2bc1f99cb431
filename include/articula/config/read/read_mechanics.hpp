// SPDX-License-Identifier: Apache-2.0
/// @file What a controller's parameters say about the robot and the thread.
#pragma once

#include "articula/config/read/controller_config.hpp"
#include "articula/config/read/read_lists.hpp"
#include "articula/config/yaml/reader.hpp"

#include <string>
#include <string_view>

namespace articula::detail {

/// Reads gravity, chain and priority.
/// @throws FileError if one of them has the wrong type or is out of range
inline void read_mechanics(ConfigMap& map, ControllerConfig& config) {
  if (const auto value = map.find("gravity")) {
    config.gravity = read_vector(*value, config.notes);
    config.gravity_place = value->place();
  }
  if (auto chain = map.find_map("chain")) {
    const auto read = [&](std::string_view key, std::string& to, FilePlace& place) {
      const auto value = chain->find(key);
      if (value) to = value->name(), place = value->place();
    };
    read("root", config.chain_root, config.chain_root_place);
    read("tip", config.chain_tip, config.chain_tip_place);
    chain->finish();
  }
  if (const auto value = map.find("priority")) {
    config.priority = value->integer(0, 99);
    config.priority_place = value->place();
  }
}

}  // namespace articula::detail

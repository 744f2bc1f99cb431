// SPDX-License-Identifier: Apache-2.0
/// @file A controller's parameters about the robot's mechanics and the control thread.
#pragma once

#include "articula/config/read/controller_config.hpp"
#include "articula/config/read/read_lists.hpp"
#include "articula/config/yaml/config_map.hpp"

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
    const auto read = [&](std::string_view key, std::string& link, FilePlace& place) {
      const auto value = chain->find(key);
      if (value) link = value->name(), place = value->place();
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

// SPDX-License-Identifier: Apache-2.0
/// @file The interface of a node's parameters: reading and changing their values.
#pragma once

#include "articula/ros2/messages/rcl_interfaces.hpp"

#include <functional>
#include <string>
#include <vector>

namespace articula::ros2 {

/// A parameter of a node: value and description.
struct NodeParameter {
  rcl_interfaces::msg::ParameterValue<Jazzy> value{};
  rcl_interfaces::msg::ParameterDescriptor<Jazzy> descriptor{};
};

/// Values with their names.
using NamedValues = std::vector<rcl_interfaces::msg::Parameter<Jazzy>>;

/// The parameters of a node, which it has in any way it likes.
class ParameterStore {
 public:
  /// Called once with the reason of a refusal, or an empty text when the change is done.
  using OnSet = std::function<void(const std::string& reason)>;

  virtual ~ParameterStore() = default;
  /// All parameters.
  [[nodiscard]] virtual std::vector<NodeParameter> list() = 0;
  /// Changes values, all of them or none. They are of parameters that exist, of their types, and
  /// not read-only.
  virtual void set(const NamedValues& values, OnSet on_set) = 0;
};

}  // namespace articula::ros2

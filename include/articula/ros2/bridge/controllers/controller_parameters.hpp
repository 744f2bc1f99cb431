// SPDX-License-Identifier: Apache-2.0
/// @file The parameters of a bridge's nodes.
#pragma once

#include "articula/ros2/bridge/core/bridge_core.hpp"
#include "articula/ros2/node/parameter_server.hpp"

#include <string>
#include <utility>
#include <vector>

namespace articula::ros2 {

/// Parameters that say how a node was made, and nobody can change.
class FixedParameters final : public ParameterStore {
 public:
  explicit FixedParameters(std::vector<NodeParameter> all) : all_(std::move(all)) {}

  [[nodiscard]] std::vector<NodeParameter> list() override { return all_; }
  void set(const NamedValues&, OnSet on_set) override { on_set("the parameters are read-only"); }

 private:
  std::vector<NodeParameter> all_;
};

/// The parameters of a controller. Its gains are gains.<joint>.<gain> (see
/// BridgeOptions::gain_prefix); the loop checks and sets them between two cycles. Others are
/// constraints of trajectories that bring no tolerances. Its joints and interfaces are
/// parameters that nobody can set.
class ControllerParameters final : public ParameterStore {
 public:
  /// @param core        outlives this
  /// @param controller  likewise
  ControllerParameters(BridgeCore& core, BridgedController& controller);

  [[nodiscard]] std::vector<NodeParameter> list() override;
  void set(const NamedValues& values, OnSet on_set) override;

 private:
  BridgeCore& core_;
  /// A parameter, and the constraints that it sets.
  struct Constraint {
    std::string name;
    std::vector<double*> values;
    std::string description;

    /// The largest of them.
    [[nodiscard]] double value() const;
  };
  [[nodiscard]] std::vector<Constraint> constraints();

  BridgedController& controller_;
  std::vector<NodeParameter> fixed_{};
};

}  // namespace articula::ros2

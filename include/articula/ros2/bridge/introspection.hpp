// SPDX-License-Identifier: Apache-2.0
/// @file A loop's interfaces and statistics as topics of numbers by name.
#pragma once

#include "articula/ros2/bridge/core/bridge_core.hpp"
#include "articula/ros2/messages/monitoring/pal_statistics_msgs.hpp"
#include "articula/ros2/node/periodic.hpp"
#include "articula/ros2/node/publisher.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace articula::ros2 {

/// Numbers by name, as three topics: `names`, `values` in their order, and `full` with both. Names
/// are sent once, to late readers, too. Values are sent while somebody reads them.
class NumberTopics {
 public:
  /// @param name   of the topics, before "/names"
  /// @param names  of the numbers
  NumberTopics(BridgeCore& core, const std::string& name, std::vector<std::string> names);

  /// Names stay for late readers.
  void publish_names();
  /// Whether somebody reads numbers.
  [[nodiscard]] bool has_readers() const;
  /// @param values  as many as there are names
  void publish(std::vector<double> values);

 private:
  using Names = pal_statistics_msgs::msg::StatisticsNames<Jazzy>;
  using Values = pal_statistics_msgs::msg::StatisticsValues<Jazzy>;
  using Statistics = pal_statistics_msgs::msg::Statistics<Jazzy>;

  BridgeCore& core_;
  std::vector<std::string> names_;
  Publisher<Names> names_topic_;
  Publisher<Values> values_topic_;
  Publisher<Statistics> full_topic_;
};

/// The topics `introspection_data` and `statistics` of a controller_manager, from Jazzy on:
///
/// - `state_interface.<joint>/<quantity>` and `command_interface.<joint>/<quantity>` of the last
///   cycle, in SI units.
/// - `controller_manager.stats/...`: execution time and latency [us], rate of the cycles [Hz].
class Introspection {
 public:
  /// @param core  outlives this
  explicit Introspection(BridgeCore& core);

  /// Publishes the last cycle, at the rate of joint states. Real-time: no (allocates).
  void update();

 private:
  [[nodiscard]] std::vector<double> interfaces() const;
  [[nodiscard]] std::vector<double> statistics() const;

  BridgeCore& core_;
  NumberTopics interfaces_;
  NumberTopics statistics_;
  Periodic due_;
  bool has_named_ = false;
  std::optional<std::uint64_t> published_cycle_{};
};

}  // namespace articula::ros2

// SPDX-License-Identifier: Apache-2.0
/// @file Numbers by name, as ros2_control tells its interfaces and statistics.
#pragma once

#include "articula/ros2/fields.hpp"
#include "articula/ros2/messages/std_msgs.hpp"

#include <cstdint>

namespace articula::ros2::pal_statistics_msgs {

namespace msg {

/// A number and its name.
template <class Layout>
struct Statistic {
  Text<Layout> name{};
  double value = 0;

  static constexpr TypeName ros_type = "pal_statistics_msgs/msg/Statistic";
  static constexpr FieldNames<2> ros_fields{"name", "value"};
};

/// Numbers with their names.
template <class Layout>
struct Statistics {
  std_msgs::msg::Header<Layout> header{};
  Sequence<Layout, msg::Statistic<Layout>> statistics{};

  static constexpr TypeName ros_type = "pal_statistics_msgs/msg/Statistics";
  static constexpr FieldNames<2> ros_fields{"header", "statistics"};
};

/// The names of the numbers in StatisticsValues.
template <class Layout>
struct StatisticsNames {
  std_msgs::msg::Header<Layout> header{};
  Sequence<Layout, Text<Layout>> names{};
  std::uint32_t names_version = 0;  ///< another one for other names

  static constexpr TypeName ros_type = "pal_statistics_msgs/msg/StatisticsNames";
  static constexpr FieldNames<3> ros_fields{"header", "names", "names_version"};
};

/// Numbers in the order of the StatisticsNames with the same version.
template <class Layout>
struct StatisticsValues {
  std_msgs::msg::Header<Layout> header{};
  Sequence<Layout, double> values{};
  std::uint32_t names_version = 0;

  static constexpr TypeName ros_type = "pal_statistics_msgs/msg/StatisticsValues";
  static constexpr FieldNames<3> ros_fields{"header", "values", "names_version"};
};

}  // namespace msg

}  // namespace articula::ros2::pal_statistics_msgs

// SPDX-License-Identifier: Apache-2.0
/// @file The quality of service of each kind of topic of ROS 2.
#pragma once

#include <chrono>
#include <cstddef>

namespace articula::ros2 {

/// How a topic is transported. Writers here are reliable: lost samples are sent again.
struct QualityOfService {
  bool transient_local = false;  ///< late readers get the last samples of the writer
  std::size_t depth = 1;         ///< samples that are kept
  /// For readers: samples may be lost. Writers that offer no more match as well as reliable ones.
  bool best_effort = false;
  /// For writers: samples older than this are not sent to late readers. 0: they have no end.
  std::chrono::seconds lifespan{0};
};

namespace quality_of_service {

/// Requests and replies of services, also of those that make up actions.
inline constexpr QualityOfService service{.transient_local = false, .depth = 10};
/// Requests and replies of the services of parameters.
inline constexpr QualityOfService parameters{.transient_local = false, .depth = 1000};
inline constexpr QualityOfService action_feedback{.transient_local = false, .depth = 10};
inline constexpr QualityOfService action_status{.transient_local = true, .depth = 1};
/// Joint states, states of controllers and commands.
inline constexpr QualityOfService states{.transient_local = false, .depth = 1};
/// Readers of speed_scaling_input: its publisher's last factor counts.
inline constexpr QualityOfService speed_scaling{.transient_local = true, .depth = 10};
/// Readers of measurements, as rclcpp's SensorDataQoS.
inline constexpr QualityOfService sensor_data{
    .transient_local = false, .depth = 5, .best_effort = true};
inline constexpr QualityOfService robot_description{.transient_local = true, .depth = 1};
inline constexpr QualityOfService tf{.transient_local = false, .depth = 100};
/// Writers of static transforms. Readers keep 100 samples.
inline constexpr QualityOfService tf_static{.transient_local = true, .depth = 1};
inline constexpr QualityOfService activity{.transient_local = true, .depth = 1};
/// Of introspection_data and statistics. Their readers ask for samples of before.
inline constexpr QualityOfService numbers{.transient_local = true, .depth = 1};
inline constexpr QualityOfService log{
    .transient_local = true, .depth = 1000, .lifespan = std::chrono::seconds(10)};
inline constexpr QualityOfService parameter_events{.transient_local = false, .depth = 1000};
inline constexpr QualityOfService clock{.transient_local = false, .depth = 1};
inline constexpr QualityOfService discovery_info{.transient_local = true, .depth = 1};

}  // namespace quality_of_service

}  // namespace articula::ros2

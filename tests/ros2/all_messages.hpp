// SPDX-License-Identifier: Apache-2.0
/// @file All message structs of the room ros2.
#pragma once

#include "articula/ros2/messages/action_msgs.hpp"
#include "articula/ros2/messages/control_msgs.hpp"
#include "articula/ros2/messages/controller_manager_msgs.hpp"
#include "articula/ros2/messages/monitoring/diagnostic_msgs.hpp"
#include "articula/ros2/messages/rcl_interfaces.hpp"
#include "articula/ros2/messages/rmw_dds_common.hpp"
#include "articula/ros2/messages/service_msgs.hpp"
#include "articula/ros2/messages/std_srvs.hpp"
#include "articula/ros2/messages/tf2_msgs.hpp"
#include "articula/ros2/messages/type_description_interfaces.hpp"

namespace articula::ros2::test {

/// Calls visit.template operator()<M>() for the messages that the wire carries, of each kind.
template <class Layout, class Visit>
void for_each_message(const Visit& visit) {
  const auto all = [&]<class... M> { (visit.template operator()<M>(), ...); };
  namespace c = control_msgs::msg;
  namespace m = controller_manager_msgs::msg;
  namespace r = rcl_interfaces::msg;
  namespace t = trajectory_msgs::msg;
  using L = Layout;
  all.template
  operator()<action_msgs::msg::GoalInfo, action_msgs::msg::GoalStatus,
             action_msgs::msg::GoalStatusArray<L>, builtin_interfaces::msg::Duration,
             builtin_interfaces::msg::Time, c::DynamicInterfaceGroupValues<L>,
             c::DynamicInterfaceValues<L>, c::DynamicJointState<L>, c::JointTolerance<L>,
             c::JointTrajectoryControllerState<L>, c::PidState<L>, m::ChainConnection<L>,
             m::ControllerManagerActivity<L>, m::ControllerState<L>, m::HardwareComponentState<L>,
             m::HardwareInterface<L>, m::NamedLifecycleState<L>,
             diagnostic_msgs::msg::DiagnosticArray<L>, diagnostic_msgs::msg::DiagnosticStatus<L>,
             geometry_msgs::msg::TransformStamped<L>, lifecycle_msgs::msg::State<L>>();
  all.template
  operator()<r::FloatingPointRange, r::IntegerRange, r::ListParametersResult<L>, r::Log<L>,
             r::LoggerLevel<L>, r::Parameter<L>, r::ParameterDescriptor<L>, r::ParameterEvent<L>,
             r::ParameterEventDescriptors<L>, r::ParameterType, r::ParameterValue<L>,
             r::SetLoggerLevelsResult<L>, r::SetParametersResult<L>, rmw_dds_common::msg::Gid<L>,
             rmw_dds_common::msg::NodeEntitiesInfo<L>,
             rmw_dds_common::msg::ParticipantEntitiesInfo<L>, sensor_msgs::msg::JointState<L>,
             service_msgs::msg::ServiceEventInfo, std_msgs::msg::Float64MultiArray<L>,
             std_msgs::msg::Header<L>, std_msgs::msg::String<L>, tf2_msgs::msg::TFMessage<L>,
             t::JointTrajectory<L>, t::JointTrajectoryPoint<L>, t::MultiDOFJointTrajectory<L>,
             t::MultiDOFJointTrajectoryPoint<L>, unique_identifier_msgs::msg::UUID>();
}

/// Calls visit.template operator()<Service>() for each service.
template <class L, class Visit>
void for_each_service(const Visit& visit) {
  const auto all = [&]<class... S> { (visit.template operator()<S>(), ...); };
  namespace c = controller_manager_msgs::srv;
  namespace r = rcl_interfaces::srv;
  all.template
  operator()<action_msgs::srv::CancelGoal<L>, control_msgs::srv::QueryTrajectoryState<L>,
             c::CleanupController<L>, c::ConfigureController<L>, c::ListControllerTypes<L>,
             c::ListControllers<L>, c::ListHardwareComponents<L>, c::ListHardwareInterfaces<L>,
             c::LoadController<L>, c::ReloadControllerLibraries<L>, c::SetHardwareComponentState<L>,
             c::SwitchController<L>, c::UnloadController<L>, r::DescribeParameters<L>,
             r::GetLoggerLevels<L>, r::GetParameterTypes<L>, r::GetParameters<L>,
             r::ListParameters<L>, r::SetLoggerLevels<L>, r::SetParameters<L>,
             r::SetParametersAtomically<L>, std_srvs::srv::Empty<L>, std_srvs::srv::SetBool<L>,
             std_srvs::srv::Trigger<L>, type_description_interfaces::srv::GetTypeDescription<L>>();
}

/// Calls visit.template operator()<Action>() for each action.
template <class L, class Visit>
void for_each_action(const Visit& visit) {
  visit.template operator()<control_msgs::action::FollowJointTrajectory<L>>();
  visit.template operator()<control_msgs::action::GripperCommand<L>>();
  visit.template operator()<control_msgs::action::ParallelGripperCommand<L>>();
}

/// Calls visit.template operator()<M>() for each message that the wire carries.
template <class L, class Visit>
void for_each_sent(const Visit& visit) {
  const auto both = [&]<class Service> {
    visit.template operator()<typename Service::Request>();
    visit.template operator()<typename Service::Response>();
  };
  for_each_message<L>(visit);
  for_each_service<L>(both);
  for_each_action<L>([&]<class Action> {
    both.template operator()<SendGoal<Action>>();
    both.template operator()<GetResult<Action>>();
    visit.template operator()<FeedbackMessage<Action>>();
  });
}

}  // namespace articula::ros2::test

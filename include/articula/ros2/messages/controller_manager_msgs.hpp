// SPDX-License-Identifier: Apache-2.0
/// @file The services by which controllers are listed and switched.
#pragma once

#include "articula/ros2/fields.hpp"
#include "articula/ros2/messages/builtin_interfaces.hpp"
#include "articula/ros2/messages/lifecycle_msgs.hpp"
#include "articula/ros2/messages/std_msgs.hpp"

#include <cstdint>

namespace articula::ros2::controller_manager_msgs {

namespace msg {

/// A controller that takes references from another one.
template <class Layout>
struct ChainConnection {
  Text<Layout> name{};
  Sequence<Layout, Text<Layout>> reference_interfaces{};

  static constexpr TypeName ros_type = "controller_manager_msgs/msg/ChainConnection";
  static constexpr FieldNames<2> ros_fields{"name", "reference_interfaces"};
};

/// A controller with its state and its interfaces.
template <class Layout>
struct ControllerState {
  Text<Layout> name{};
  Text<Layout> state{};
  Text<Layout> type{};
  Since<Layout, Distribution::jazzy, bool> is_async{};
  Since<Layout, Distribution::jazzy, std::uint16_t> update_rate{};  ///< [Hz]
  Sequence<Layout, Text<Layout>> claimed_interfaces{};
  Sequence<Layout, Text<Layout>> required_command_interfaces{};
  Sequence<Layout, Text<Layout>> required_state_interfaces{};
  bool is_chainable = false;
  bool is_chained = false;
  Since<Layout, Distribution::jazzy, Sequence<Layout, Text<Layout>>> exported_state_interfaces{};
  Sequence<Layout, Text<Layout>> reference_interfaces{};
  Sequence<Layout, msg::ChainConnection<Layout>> chain_connections{};

  static constexpr TypeName ros_type = "controller_manager_msgs/msg/ControllerState";
  static constexpr FieldNames<13> ros_fields{"name",
                                             "state",
                                             "type",
                                             "is_async",
                                             "update_rate",
                                             "claimed_interfaces",
                                             "required_command_interfaces",
                                             "required_state_interfaces",
                                             "is_chainable",
                                             "is_chained",
                                             "exported_state_interfaces",
                                             "reference_interfaces",
                                             "chain_connections"};
};

/// A value that is read from hardware or commanded.
template <class Layout>
struct HardwareInterface {
  Text<Layout> name{};
  Since<Layout, Distribution::jazzy, Text<Layout>> data_type{};
  bool is_available = false;
  bool is_claimed = false;

  static constexpr TypeName ros_type = "controller_manager_msgs/msg/HardwareInterface";
  static constexpr FieldNames<4> ros_fields{"name", "data_type", "is_available", "is_claimed"};
};

/// A part of the hardware with its state and its interfaces.
template <class Layout>
struct HardwareComponentState {
  Text<Layout> name{};
  Text<Layout> type{};
  Since<Layout, Distribution::jazzy, bool> is_async{};
  Since<Layout, Distribution::jazzy, std::uint16_t> rw_rate{};  ///< [Hz]
  Until<Layout, Distribution::jazzy, Text<Layout>> class_type{};
  Since<Layout, Distribution::jazzy, Text<Layout>> plugin_name{};
  lifecycle_msgs::msg::State<Layout> state{};
  Sequence<Layout, msg::HardwareInterface<Layout>> command_interfaces{};
  Sequence<Layout, msg::HardwareInterface<Layout>> state_interfaces{};

  static constexpr TypeName ros_type = "controller_manager_msgs/msg/HardwareComponentState";
  static constexpr FieldNames<9> ros_fields{
      "name",        "type",  "is_async",           "rw_rate",         "class_type",
      "plugin_name", "state", "command_interfaces", "state_interfaces"};
};

/// A component with its state.
template <class Layout>
struct NamedLifecycleState {
  Text<Layout> name{};
  lifecycle_msgs::msg::State<Layout> state{};

  static constexpr TypeName ros_type = "controller_manager_msgs/msg/NamedLifecycleState";
  static constexpr FieldNames<2> ros_fields{"name", "state"};
};

/// The states of all controllers and of the hardware. Not in Humble.
template <class Layout>
struct ControllerManagerActivity {
  std_msgs::msg::Header<Layout> header{};
  Sequence<Layout, msg::NamedLifecycleState<Layout>> controllers{};
  Sequence<Layout, msg::NamedLifecycleState<Layout>> hardware_components{};

  static constexpr TypeName ros_type = "controller_manager_msgs/msg/ControllerManagerActivity";
  static constexpr FieldNames<3> ros_fields{"header", "controllers", "hardware_components"};
};
}  // namespace msg

namespace srv {

/// Takes a controller back to unconfigured. Not in Humble.
template <class Layout>
struct CleanupController {
  static constexpr TypeName ros_type = "controller_manager_msgs/srv/CleanupController";

  struct Request {
    Text<Layout> name{};

    static constexpr TypeName ros_type = "controller_manager_msgs/srv/CleanupController_Request";
    static constexpr FieldNames<1> ros_fields{"name"};
  };
  struct Response {
    bool ok = false;

    static constexpr TypeName ros_type = "controller_manager_msgs/srv/CleanupController_Response";
    static constexpr FieldNames<1> ros_fields{"ok"};
  };
};

/// Configures a controller.
template <class Layout>
struct ConfigureController {
  static constexpr TypeName ros_type = "controller_manager_msgs/srv/ConfigureController";

  struct Request {
    Text<Layout> name{};

    static constexpr TypeName ros_type = "controller_manager_msgs/srv/ConfigureController_Request";
    static constexpr FieldNames<1> ros_fields{"name"};
  };
  struct Response {
    bool ok = false;

    static constexpr TypeName ros_type = "controller_manager_msgs/srv/ConfigureController_Response";
    static constexpr FieldNames<1> ros_fields{"ok"};
  };
};

/// Lists the kinds of controllers that can be loaded.
template <class Layout>
struct ListControllerTypes {
  static constexpr TypeName ros_type = "controller_manager_msgs/srv/ListControllerTypes";

  struct Request {
    static constexpr TypeName ros_type = "controller_manager_msgs/srv/ListControllerTypes_Request";
    static constexpr FieldNames<0> ros_fields{};
  };
  struct Response {
    Sequence<Layout, Text<Layout>> types{};
    Sequence<Layout, Text<Layout>> base_classes{};

    static constexpr TypeName ros_type = "controller_manager_msgs/srv/ListControllerTypes_Response";
    static constexpr FieldNames<2> ros_fields{"types", "base_classes"};
  };
};

/// Lists the controllers.
template <class Layout>
struct ListControllers {
  static constexpr TypeName ros_type = "controller_manager_msgs/srv/ListControllers";

  struct Request {
    static constexpr TypeName ros_type = "controller_manager_msgs/srv/ListControllers_Request";
    static constexpr FieldNames<0> ros_fields{};
  };
  struct Response {
    Sequence<Layout, msg::ControllerState<Layout>> controller{};

    static constexpr TypeName ros_type = "controller_manager_msgs/srv/ListControllers_Response";
    static constexpr FieldNames<1> ros_fields{"controller"};
  };
};

/// Lists the parts of the hardware.
template <class Layout>
struct ListHardwareComponents {
  static constexpr TypeName ros_type = "controller_manager_msgs/srv/ListHardwareComponents";

  struct Request {
    static constexpr TypeName ros_type =
        "controller_manager_msgs/srv/ListHardwareComponents_Request";
    static constexpr FieldNames<0> ros_fields{};
  };
  struct Response {
    Sequence<Layout, msg::HardwareComponentState<Layout>> component{};

    static constexpr TypeName ros_type =
        "controller_manager_msgs/srv/ListHardwareComponents_Response";
    static constexpr FieldNames<1> ros_fields{"component"};
  };
};

/// Lists what can be read and commanded.
template <class Layout>
struct ListHardwareInterfaces {
  static constexpr TypeName ros_type = "controller_manager_msgs/srv/ListHardwareInterfaces";

  struct Request {
    static constexpr TypeName ros_type =
        "controller_manager_msgs/srv/ListHardwareInterfaces_Request";
    static constexpr FieldNames<0> ros_fields{};
  };
  struct Response {
    Sequence<Layout, msg::HardwareInterface<Layout>> command_interfaces{};
    Sequence<Layout, msg::HardwareInterface<Layout>> state_interfaces{};

    static constexpr TypeName ros_type =
        "controller_manager_msgs/srv/ListHardwareInterfaces_Response";
    static constexpr FieldNames<2> ros_fields{"command_interfaces", "state_interfaces"};
  };
};

/// Makes a controller.
template <class Layout>
struct LoadController {
  static constexpr TypeName ros_type = "controller_manager_msgs/srv/LoadController";

  struct Request {
    Text<Layout> name{};

    static constexpr TypeName ros_type = "controller_manager_msgs/srv/LoadController_Request";
    static constexpr FieldNames<1> ros_fields{"name"};
  };
  struct Response {
    bool ok = false;

    static constexpr TypeName ros_type = "controller_manager_msgs/srv/LoadController_Response";
    static constexpr FieldNames<1> ros_fields{"ok"};
  };
};

/// Loads the code of controllers again.
template <class Layout>
struct ReloadControllerLibraries {
  static constexpr TypeName ros_type = "controller_manager_msgs/srv/ReloadControllerLibraries";

  struct Request {
    bool force_kill = false;

    static constexpr TypeName ros_type =
        "controller_manager_msgs/srv/ReloadControllerLibraries_Request";
    static constexpr FieldNames<1> ros_fields{"force_kill"};
  };
  struct Response {
    bool ok = false;

    static constexpr TypeName ros_type =
        "controller_manager_msgs/srv/ReloadControllerLibraries_Response";
    static constexpr FieldNames<1> ros_fields{"ok"};
  };
};

/// Takes a part of the hardware to a state.
template <class Layout>
struct SetHardwareComponentState {
  static constexpr TypeName ros_type = "controller_manager_msgs/srv/SetHardwareComponentState";

  struct Request {
    Text<Layout> name{};
    lifecycle_msgs::msg::State<Layout> target_state{};

    static constexpr TypeName ros_type =
        "controller_manager_msgs/srv/SetHardwareComponentState_Request";
    static constexpr FieldNames<2> ros_fields{"name", "target_state"};
  };
  struct Response {
    bool ok = false;
    lifecycle_msgs::msg::State<Layout> state{};

    static constexpr TypeName ros_type =
        "controller_manager_msgs/srv/SetHardwareComponentState_Response";
    static constexpr FieldNames<2> ros_fields{"ok", "state"};
  };
};

/// Stops and starts controllers at the same moment.
template <class Layout>
struct SwitchController {
  static constexpr TypeName ros_type = "controller_manager_msgs/srv/SwitchController";
  static constexpr std::int32_t best_effort = 1;
  static constexpr std::int32_t strict = 2;

  struct Request {
    Sequence<Layout, Text<Layout>> activate_controllers{};
    Sequence<Layout, Text<Layout>> deactivate_controllers{};
    Until<Layout, Distribution::humble, Sequence<Layout, Text<Layout>>> start_controllers{};
    Until<Layout, Distribution::humble, Sequence<Layout, Text<Layout>>> stop_controllers{};
    std::int32_t strictness = 0;
    Until<Layout, Distribution::humble, bool> start_asap{};
    bool activate_asap = false;
    builtin_interfaces::msg::Duration timeout{};

    static constexpr TypeName ros_type = "controller_manager_msgs/srv/SwitchController_Request";
    static constexpr FieldNames<8> ros_fields{"activate_controllers", "deactivate_controllers",
                                              "start_controllers",    "stop_controllers",
                                              "strictness",           "start_asap",
                                              "activate_asap",        "timeout"};
  };
  struct Response {
    bool ok = false;
    Since<Layout, Distribution::jazzy, Text<Layout>> message{};

    static constexpr TypeName ros_type = "controller_manager_msgs/srv/SwitchController_Response";
    static constexpr FieldNames<2> ros_fields{"ok", "message"};
  };
};

/// Removes a controller.
template <class Layout>
struct UnloadController {
  static constexpr TypeName ros_type = "controller_manager_msgs/srv/UnloadController";

  struct Request {
    Text<Layout> name{};

    static constexpr TypeName ros_type = "controller_manager_msgs/srv/UnloadController_Request";
    static constexpr FieldNames<1> ros_fields{"name"};
  };
  struct Response {
    bool ok = false;

    static constexpr TypeName ros_type = "controller_manager_msgs/srv/UnloadController_Response";
    static constexpr FieldNames<1> ros_fields{"ok"};
  };
};

}  // namespace srv

}  // namespace articula::ros2::controller_manager_msgs

// SPDX-License-Identifier: Apache-2.0
#include <articula/config/load_controller_manager.hpp>
#include <articula/config/load_pid_gains.hpp>
#include <articula/config/load_signals.hpp>
#include <articula/config/load_trajectory_tolerances.hpp>
#include <articula/robots/q2d.hpp>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "catch.hpp"
#include "config_support.hpp"

using namespace articula;
using Catch::Matchers::Contains;
using support::yaml;

namespace {

using Load = std::function<void(const ConfigSource&)>;

const Load load_gains = [](const ConfigSource& source) {
  static_cast<void>(load_pid_gains(Q2d(), source));
};
const Load load_any = [](const ConfigSource& source) {
  static_cast<void>(load_controller(source));
};
const Load load_tolerances = [](const ConfigSource& source) {
  static_cast<void>(load_trajectory_tolerances(Q2d(), source));
};
const Load load_manager = [](const ConfigSource& source) {
  static_cast<void>(load_controller_manager(source));
};
const Load load_waves = [](const ConfigSource& source) {
  static_cast<void>(load_signals(Q2d(), source));
};

/// A message is one line with everything in it.
void check_message(const FileError& error) {
  const std::string message = error.what();
  CHECK(std::none_of(message.begin(), message.end(),
                     [](char c) { return static_cast<unsigned char>(c) < 0x20; }));
  CHECK(message.find(error.file()) == 0);
  CHECK(message.find(error.key()) != std::string::npos);
  CHECK(message.find(error.expected()) != std::string::npos);
}

const std::vector<std::string> hostile = {
    ".nan",   ".inf",    "-.inf", "1e999",         "-1",
    "1.5",    "0",       "1e308", "010",           "0x10",
    "1_0",    "many",    "'1'",   "\"\"",          "~",
    "",       "true",    "[]",    "[1]",           "{}",
    "{a: 1}", "!!str 1", "!x 1",  "[[1, 2], [3]]", "123456789012345678901234567890"};

/// A key, the line `before + key + ": " + value`, and which hostile values are good there.
struct Field {
  std::string before, key, after;
  std::vector<std::string> good{};
  std::string blamed{};  ///< what messages name, if not the key
};

/// Every hostile value in a field is taken where it is good, and else refused with its line and
/// key.
void check_field(const Load& load, const Field& field) {
  for (const std::string& value : hostile) {
    INFO(field.key << ": " << value);
    const std::string text = field.before + field.key + ": " + value + field.after;
    const auto line = 1 + std::count(field.before.begin(), field.before.end(), '\n');
    const bool good = std::find(field.good.begin(), field.good.end(), value) != field.good.end();
    if (good) {
      CHECK_NOTHROW(load(yaml(text)));
      continue;
    }
    try {
      load(yaml(text));
      CHECK(value == "taken");
    } catch (const FileError& error) {
      check_message(error);
      CAPTURE(std::string(error.what()));
      CHECK(error.line() == line);
      CHECK(error.column() > 0);
      CHECK(error.key().find(field.blamed.empty() ? field.key : field.blamed) != std::string::npos);
      CHECK(!error.expected().empty());
    }
  }
}

const std::vector<std::string> numbers = {"-1", "1.5", "0", "1e308",
                                          "123456789012345678901234567890"};
const std::vector<std::string> not_negative = {"1.5", "0", "1e308",
                                               "123456789012345678901234567890"};
const std::vector<std::string> bounds = {
    "-1", "1.5", "0", "1e308", ".inf", "-.inf", "123456789012345678901234567890"};

std::vector<std::string> without(std::vector<std::string> all,
                                 const std::vector<std::string>& some) {
  std::erase_if(
      all, [&](const auto& x) { return std::find(some.begin(), some.end(), x) != some.end(); });
  return all;
}

const std::vector<std::string> words = {"'1'", "!!str 1", "many", "010", "0x10", "1_0"};

const std::string joints = "joints: [shoulder_active_joint, elbow_active_joint]\n";
const std::string both = joints + "shoulder_active_joint: {p: 1}\nelbow_active_joint: {p: 1}\n";

}  // namespace

TEST_CASE("hostile values in every gain") {
  const std::string before = joints + "shoulder_active_joint: {p: 1}\nelbow_active_joint:\n  ";
  check_field(load_gains, {before, "p", "\n", not_negative});
  for (const std::string key : {"i", "d"}) {
    check_field(load_gains, {before, key, "\n  p: 1\n", not_negative});
  }
  for (const std::string key :
       {"ff_velocity_scale", "velocity_feedforward", "acceleration_feedforward"}) {
    check_field(load_gains, {before, key, "\n  p: 1\n", numbers});
  }
  for (const std::string key :
       {"tracking_time_constant", "error_deadband", "derivative_filter_time"}) {
    check_field(load_gains, {before, key, "\n  p: 1\n", not_negative});
  }
  for (const std::string key : {"position_weight", "velocity_weight", "feedforward_gain"}) {
    check_field(load_gains, {before, key, "\n  p: 1\n", {"0"}});
  }
  for (const std::string key :
       {"antiwindup", "saturation", "save_i_term", "save_iterm", "angle_wraparound",
        "normalize_error", "activate_state_publisher", "publish_state"}) {
    check_field(load_gains, {before, key, "\n  p: 1\n", {"true"}});
  }
  check_field(load_gains, {before, "antiwindup_strategy", "\n  p: 1\n"});
  check_field(load_gains, {before, "i_clamp", "\n  p: 1\n", without(bounds, {"-1", "-.inf"})});
  // 0 lies between the bounds.
  for (const std::string clamp : {"i_clamp", "u_clamp"}) {
    check_field(load_gains,
                {before, clamp + "_max", "\n  p: 1\n", without(bounds, {"-1", "-.inf"})});
    check_field(load_gains, {before, clamp + "_min", "\n  p: 1\n", {"-1", "0", "-.inf"}});
  }
  check_field(load_gains,
              {joints + "shoulder_active_joint: {p: 1}\nelbow_active_joint: {", "pid", "}\n"});
  // Directly among the parameters of a controller of one joint.
  check_field(load_any, {"joint: elbow_active_joint\np: 1\n", "i", "\n", not_negative});
  check_field(load_any, {"joint: elbow_active_joint\n", "p", "\n", not_negative});
  check_field(load_any, {"joint: elbow_active_joint\n", "pid", "\n"});
}

TEST_CASE("hostile values in every other parameter of a controller") {
  for (const std::string key : {"x", "y", "z"}) {
    const std::string rest = std::string(key == "x" ? "" : ", x: 0") +
                             (key == "y" ? "" : ", y: 0") + (key == "z" ? "" : ", z: -9.8") + "}\n";
    // Only the robot's own gravity is right; what is another number is refused as a whole.
    const std::vector<std::string> good(key == "z" ? 0 : 1, "0");
    check_field(load_gains, {both + "gravity: {", key, rest, good, "gravity"});
  }
  check_field(load_gains, {both, "gravity", "\n"});
  check_field(load_gains, {both, "chain", "\n", {"{}"}});
  check_field(load_gains, {both + "chain: {", "root", "}\n"});
  check_field(load_gains, {both + "chain: {", "tip", ", root: origin_link}\n"});
  check_field(load_gains, {both, "priority", "\n", {"0"}});
  check_field(load_gains, {both, "type", "\n", words});
  const std::string gains = "gains: {shoulder_active_joint: {p: 1}, elbow_active_joint: {p: 1}}\n";
  for (const std::string key : {"joints", "dof_names", "joint_names", "joint", "joint_name"}) {
    check_field(load_gains, {gains, key, "\n"});
  }
  check_field(load_any, {joints, "gains", "\n", {"{}"}});
  check_field(load_gains, {both, "reference_and_state_interfaces", "\n"});
  check_field(load_gains, {both, "velocity_ff", "\n", {"{}"}});
  check_field(load_gains, {both + "velocity_ff: {", "elbow_active_joint", "}\n", numbers});
  check_field(load_gains, {both, "constraints", "\n", {"{}"}});
  check_field(load_gains, {joints + "Kp: [1, 1]\n", "Kd", "\n"});
  check_field(load_gains, {joints + "Kd: [1, 1]\n", "Kp", "\n"});
  check_field(load_gains, {joints + "Kd: [1, 1]\nKp: [1, {", "Kp", "}]\n"});
  for (const std::string key :
       {"allow_partial_joints_goal", "allow_integration_in_goal_trajectories",
        "allow_nonzero_velocity_at_trajectory_end", "use_sim_time", "is_async",
        "interpolate_from_desired_state", "open_loop_control", "allow_trajectory_replacement",
        "use_external_measured_states", "set_current_state_as_first_setpoint", "start_with_holding",
        "allow_stalling", "use_effort_interface", "use_speed_interface", "default",
        "enable_feedforward", "set_last_command_interface_value_as_state_on_activation"}) {
    check_field(load_gains, {both, key, "\n", {"true"}});
  }
  check_field(load_gains, {both, "interpolation_method", "\n"});
  for (const std::string key :
       {"publish_rate", "state_publish_rate", "action_monitor_rate", "update_rate",
        "stop_trajectory_duration", "cmd_timeout", "goal_tolerance", "max_effort", "max_velocity",
        "stall_velocity_threshold", "stall_timeout"}) {
    check_field(load_gains, {both, key, "\n", not_negative});
  }
  for (const std::string key : {"command_interfaces", "state_interfaces", "command_joints",
                                "reference_and_state_dof_names", "fallback_controllers"}) {
    check_field(load_gains, {both, key, "\n", {"[]"}});
  }
  for (const std::string key :
       {"robot_description", "command_interface", "interface_name", "params_file"}) {
    check_field(load_gains, {both, key, "\n", words});
  }
  for (const std::string key : {"max_effort_interface", "max_velocity_interface",
                                "speed_scaling_interface_name", "tf_prefix"}) {
    check_field(load_gains,
                {both, key, "\n",
                 without(hostile, {"[]", "[1]", "{}", "{a: 1}", "!x 1", "[[1, 2], [3]]"})});
  }
  for (const std::string key : {"async_parameters", "speed_scaling", "positions_upsampling"}) {
    check_field(load_gains, {both, key, "\n", {"{}", "{a: 1}"}});
  }
}

TEST_CASE("hostile values in every constraint") {
  const std::string before = joints + "constraints:\n  ";
  for (const std::string key : {"stopped_velocity_tolerance", "goal_time"}) {
    check_field(load_tolerances, {before, key, "\n", not_negative});
  }
  for (const std::string key : {"trajectory", "goal", "max_deceleration_on_cancel"}) {
    check_field(load_tolerances, {before + "elbow_active_joint:\n    ", key, "\n", not_negative});
  }
  check_field(load_tolerances, {before, "decelerate_on_cancel", "\n", {"true"}});
  check_field(load_tolerances, {before, "elbow_active_joint", "\n", {"{}"}});
}

TEST_CASE("hostile values in every parameter of the controller manager") {
  const std::string before = "controller_manager:\n  ros__parameters:\n    ";
  check_field(load_manager, {before, "update_rate", "\n"});
  check_field(load_manager, {before, "thread_priority", "\n", {"0"}});
  check_field(load_manager, {before, "cpu_affinity", "\n", {"-1", "0", "[]", "[1]"}});
  for (const std::string key : {"lock_memory", "enforce_command_limits", "use_sim_time",
                                "handle_exceptions", "shutdown_on_initial_state_failure"}) {
    check_field(load_manager, {before, key, "\n", {"true"}});
  }
  for (const std::string key : {"diagnostics", "overruns", "defaults", "hardware_synchronization",
                                "hardware_components_initial_state"}) {
    check_field(load_manager, {before, key, "\n", {"{}", "{a: 1}"}});
  }
  check_field(load_manager, {before, "robot_description", "\n", words});
  check_field(load_manager, {before, "arm", "\n"});
  check_field(load_manager, {before + "arm: {", "type", "}\n", words});
  check_field(load_manager, {before + "arm: {type: a/B, ", "update_rate", "}\n", not_negative});
}

TEST_CASE("hostile values in every waveform") {
  const std::string before = "waveforms:\n  elbow_active_joint:\n    ";
  const std::string sine = "\n    amplitude: 1\n    frequency: 1\n";
  const std::vector<std::string> efforts = {"-1", "1.5", "0"};  // the drive gives 13.62 N m
  check_field(load_waves, {before, "amplitude", "\n    frequency: 1\n", efforts});
  check_field(load_waves, {before, "frequency", "\n    amplitude: 1\n", {"1.5"}});
  check_field(load_waves, {before, "angular_frequency", "\n    amplitude: 1\n", {"1.5"}});
  check_field(load_waves, {before, "period", "\n    amplitude: 1\n", without(not_negative, {"0"})});
  check_field(load_waves, {before, "phase", sine, numbers});
  check_field(load_waves, {before, "offset", sine, efforts});
  check_field(load_waves, {before, "type", sine});
  check_field(load_waves, {before, "target", sine});
  check_field(load_waves, {before, "height", "\n    type: step\n", efforts});
  check_field(load_waves, {before, "start", "\n    type: step\n    height: 1\n", numbers});
  check_field(load_waves, {before, "duration", "\n    type: ramp\n    height: 1\n",
                           without(not_negative, {"0"})});
  for (const std::string key : {"first_frequency", "last_frequency"}) {
    const std::string other = key == "first_frequency" ? "last_frequency" : "first_frequency";
    check_field(load_waves,
                {before,
                 key,
                 "\n    type: chirp\n    amplitude: 1\n    duration: 9\n    " + other + ": 5\n",
                 {"1.5"}});
  }
  check_field(load_waves, {before, "joint", sine});
  check_field(load_waves, {"", "waveforms", "\n"});
  const std::string waves = "waveforms: {elbow_active_joint: {amplitude: 1, frequency: 1}}\n";
  for (const std::string key : {"joint", "joint_name", "joints", "target"}) {
    check_field(load_waves, {waves, key, "\n"});
  }
  check_field(load_waves, {waves, "type", "\n", words});
}

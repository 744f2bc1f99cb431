// SPDX-License-Identifier: Apache-2.0
/// @file Feeds the readers of configuration files with anything. They must answer with parameters
/// that can be used or with a FileError in one line, and with nothing else.
#include <articula/config/load_controller_manager.hpp>
#include <articula/config/load_pid_gains.hpp>
#include <articula/config/load_signals.hpp>
#include <articula/config/load_trajectory_tolerances.hpp>
#include <articula/control/pid_plus_gravity.hpp>
#include <articula/robots/q2d.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace {

using namespace articula;

void load(auto function) {
  try {
    function();
  } catch (const FileError& error) {  // the right answer
    const std::string_view message = error.what();
    for (const char c : message) {
      if (static_cast<unsigned char>(c) < 0x20) __builtin_trap();
    }
    if (message.empty() || error.line() < 0) __builtin_trap();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data),
                         size);  // NOLINT: bytes are characters
  const ConfigSource source = ConfigSource::text(text, "fuzz");
  const ConfigSource filled =
      ConfigSource::text(text, "fuzz", {{"x", "2"}, {"y", ""}, {"z", "elbow_active_joint"}});
  const Q2d robot;
  load([&] { static_cast<void>(PidPlusGravity<Q2d>(load_pid_gains(robot, source).gains)); });
  load([&] { static_cast<void>(load_pid_gains(robot, source, "pid_controller")); });
  load([&] { static_cast<void>(load_controller(source)); });
  load([&] { static_cast<void>(load_controller(filled, "left/arm")); });
  load([&] {
    const auto any = load_pid_gains(robot, filled, "", GainsOf::all_joints, GainSigns::any);
    validate(any.gains, joint_names(robot), GainSigns::any);
  });
  load([&] {
    const auto some = load_pid_gains(robot, source, "", GainsOf::some_joints);
    if (some.group.empty()) __builtin_trap();
    validate(some.gains, joint_names(robot));
  });
  load([&] { validate(robot, load_trajectory_tolerances(robot, source).tolerances); });
  load([&] {
    if (!(load_controller_manager(source).period() > 0)) __builtin_trap();
  });
  load([&] { static_cast<void>(JointSignals<Q2d, 20000>(load_signals(robot, source).signals)); });
  return 0;
}

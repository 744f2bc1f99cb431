// SPDX-License-Identifier: Apache-2.0
/// @file Hardware that measures and answers what a test tells it, and remembers what it was given.
#pragma once

#include <articula/core/finite.hpp>
#include <articula/core/hardware.hpp>
#include <articula/model/robot.hpp>

namespace support {

template <articula::DescribedRobot R,
          class Command = articula::EffortCommand<articula::joint_count<R>>>
struct FakeHardware {
  using RobotType = R;
  static constexpr int joint_count = articula::joint_count<R>;
  using State = articula::JointState<joint_count>;
  using Status = articula::Status;

  State measured{};
  Status activation = Status::ok;
  Status reading = Status::ok;
  Status writing = Status::ok;

  Command written{};
  int writes = 0;
  bool was_given_non_finite = false;

  [[nodiscard]] R robot() const noexcept { return {}; }
  [[nodiscard]] Status activate() noexcept { return activation; }
  [[nodiscard]] Status deactivate() noexcept { return Status::ok; }
  [[nodiscard]] Status read(State& state) noexcept {
    state = measured;
    return reading;
  }
  [[nodiscard]] Status write(const Command& command) noexcept {
    written = command;
    ++writes;
    was_given_non_finite = was_given_non_finite || !articula::is_finite(command);
    return writing;
  }
};

}  // namespace support

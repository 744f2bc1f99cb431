// SPDX-License-Identifier: Apache-2.0
/// @file The other end of the bus: CiA 402 drives on a simulated arm.
#pragma once

#include "articula/dynamics/mass_matrix.hpp"
#include "articula/hardware/can/can_batch.hpp"
#include "articula/hardware/cia402/cia402.hpp"
#include "articula/hardware/cia402/cia402_drive.hpp"
#include "articula/hardware/cia402/simulated_cia402_node.hpp"
#include "articula/sim/simulator.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

namespace articula {

/// CiA 402 drives in the cyclic synchronous modes with a simulated arm behind them. Frames go in
/// and out; there is no bus in it. Its time is the host's: each SYNC lets one period pass. At SYNC
/// the drives measure, and put into force what has come; so feedback shows the arm at SYNC, one
/// period before the host can answer it.
///
/// In position and velocity mode the drives close their own loop: a stiffness and a damping that
/// would give the joint's own inertia a natural frequency of 10 Hz, critically damped.
/// @tparam R  the robot
template <Robot R>
class SimulatedCia402Drives {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using Quirks = std::array<SimulatedCia402Quirks, static_cast<std::size_t>(joint_count)>;

  /// @param robot   whose joints these are
  /// @param drives   in the order of the joints
  /// @param options  of the simulated arm
  /// @param quirks   of the drives: what each lacks or does in its own way
  /// @throws std::invalid_argument if either makes no sense
  SimulatedCia402Drives(const R& robot, const Cia402DriveList<joint_count>& drives,
                        const SimulatorOptions<joint_count>& options = {},
                        const Quirks& quirks = {})
      : drives_(drives), simulator_(robot, options), effort_limits_(effort_limits(robot)) {
    validate(robot, drives);
    for (std::size_t j = 0; j < drives.size(); ++j) {
      nodes_[j] = SimulatedCia402Node(drives[j].node, options.period, quirks[j]);
    }
    const JointVector<joint_count> inertia =
        mass_matrix(robot, initial_position(robot, options)).diagonal();
    const double frequency = 2 * std::numbers::pi * 10;
    stiffness_ = inertia * (frequency * frequency);
    damping_ = inertia * (2 * frequency);
    friction_ = joint_values(robot, [](const JointProperties& joint) { return joint.damping; });
    show_joints();
  }
  /// For a robot known at compile time.
  explicit SimulatedCia402Drives(const Cia402DriveList<joint_count>& drives,
                                 const SimulatorOptions<joint_count>& options = {},
                                 const Quirks& quirks = {})
    requires DescribedRobot<R>
      : SimulatedCia402Drives(R(), drives, options, quirks) {}

  /// Takes a frame from the bus. SYNC lets a period pass and is answered.
  /// @param frame    any frame
  /// @param answers  receives the drives' frames
  /// Real-time: yes.
  void receive(const CanFrame& frame, CanBatch& answers) noexcept {
    for (SimulatedCia402Node& node : nodes_) node.receive(frame, answers);
    if (frame.extended || frame.identifier != canopen::sync_identifier || frame.length > 1) return;
    for (SimulatedCia402Node& node : nodes_) node.take_sync(frame, answers);
    pass_period(answers);
  }

  /// Lets a period pass in which there was no SYNC.
  /// @param answers  receives heartbeats and emergencies
  /// Real-time: yes.
  void pass_silent_period(CanBatch& answers) noexcept { pass_period(answers); }

  /// Makes one drive fault, as its own sensors would.
  /// @param joint  index of its joint
  /// @param code   error code, not 0
  /// Real-time: yes.
  void raise_fault(int joint, std::uint16_t code) noexcept {
    nodes_[static_cast<std::size_t>(joint)].raise_fault(code);
  }
  /// Resets one drive, as a loss of its supply would. Real-time: yes.
  void restart(int joint) noexcept {
    nodes_[static_cast<std::size_t>(joint)].restart();
    show_joints();
  }

  /// The effort that the drives exert [N m or N], N x 1. Real-time: yes.
  [[nodiscard]] const JointVector<joint_count>& effort() const noexcept { return effort_; }
  [[nodiscard]] bool enabled(int joint) const noexcept {
    return nodes_[static_cast<std::size_t>(joint)].enabled();
  }
  [[nodiscard]] const SimulatedCia402Node& node(int joint) const noexcept {
    return nodes_[static_cast<std::size_t>(joint)];
  }
  [[nodiscard]] const Simulator<R>& simulator() const noexcept { return simulator_; }

 private:
  void pass_period(CanBatch& answers) noexcept {
    for (SimulatedCia402Node& node : nodes_) node.pass_period(answers);
    for (int j = 0; j < joint_count; ++j) effort_[j] = drive_effort(j);
    static_cast<void>(simulator_.write({effort_}));
    show_joints();
  }

  /// What drive j makes of its target.
  [[nodiscard]] double drive_effort(int j) const noexcept {
    const auto i = static_cast<std::size_t>(j);
    const SimulatedCia402Node& node = nodes_[i];
    if (!node.enabled()) return 0;
    const Cia402Drive& drive = drives_[i];
    const double q = simulator_.true_state().position[j], v = simulator_.true_state().velocity[j];
    double effort = 0;
    switch (node.mode()) {
      case cia402::Mode::cyclic_synchronous_torque:
        effort = node.target(cia402::target_torque) * drive.rated_effort / 1e3;
        break;
      case cia402::Mode::cyclic_synchronous_velocity: {
        const double wanted = node.target(cia402::target_velocity) / drive.velocity_scale;
        effort = damping_[j] * (wanted - v) + friction_[j] * wanted;
        break;
      }
      case cia402::Mode::cyclic_synchronous_position: {
        const double wanted =
            (static_cast<double>(node.target(cia402::target_position)) - drive.zero_position) /
            drive.position_scale;
        effort = stiffness_[j] * (wanted - q) - damping_[j] * v;
        break;
      }
    }
    return std::clamp(effort, -effort_limits_[j], effort_limits_[j]);
  }

  /// Brings the joints' state into the nodes' objects, in their units.
  void show_joints() noexcept {
    JointState<joint_count> state;
    if (simulator_.read(state) != Status::ok) return;
    const auto rounded = [](double value, double most) {
      return static_cast<std::int32_t>(std::llround(std::clamp(value, -most, most)));
    };
    constexpr double most = 2147483647;
    for (int j = 0; j < joint_count; ++j) {
      const Cia402Drive& drive = drives_[static_cast<std::size_t>(j)];
      nodes_[static_cast<std::size_t>(j)].show(
          rounded(state.position[j] * drive.position_scale + drive.zero_position, most),
          rounded(state.velocity[j] * drive.velocity_scale, most),
          rounded(state.effort[j] / drive.rated_effort * 1e3, 32767));
    }
  }

  Cia402DriveList<joint_count> drives_;
  Simulator<R> simulator_;
  JointVector<joint_count> effort_limits_;
  JointVector<joint_count> stiffness_ = JointVector<joint_count>::Zero();
  JointVector<joint_count> damping_ = JointVector<joint_count>::Zero();
  JointVector<joint_count> friction_ = JointVector<joint_count>::Zero();
  JointVector<joint_count> effort_ = JointVector<joint_count>::Zero();
  std::array<SimulatedCia402Node, static_cast<std::size_t>(joint_count)> nodes_{};
};

}  // namespace articula

// SPDX-License-Identifier: Apache-2.0
/// @file Simulated CiA 402 drives of a simulated arm: the other end of the bus.
#pragma once

#include "articula/core/joint_array.hpp"
#include "articula/dynamics/mass_matrix.hpp"
#include "articula/hardware/can/can_batch.hpp"
#include "articula/hardware/can/nearest_units.hpp"
#include "articula/hardware/cia402/cia402.hpp"
#include "articula/hardware/cia402/cia402_drive.hpp"
#include "articula/hardware/cia402/simulated_cia402_node.hpp"
#include "articula/sim/simulator.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numbers>

namespace articula {

/// CiA 402 drives in the cyclic synchronous modes on a simulated arm. Frames go in and out; there
/// is no bus. Each SYNC of the host simulates one period. At SYNC the drives measure, and put
/// received commands into force. So feedback shows the arm at SYNC, one period before the host can
/// answer it.
///
/// In position and velocity mode the drives close their own loop. Its stiffness and damping give
/// the joint's own inertia a natural frequency of 10 Hz, critically damped.
template <Robot R>
class SimulatedCia402Drives {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using Quirks = JointArray<SimulatedCia402Quirks, joint_count>;

  /// @param robot   whose joints these are
  /// @param drives   in the order of the joints
  /// @param options  of the simulated arm
  /// @param quirks   of each drive
  /// @throws std::invalid_argument as validate(robot, drives) and the simulator
  SimulatedCia402Drives(const R& robot, const Cia402DriveList<joint_count>& drives,
                        const SimulatorOptions<joint_count>& options = {},
                        const Quirks& quirks = {})
      : drives_{drives}, simulator_(robot, options) {
    validate(robot, drives);
    for (std::size_t j = 0; j < drives.size(); ++j) {
      nodes_[j] = SimulatedCia402Node(drives[j].node, options.period, quirks[j]);
    }
    const JointVector<joint_count> inertia =
        mass_matrix(robot, initial_position(robot, options)).diagonal();
    const double frequency = 2 * std::numbers::pi * 10;
    stiffness_ = inertia * (frequency * frequency);
    damping_ = inertia * (2 * frequency);
    show_joints();
  }
  /// For a robot known at compile time.
  explicit SimulatedCia402Drives(const Cia402DriveList<joint_count>& drives,
                                 const SimulatorOptions<joint_count>& options = {},
                                 const Quirks& quirks = {})
    requires DescribedRobot<R>
      : SimulatedCia402Drives(R(), drives, options, quirks) {}

  /// Processes a frame from the bus. SYNC simulates a period, and the drives answer it.
  /// @param frame    any frame
  /// @param answers  receives the drives' frames
  /// Real-time: yes.
  void receive(const CanFrame& frame, CanBatch& answers) noexcept {
    for (SimulatedCia402Node& node : nodes_) node.receive(frame, answers);
    if (frame.extended || frame.identifier != canopen::sync_identifier || frame.length > 1) return;
    for (SimulatedCia402Node& node : nodes_) node.take_sync(frame, answers);
    pass_silent_period(answers);
  }
  /// Simulates a period without SYNC.
  /// @param answers  receives heartbeats and emergencies
  /// Real-time: yes.
  void pass_silent_period(CanBatch& answers) noexcept {
    for (SimulatedCia402Node& node : nodes_) node.pass_period(answers);
    for (int j = 0; j < joint_count; ++j) effort_[j] = drive_effort(j);
    static_cast<void>(simulator_.write({effort_}));
    show_joints();
  }

  /// Makes one drive fault, as its own sensors would.
  /// @param code  error code, not 0
  /// Real-time: yes.
  void raise_fault(int joint, std::uint16_t code) noexcept { nodes_[joint].raise_fault(code); }
  /// Resets one drive, as a loss of its supply would. Real-time: yes.
  void restart(int joint) noexcept {
    nodes_[joint].restart();
    show_joints();
  }

  /// The effort that the drives exert [N m or N], N x 1. Real-time: yes.
  [[nodiscard]] const JointVector<joint_count>& effort() const noexcept { return effort_; }
  [[nodiscard]] bool enabled(int joint) const noexcept { return nodes_[joint].enabled(); }
  [[nodiscard]] const SimulatedCia402Node& node(int joint) const noexcept { return nodes_[joint]; }
  [[nodiscard]] const Simulator<R>& simulator() const noexcept { return simulator_; }

 private:
  /// The effort by which drive j follows its target.
  [[nodiscard]] double drive_effort(int j) const noexcept {
    const SimulatedCia402Node& node = nodes_[j];
    if (!node.enabled()) return 0;
    const Cia402Drive& drive = drives_[j];
    const JointProperties& joint = model_of(simulator_.robot()).joints[j];
    const double q = simulator_.true_state().position[j], v = simulator_.true_state().velocity[j];
    double effort = 0;
    switch (node.mode()) {
      case cia402::Mode::cyclic_synchronous_torque:
        effort = drive.effort(node.target(cia402::target_torque));
        break;
      case cia402::Mode::cyclic_synchronous_velocity: {
        const double target = drive.velocity(node.target(cia402::target_velocity));
        effort = damping_[j] * (target - v) + joint.damping * target;
        break;
      }
      case cia402::Mode::cyclic_synchronous_position: {
        const double target = drive.position(node.target(cia402::target_position));
        effort = stiffness_[j] * (target - q) - damping_[j] * v;
        break;
      }
    }
    return std::clamp(effort, -joint.limits.effort, joint.limits.effort);
  }

  /// Copies the measured figures into the nodes' objects, in their units.
  void show_joints() noexcept {
    JointState<joint_count> state;
    if (simulator_.read(state) != Status::ok) return;
    constexpr double most = 2147483647;
    for (int j = 0; j < joint_count; ++j) {
      const Cia402Drive& drive = drives_[j];
      nodes_[j].show(nearest_units(drive.position_units(state.position[j]), most),
                     nearest_units(drive.velocity_units(state.velocity[j]), most),
                     nearest_units(drive.per_mille(state.effort[j]), 32767));
    }
  }

  JointArray<Cia402Drive, joint_count> drives_;
  Simulator<R> simulator_;
  JointVector<joint_count> stiffness_ = JointVector<joint_count>::Zero();
  JointVector<joint_count> damping_ = JointVector<joint_count>::Zero();
  JointVector<joint_count> effort_ = JointVector<joint_count>::Zero();
  JointArray<SimulatedCia402Node, joint_count> nodes_{};
};

}  // namespace articula

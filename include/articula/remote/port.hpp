// SPDX-License-Identifier: Apache-2.0
/// @file The port through which transports reach a running loop.
#pragma once

#include "articula/control/switching/switch_request.hpp"
#include "articula/core/refuse.hpp"
#include "articula/motion/joint_motion.hpp"
#include "articula/remote/cycle.hpp"
#include "articula/remote/forecast/futures_question.hpp"
#include "articula/remote/gains/parameter.hpp"
#include "articula/remote/request.hpp"
#include "articula/remote/sheet/link_pose.hpp"
#include "articula/remote/sheet/robot_sheet.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace articula::remote {

/// Something that has happened: a fault, a change of mode, a controller that started or failed, a
/// request of an operator.
struct Event {
  enum class Level : unsigned char { info, warning, error };
  double time = 0;  ///< of the loop [s]
  Level level = Level::info;
  std::string text{};
};

/// The present state of what changes seldom.
struct Situation {
  LoopMode mode = LoopMode::active;
  Status fault = Status::ok;  ///< the last fault; ok before the first
  std::string advice{};       ///< the cure of the fault, a sentence
  /// The source of the reference: "rest", "go", "set", "trajectory", "signals", "stop"; if joints
  /// have several, that which was begun last.
  std::string motion{};
  std::vector<std::string> joint_motions{};  ///< of each joint, in the order of RobotSheet::joints
  /// Whether an active controller moves each joint to the position of the reference.
  std::vector<bool> following{};
  std::string operator_name{};  ///< of the session that has the controls; empty: nobody
  std::vector<ControllerInfo> controllers{};
  bool paused = false;          ///< of a simulation
  double speed = 1;             ///< likewise
  double trajectory_speed = 1;  ///< as the last SetTrajectorySpeed
};

/// One client of a port: a browser, a terminal, a bridge. Watches, and may take the controls. All
/// functions may be called from any thread, but from one at a time; they never wait for the loop.
/// Real-time: no (allocates, locks).
class Session {
 public:
  virtual ~Session() = default;

  /// Takes the controls if nobody has them.
  /// @return empty if this session has them now, else the reason
  virtual std::string take_controls() = 0;
  /// Gives the controls back. A motion goes on; a pull ends.
  virtual void release_controls() = 0;
  [[nodiscard]] virtual bool has_controls() const = 0;
  /// Tells that the client is still there. A client that has the controls loses them if it neither
  /// calls this nor makes requests for RemoteOptions::operator_lifetime. Destruction of
  /// the session has the same effect. The loop then does as RemoteOptions::when_operator_is_lost
  /// says.
  virtual void keep_alive() = 0;

  /// Hands a request to the loop, which does requests in their order. A request takes the controls
  /// if nobody has them, and is refused if somebody else has. A Stop needs no controls, only a
  /// session that may operate.
  /// @return its number, from 1; its answer comes by `answer`
  virtual std::uint64_t ask(const Request& request) = 0;
  /// The oldest answer that was not taken yet.
  [[nodiscard]] virtual std::optional<Answer> answer() = 0;

  /// Takes the oldest cycle that was not taken yet. Of cycles that nobody takes, the last ones
  /// (some seconds) are kept.
  /// @param cycle  receives it; its vectors are reused
  /// @return       whether there was one
  [[nodiscard]] virtual bool next(Cycle& cycle) = 0;
  /// The oldest event that was not taken yet.
  [[nodiscard]] virtual std::optional<Event> event() = 0;
};

/// What a running loop offers to the outside, without a transport. Remote makes one from a loop.
/// All functions may be called from any thread. Real-time: no (allocates, locks).
class Port {
 public:
  virtual ~Port() = default;
  [[nodiscard]] virtual const RobotSheet& robot() const = 0;
  [[nodiscard]] virtual Situation situation() = 0;
  /// The placements of all links at a position of the joints, in the order of RobotSheet::links.
  [[nodiscard]] virtual std::vector<LinkPose> link_poses(
      const std::vector<double>& position) const = 0;
  /// The motion of each joint's reference at a time to come, if no further request changes it: that
  /// of a trajectory, or rest. None for a joint that another motion moves, or that waits for the
  /// start of a trajectory; none at all while the loop is not active.
  /// @param time  of the loop [s]; before that of the last cycle it means that one. If it is not
  ///              finite, no joint has a motion.
  [[nodiscard]] virtual std::vector<std::optional<JointMotion>> planned(double) {
    return std::vector<std::optional<JointMotion>>(robot().joints.size());
  }
  [[nodiscard]] virtual std::vector<Parameter> parameters() = 0;
  [[nodiscard]] virtual Statistics statistics() = 0;
  /// Simulates what the loop would do with other gains. Changes nothing, and takes its time: ask
  /// from a thread that may wait. Questions of several threads are answered one after another.
  /// @throws std::invalid_argument with the reason if there is no answer
  [[nodiscard]] virtual FuturesAnswer futures(const FuturesQuestion&) {
    articula::detail::refuse({"futures: this port has none"});
  }
  /// @param name      of the client, for others to see
  /// @param operates  whether it may take the controls
  [[nodiscard]] virtual std::unique_ptr<Session> connect(std::string name, bool operates) = 0;
};

}  // namespace articula::remote

// SPDX-License-Identifier: Apache-2.0
/// @file Random arms in lanes beside the same arms one by one.
#pragma once

#include "catch.hpp"
#include "numbers.hpp"
#include "random.hpp"

#include <articula/control/pid_plus_gravity.hpp>
#include <articula/lanes/lane_loop.hpp>
#include <articula/loop/control_loop.hpp>
#include <articula/sim/simulator.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace support {

using namespace articula;

/// Both compute the same operations in the same order. Where the processor fuses multiplications
/// and additions, compilers fuse other ones in packs: the motions then differ by some 1e-16 in a
/// cycle, which the closed loop keeps from growing beyond 1e-7 of the motion, shifted impacts
/// included.
#if defined(__FMA__) || defined(__FP_FAST_FMA)
inline constexpr double tolerance = 1e-7;
#else
inline constexpr double tolerance = 0;
#endif

/// A simulator that gets each command some cycles later, or the one before instead.
template <class R>
class Delayed {
 public:
  using RobotType = R;
  static constexpr int joint_count = articula::joint_count<R>;

  Delayed(Simulator<R> simulator, int delay, const LostCommands& lost)
      : simulator_(std::move(simulator)), sent_(static_cast<std::size_t>(delay)), lost_(lost) {}
  [[nodiscard]] Status activate() { return simulator_.activate(); }
  [[nodiscard]] Status deactivate() { return simulator_.deactivate(); }
  [[nodiscard]] Status read(JointState<joint_count>& state) noexcept {
    return simulator_.read(state);
  }
  [[nodiscard]] Status write(const EffortCommand<joint_count>& command) noexcept {
    if (!lost_.contain(count_)) last_ = command;
    const std::uint64_t count = count_++;
    if (sent_.empty()) return simulator_.write(last_);
    EffortCommand<joint_count>& oldest = sent_[count % sent_.size()];
    const EffortCommand<joint_count> arrived = oldest;
    oldest = last_;
    return simulator_.write(arrived);
  }
  [[nodiscard]] const R& robot() const { return simulator_.robot(); }
  [[nodiscard]] double period() const { return simulator_.period(); }
  [[nodiscard]] Simulator<R>& simulator() { return simulator_; }

 private:
  Simulator<R> simulator_;
  std::vector<EffortCommand<joint_count>> sent_;
  LostCommands lost_;
  EffortCommand<joint_count> last_{};  ///< that is not lost
  std::uint64_t count_ = 0;
};

/// What lanes differ in.
struct Differences {
  double mass = 0.4;      ///< relative
  bool whole = false;     ///< all links of an arm by one factor
  double friction = 0;    ///< highest, relative to the effort limit
  double stop = 10;       ///< farthest stop from the start [rad]
  double noise = 0;       ///< of positions [rad]
  double resolution = 0;  ///< of encoders [rad]
  bool hostile = false;   ///< references of extreme size
  int delay = 0;          ///< highest [cycles]
  double lost = 0;        ///< highest share of the commands
};

template <class R>
std::vector<LaneSetup<R>> random_setups(Random& random, const Differences& by) {
  constexpr int n = joint_count<R>;
  std::vector<LaneSetup<R>> setups(static_cast<std::size_t>(lanes<LanePack<R>>));
  for (LaneSetup<R>& setup : setups) {
    auto description = R::description;
    double scale = by.whole ? random.number(1 - by.mass, 1 + by.mass) : 1;
    for (Link& link : description.links) {
      if (!by.whole) scale = random.number(1 - by.mass, 1 + by.mass);
      link.mass *= scale;
      for (double* x : {&link.inertia.xx, &link.inertia.xy, &link.inertia.xz, &link.inertia.yy,
                        &link.inertia.yz, &link.inertia.zz}) {
        *x *= scale;
      }
    }
    for (Joint& joint : description.joints) {
      if (joint.type == JointType::fixed) continue;
      joint.damping *= random.number(0.5, 2);
      joint.friction = by.friction * joint.limits.effort * random.number(0, 1);
      const JointLimits& described = joint.limits;
      const double middle = (described.lower + described.upper) / 2;
      joint.limits.lower = std::max(described.lower, middle - random.number(0.05, 1) * by.stop);
      joint.limits.upper = std::min(described.upper, middle + random.number(0.05, 1) * by.stop);
    }
    setup.robot = VariedRobot<R>(description);
    JointVector<n> start;
    for (int j = 0; j < n; ++j) {
      const JointLimits& limits = setup.robot.joints[j].limits;
      start[j] = limits.lower + random.number(0.2, 0.8) * (limits.upper - limits.lower);
    }
    setup.simulation.initial_position = start;
    setup.simulation.initial_velocity = random.vector<n>(0.1);
    setup.simulation.position_noise.setConstant(by.noise);
    setup.simulation.encoder_resolution.setConstant(by.resolution * random.integer(0, 2));
    setup.simulation.seed = static_cast<std::uint64_t>(random.integer(1, 1000));
    setup.delay = random.integer(0, by.delay);
    if (by.lost > 0) setup.lost = {random.number(0, by.lost), setup.simulation.seed};
  }
  return setups;
}

template <class R>
JointPidGains<joint_count<R>> stiff_gains() {
  JointPidGains<joint_count<R>> gains{};
  const JointVector<joint_count<R>> limits = effort_limits(R());
  for (int j = 0; j < joint_count<R>; ++j) {
    PidGains& g = gains[static_cast<std::size_t>(j)];
    g.proportional = 2 * limits[j];
    g.integral = limits[j];
    g.derivative = 0.1 * limits[j];
    g.integral_clamp_min = -0.2 * limits[j];
    g.integral_clamp_max = 0.2 * limits[j];
  }
  return gains;
}

/// Runs random arms for a while, in lanes and one by one. Every half second each gets another
/// position to go to, beyond the stops of some.
/// @return  how often a joint was at a stop, at its effort limit, at rest
template <class R>
auto compare(unsigned seed, const Differences& by, int cycles) {
  constexpr int n = joint_count<R>;
  using Lanes = LaneLoop<R, PidPlusGravity>;
  using Hardware = Delayed<VariedRobot<R>>;
  using Alone = ControlLoop<Hardware, PidPlusGravity<R>>;
  CAPTURE(seed);
  Random random(seed);
  const auto setups = random_setups<R>(random, by);
  Lanes lanes(setups, PidPlusGravity<R, LanePack<R>>(stiff_gains<R>()));
  std::vector<Alone> alone;
  for (const auto& [robot, options, delay, lost] : setups) {
    alone.emplace_back(Hardware(Simulator<VariedRobot<R>>(robot, options), delay, lost),
                       PidPlusGravity<R>(stiff_gains<R>()));
  }
  struct {
    int at_stop = 0, at_limit = 0, at_rest = 0;
  } seen;
  for (int cycle = 0; cycle < cycles; ++cycle) {
    if (cycle % 500 == 0) {
      for (int k = 0; k < Lanes::lane_count; ++k) {
        Alone& loop = alone[static_cast<std::size_t>(k)];
        JointVector<n> wanted = loop.state().position + random.vector<n>(1.0);
        if (by.hostile) {
          for (double& x : wanted)
            x = std::array{0.0, -0.0, smallest, -1e10,
                           1e300}[static_cast<std::size_t>(random.integer(0, 4))];
        }
        loop.reference() = {.position = wanted};
        lanes.set_reference(k, {.position = wanted});
      }
    }
    lanes.update();
    for (int k = 0; k < Lanes::lane_count; ++k) {
      Alone& loop = alone[static_cast<std::size_t>(k)];
      CAPTURE(k, cycle);
      REQUIRE(loop.update() == Status::ok);
      REQUIRE(lanes.verdict(k).status == Status::ok);
      const JointState<n> own = lane_of(lanes.state(), k);
      const auto far = [](const JointVector<n>& a, const JointVector<n>& b) {
        return (a - b).cwiseAbs().maxCoeff() / (1 + b.cwiseAbs().maxCoeff());
      };
      REQUIRE(far(own.position, loop.state().position) <= tolerance);
      REQUIRE(far(own.velocity, loop.state().velocity) <= tolerance * 100);
      REQUIRE(far(lane_of(lanes.command(), k).effort, loop.command().effort) <= tolerance * 100);
      const JointState<n>& truth = loop.hardware().simulator().true_state();
      for (int j = 0; j < n; ++j) {
        const JointProperties& joint = loop.hardware().robot().joints[j];
        const double q = truth.position[j];
        seen.at_stop += q <= joint.limits.lower || q >= joint.limits.upper ? 1 : 0;
        seen.at_limit += std::abs(loop.command().effort[j]) >= joint.limits.effort ? 1 : 0;
        seen.at_rest += truth.velocity[j] == 0 ? 1 : 0;
      }
    }
  }
  return seen;
}

}  // namespace support

// SPDX-License-Identifier: Apache-2.0
#include "bridged_arm.hpp"

#include <articula/articula.hpp>
#include <articula/loop/supervision/supervised_loop.hpp>
#include <articula/remote/remote.hpp>
#include <articula/robots/q2d.hpp>

namespace support {

namespace {

using namespace articula;

using Options = remote::RemoteOptions<2>;

template <class LoopType>
class Arm final : public AnyLoop {
 public:
  template <class... Arguments>
  explicit Arm(const Options& options, Arguments&&... of_loop)
      : loop_(std::forward<Arguments>(of_loop)...), remote_(loop_, options) {}
  remote::Port& port() override { return remote_; }
  void cycles(int count) override {
    for (int k = 0; k < count; ++k) static_cast<void>(remote_.update());
  }

 private:
  LoopType loop_;
  Remote<LoopType> remote_;
};

const Options patient{.operator_lifetime = 1e9};

template <class R>
using Controllers = Switch<R, PidPlusGravity<R>, ComputedTorque<R>>;
using OneController = Switch<Q2d, PidPlusGravity<Q2d>>;
using Parts = Groups<Q2d, OneController, OneController>;

}  // namespace

std::unique_ptr<AnyLoop> switched_arm() {
  return std::make_unique<Arm<SupervisedLoop<Q2dSim, Controllers>>>(patient);
}
std::unique_ptr<AnyLoop> grouped_arm() {
  return std::make_unique<Arm<SupervisedControlLoop<Q2dSim, Parts>>>(
      patient, Q2dSim(),
      Parts({{{"upper", {shoulder_joint}}, {"lower", {elbow_joint}}}},
            articula::detail::default_controller<OneController>(),
            articula::detail::default_controller<OneController>()));
}
std::unique_ptr<AnyLoop> plain_arm() {
  Options options = patient;
  options.tolerances = {.path_position = JointVector<2>::Constant(0.5),
                        .goal_position = JointVector<2>::Constant(0.1),
                        .stopped_velocity = JointVector<2>::Constant(0.2),
                        .goal_time = 3};
  return std::make_unique<Arm<Loop<Q2dSim, PidPlusGravity>>>(options);
}
std::unique_ptr<AnyLoop> bypass_arm() {
  return std::make_unique<Arm<Loop<Q2dSim, Bypass>>>(patient);
}

}  // namespace support

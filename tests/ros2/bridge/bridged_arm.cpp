// SPDX-License-Identifier: Apache-2.0
#include "bridged_arm.hpp"

#include <articula/articula.hpp>
#include <articula/loop/supervision/supervised_loop.hpp>
#include <articula/remote/remote.hpp>
#include <articula/robots/q2d.hpp>

namespace support {

namespace {

using namespace articula;

template <class LoopType>
class Arm final : public AnyLoop {
 public:
  template <class... Arguments>
  explicit Arm(Arguments&&... of_loop) : loop_(std::forward<Arguments>(of_loop)...) {}
  remote::Port& port() override { return remote_; }
  void cycles(int count) override {
    for (int k = 0; k < count; ++k) static_cast<void>(remote_.update());
  }

 private:
  LoopType loop_;
  Remote<LoopType> remote_{loop_, {.operator_lifetime = 1e9}};
};

template <class R>
using Controllers = Switch<R, PidPlusGravity<R>, ComputedTorque<R>>;
using OneController = Switch<Q2d, PidPlusGravity<Q2d>>;
using Parts = Groups<Q2d, OneController, OneController>;

}  // namespace

std::unique_ptr<AnyLoop> switched_arm() {
  return std::make_unique<Arm<SupervisedLoop<Q2dSim, Controllers>>>();
}
std::unique_ptr<AnyLoop> grouped_arm() {
  return std::make_unique<Arm<SupervisedControlLoop<Q2dSim, Parts>>>(
      Q2dSim(), Parts({{{"upper", {shoulder_joint}}, {"lower", {elbow_joint}}}},
                      articula::detail::default_controller<OneController>(),
                      articula::detail::default_controller<OneController>()));
}
std::unique_ptr<AnyLoop> bypass_arm() { return std::make_unique<Arm<Loop<Q2dSim, Bypass>>>(); }

}  // namespace support

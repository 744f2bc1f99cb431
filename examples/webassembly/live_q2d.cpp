// SPDX-License-Identifier: Apache-2.0
// The Q2D under two controllers in a page that needs no server: the target articula_live_page.
#include <articula/articula.hpp>
#include <articula/robots/q2d.hpp>
#include <articula/view/live/live_loop.hpp>

#include <memory>

namespace {

template <class R>
using Controllers = articula::Switch<R, articula::PidPlusGravity<R>, articula::ComputedTorque<R>>;

}  // namespace

std::unique_ptr<articula::view::LiveLoop> articula::live_loop() {
  return live<SupervisedLoop<Q2dSim, Controllers>>();
}

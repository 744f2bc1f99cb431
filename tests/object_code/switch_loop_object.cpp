// SPDX-License-Identifier: Apache-2.0
#include <articula/articula.hpp>
#include <articula/robots/q2d.hpp>

using namespace articula;

template <class R>
using Both = Switch<R, PidPlusGravity<R>, ComputedTorque<R>>;
template <class R>
using Parts = Groups<R, Both<R>, Limited<R, Both<R>>>;

extern "C" bool cycle(Loop<Q2dSim, Parts>& loop, SwitchExchange<4>& exchange) noexcept {
  exchange.apply(loop.controller());
  return loop.update() == Status::ok;
}

extern "C" bool request(const SwitchRequest& request, SwitchExchange<4>& exchange) noexcept {
  const bool taken = exchange.request(request) != 0;
  while (exchange.outcome() || exchange.event()) {
  }
  return taken && exchange.list()[0].status == ControllerStatus::active;
}

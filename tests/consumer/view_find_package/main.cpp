// SPDX-License-Identifier: Apache-2.0
#include <articula/articula.hpp>
#include <articula/robots/q2d.hpp>
#include <articula/view/show.hpp>

int main() {
  articula::Loop<articula::Q2dSim, articula::PidPlusGravity> arm;
  return articula::show(arm, {.view = {.port = 0}, .run = {.cycles = 100}});
}

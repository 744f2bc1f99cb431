// SPDX-License-Identifier: Apache-2.0
// A robot with the fault that the macro BROKEN_RULE names. Without fault it compiles.
#include "robots/faulty_robots.hpp"

#include <articula/model/robot.hpp>

struct Swing {
  static constexpr auto description = support::robot_with_fault<articula::Rule::BROKEN_RULE>();
};

int main() { return articula::joint_count<Swing> - 2; }

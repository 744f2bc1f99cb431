// SPDX-License-Identifier: Apache-2.0
#include "arm.hpp"

int main() {
  Arm arm;
  return articula::show(arm, {.view = {.port = 0}, .run = {.cycles = 100}});
}

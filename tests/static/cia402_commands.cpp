// SPDX-License-Identifier: Apache-2.0
// Drives that have no mode for a command.
#include <articula/hardware/cia402/cia402_codec.hpp>
#include <articula/robots/q2d.hpp>

using namespace articula;

#ifdef SPRINGS
using Command = MultiModeCommand<2>;
#else
using Command = PositionCommand<2>;
#endif

constexpr Cia402DriveList<2> drives{
    {{.node = 1, .rated_effort = 30}, {.node = 2, .rated_effort = 15}}};

int main() {
  const Cia402Codec<Q2d, Command> codec(drives);
  return codec.subscription().identifiers.empty() ? 1 : 0;
}

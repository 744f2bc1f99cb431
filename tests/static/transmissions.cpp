// SPDX-License-Identifier: Apache-2.0
// Transmissions have to fit the robot and its actuators.
#include <articula/hardware/transmission/differential_transmission.hpp>
#include <articula/hardware/transmission/simple_transmission.hpp>
#include <articula/hardware/transmission/transmitted_hardware.hpp>
#include <articula/robots/q2d.hpp>

using namespace articula;

#ifdef ACTUATORS_OF_ANOTHER_SIZE
using Drives = Simulator<Model<3>>;
#else
using Drives = Q2dSim;
#endif
#ifdef TOO_FEW_JOINTS
using Arm = TransmittedHardware<Drives, Q2d, SimpleTransmission>;
#elif defined(TOO_MANY_JOINTS)
using Arm = TransmittedHardware<Drives, Q2d, SimpleTransmission, DifferentialTransmission>;
#elif defined(NOT_A_TRANSMISSION)
using Arm = TransmittedHardware<Drives, Q2d, PidGains, SimpleTransmission>;
#else
using Arm = TransmittedHardware<Drives, Q2d, SimpleTransmission, SimpleTransmission>;
#endif

int main() { return Arm::joint_count - 2; }

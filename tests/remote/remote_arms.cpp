// SPDX-License-Identifier: Apache-2.0
// The loops that most tests of Remote use. They take long to compile.
#include "remote/remote_arm.hpp"

template class articula::remote::Remote<
    articula::SupervisedLoop<articula::Q2dSim, articula::PidPlusGravity>>;
template class articula::remote::Remote<articula::Loop<articula::Q2dSim, articula::PidPlusGravity>>;
template class support::RemoteArm<
    articula::SupervisedLoop<articula::Q2dSim, articula::PidPlusGravity>>;
template class support::RemoteArm<articula::Loop<articula::Q2dSim, articula::PidPlusGravity>>;

// SPDX-License-Identifier: Apache-2.0
#include "arm.hpp"

template int articula::show(Arm&, const ShowOptions&, const Remote<Arm>::Options&);

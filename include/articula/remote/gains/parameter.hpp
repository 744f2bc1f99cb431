// SPDX-License-Identifier: Apache-2.0
/// @file A parameter of a controller as programs outside the loop see it.
#pragma once

#include <limits>
#include <string>

namespace articula::remote {

/// A gain of one joint of a controller. Its name is `<controller>.<joint>.<gain>`, as
/// "pid_plus_gravity.shoulder_active_joint.p".
struct Parameter {
  std::string name{};
  double value = 0;
  std::string unit{};                                        ///< as "N m/rad"
  double lowest = -std::numeric_limits<double>::infinity();  ///< of what is accepted
  double highest = std::numeric_limits<double>::infinity();
  std::string description{};  ///< one sentence
};

/// A parameter with the value that it shall get.
struct ParameterValue {
  std::string name{};
  double value = 0;
};

}  // namespace articula::remote

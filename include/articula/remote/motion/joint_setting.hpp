// SPDX-License-Identifier: Apache-2.0
/// @file References that another program sets, joint by joint.
#pragma once

#include "articula/core/joint_array.hpp"
#include "articula/core/joint_reference.hpp"

namespace articula::remote {

/// The joints whose reference another program sets, and the numbers.
/// @tparam N  number of joints
template <int N>
struct JointSetting {
  JointArray<bool, N> joints{};     ///< those that are set
  JointArray<bool, N> positions{};  ///< those whose position is set; others keep theirs
  JointReference<N> values{};
};

}  // namespace articula::remote

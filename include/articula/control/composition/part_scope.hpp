// SPDX-License-Identifier: Apache-2.0
/// @file The joints, rate and unit of a part of a controller.
#pragma once

#include "articula/core/joint_vector.hpp"

namespace articula {

/// What a composition does with the output of one of its parts; see HasParts.
/// @tparam N  number of joints
template <int N>
struct PartScope {
  JointVector<N> joints = JointVector<N>::Ones();  ///< 1 for the joints that it acts on, else 0
  int divisor = 1;                 ///< it is asked in every cycle of this number, >= 1
  bool asks_acceleration = false;  ///< its output is an acceleration, which the model turns into
                                   ///< efforts, so that every joint is an inertia of 1

  /// The scope of a part of a part. Real-time: yes.
  [[nodiscard]] PartScope of(const PartScope& inner) const noexcept {
    return {joints.cwiseProduct(inner.joints), divisor * inner.divisor,
            asks_acceleration || inner.asks_acceleration};
  }
};

}  // namespace articula

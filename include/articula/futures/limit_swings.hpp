// SPDX-License-Identifier: Apache-2.0
/// @file The sign of an unstable loop: drives that swing from limit to limit.
#pragma once

#include "articula/core/joint_vector.hpp"
#include "articula/core/scalar.hpp"

#include <cmath>

namespace articula::detail {

/// Counts how often drives swing from one effort limit to the other.
/// @tparam S  type of a number: double, or a pack with the numbers of several robots
template <int N, class S = double>
class LimitSwings {
 public:
  explicit LimitSwings(const JointVector<N, S>& limits) : limits_(limits) {}

  void note(const JointVector<N, S>& effort) noexcept {
    using std::abs;
    for (int j = 0; j < N; ++j) {
      const MaskOf<S> at_limit = abs(effort[j]) >= limits_[j];
      if (!any_of(at_limit)) continue;
      const S side = select(effort[j] > 0, S(1), S(-1));
      replace_where(at_limit & (sides_[j] * side < 0), swings_[j], swings_[j] + 1);
      replace_where(at_limit, sides_[j], side);
    }
  }
  /// A motion from rest to rest needs one swing.
  [[nodiscard]] MaskOf<S> many() const noexcept {
    MaskOf<S> any = mask_of<S>(false);
    for (int j = 0; j < N; ++j) any = any | (swings_[j] >= 4);
    return any;
  }

 private:
  JointVector<N, S> limits_;
  JointVector<N, S> sides_ = JointVector<N, S>::Zero();
  JointVector<N, S> swings_ = JointVector<N, S>::Zero();
};

}  // namespace articula::detail

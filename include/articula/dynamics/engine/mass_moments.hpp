// SPDX-License-Identifier: Apache-2.0
/// @file The mass distribution of a body by its moments.
#pragma once

#include "articula/model/inertia.hpp"

namespace articula {

/// The mass distribution of a body by its moments about the origin of a frame. The second moment
/// turns and shifts independently of its trace, unlike the inertia. Its part along the joint's axis
/// is zero in a canonical mechanism.
template <class S>
struct MassMoments {
  S mass = S(0.0);         ///< m [kg]
  Vector3<S> first{};      ///< h = integral of r dm [kg m], 3 x 1
  Symmetric3<S> second{};  ///< J = integral of r r^T dm = trace(I)/2 1 - I [kg m^2], 3 x 3

  friend constexpr MassMoments operator+(const MassMoments& a, const MassMoments& b) noexcept {
    return {a.mass + b.mass, a.first + b.first, a.second + b.second};
  }
};

/// The moments of an inertia.
template <class S>
[[nodiscard]] constexpr MassMoments<S> moments_of(const Inertia<double>& inertia) noexcept {
  const Symmetric3<double>& i = inertia.moment;
  return {S(inertia.mass),
          constant<S>(inertia.first_moment),
          {S((i.yy + i.zz - i.xx) / 2), S(-i.xy), S(-i.xz), S((i.xx + i.zz - i.yy) / 2), S(-i.yz),
           S((i.xx + i.yy - i.zz) / 2)}};
}

}  // namespace articula

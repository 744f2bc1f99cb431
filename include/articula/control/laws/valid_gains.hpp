// SPDX-License-Identifier: Apache-2.0
/// @file Validated gains of all joints.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <string_view>

namespace articula {

/// The names of N joints.
template <int N>
using JointNames = std::array<std::string_view, static_cast<std::size_t>(N)>;

/// The gains of N joints, checked as a whole. To have one is to have good gains, so that a
/// controller can take it over in mid-run without a look.
/// @tparam G  the gains of one joint; `validate(gains, names)` refuses bad ones
/// @tparam N  number of joints
template <class G, int N>
class ValidGains {
 public:
  using Values = std::array<G, static_cast<std::size_t>(N)>;

  /// All gains as G has them by default.
  ValidGains() = default;

  /// @param gains  of the N joints
  /// @param names  of the same joints, for the error message
  /// @throws std::invalid_argument as `validate` does, naming joint, gain and value
  ValidGains(const Values& gains, const JointNames<N>& names) : values_(gains) {
    validate(gains, names);
  }

  /// The gains of one joint. Real-time: yes.
  [[nodiscard]] const G& operator[](std::integral auto joint) const noexcept {
    return values_[static_cast<std::size_t>(joint)];
  }
  /// Those of all joints. Real-time: yes.
  [[nodiscard]] const Values& values() const noexcept { return values_; }

 private:
  Values values_{};
};

}  // namespace articula

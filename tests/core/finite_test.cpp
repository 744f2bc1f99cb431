// SPDX-License-Identifier: Apache-2.0
#include "catch.hpp"

#include <articula/core/finite.hpp>

#include <bit>
#include <cstdint>

using namespace articula;

namespace {

/// Writes these bits over a number, at run time.
void overwrite(double& x, std::uint64_t bits) { x = std::bit_cast<double>(bits); }

constexpr std::uint64_t sign = 0x8000'0000'0000'0000U;
constexpr std::uint64_t hostile_bits[] = {
    0x7ff0'0000'0000'0000U,  // infinity
    0x7ff8'0000'0000'0000U,  // quiet NaN
    0x7ff0'0000'0000'0001U,  // signalling NaN
    0x7fff'ffff'ffff'ffffU,
};
constexpr std::uint64_t calm_bits[] = {
    0,                       // zero
    1,                       // smallest
    0x000f'ffff'ffff'ffffU,  // largest subnormal
    0x3ff0'0000'0000'0000U,  // one
    0x7fef'ffff'ffff'ffffU,  // largest
};

/// Spoils each of the N x 1 members one element at a time.
template <class T, class... Members>
void check_members(Members... members) {
  const auto check = [](auto member) {
    for (std::uint64_t bits : hostile_bits) {
      T value;
      CHECK(is_finite(value));
      for (int i = 0; i < T::joint_count; ++i) {
        value = T{};
        overwrite((value.*member)[i], bits);
        CAPTURE(bits, i);
        CHECK_FALSE(is_finite(value));
      }
    }
  };
  (check(members), ...);
}

}  // namespace

static_assert(is_finite(0) && is_finite(-1e308));
static_assert(!is_finite(std::bit_cast<double>(hostile_bits[0])));
static_assert(!is_finite(std::bit_cast<double>(hostile_bits[1] | sign)));

TEST_CASE("is_finite of a number") {
  double x = 0;
  for (std::uint64_t bits : calm_bits) {
    CAPTURE(bits);
    overwrite(x, bits);
    CHECK(is_finite(x));
    overwrite(x, bits | sign);
    CHECK(is_finite(x));
  }
  for (std::uint64_t bits : hostile_bits) {
    CAPTURE(bits);
    overwrite(x, bits);
    CHECK_FALSE(is_finite(x));
    overwrite(x, bits | sign);
    CHECK_FALSE(is_finite(x));
  }
}

TEST_CASE("is_finite of what is measured, asked for and sent sees every element") {
  using State = JointState<3>;
  check_members<State>(&State::position, &State::velocity, &State::effort);
  using Reference = JointReference<3>;
  check_members<Reference>(&Reference::position, &Reference::velocity, &Reference::acceleration,
                           &Reference::effort);
  check_members<EffortCommand<3>>(&EffortCommand<3>::effort);
  check_members<PositionCommand<3>>(&PositionCommand<3>::position);
  check_members<VelocityCommand<3>>(&VelocityCommand<3>::velocity);
}

TEST_CASE("is_finite of a vector sees every element") {
  for (int i = 0; i < 4; ++i) {
    JointVector<4> vector = JointVector<4>::Zero();
    CHECK(is_finite(vector));
    overwrite(vector[i], hostile_bits[1]);
    CHECK_FALSE(is_finite(vector));
  }
}

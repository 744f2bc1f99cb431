// SPDX-License-Identifier: Apache-2.0
// Packs of several registers: each lane has the bits that it has in a pack of one register.
#include "catch.hpp"
#include "numbers.hpp"
#include "random.hpp"

#include <articula/core/scalar.hpp>
#include <articula/symbolic/pack.hpp>
#include <articula/symbolic/wide_pack.hpp>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

using namespace articula;
using symbolic::Pack;
using symbolic::WidePack;

namespace {

constexpr int registers = 3;
using Wide = WidePack<registers>;
constexpr int lanes_of_register = Pack<>::lanes;

/// Numbers of all sizes, zeros, infinities and NaN among them.
Wide hostile_numbers(support::Random& random) {
  Wide numbers(0);
  for (int k = 0; k < Wide::lanes; ++k) {
    const std::array special{0.0,
                             -0.0,
                             support::infinity,
                             -support::infinity,
                             support::not_a_number,
                             1e300,
                             support::smallest,
                             1.0};
    const auto place = static_cast<std::size_t>(random.integer(0, 15));
    numbers.set(k, place < special.size() ? special[place] : random.number(-10, 10));
  }
  return numbers;
}

/// The numbers of one register.
Pack<> register_of(const Wide& wide, int i) {
  Pack<> pack(0);
  for (int k = 0; k < lanes_of_register; ++k) pack.set(k, wide[i * lanes_of_register + k]);
  return pack;
}

/// Whether two numbers have the same bits, or both are NaN: its sign is not defined.
bool same(double a, double b) {
  return (a != a && b != b) || std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// Compares f of wide packs with f of the packs of their registers.
template <class Function>
void compare(const Function& f, const auto&... wide) {
  const Wide together = f(wide...);
  for (int i = 0; i < registers; ++i) {
    const Pack<> alone = f(register_of(wide, i)...);
    for (int k = 0; k < lanes_of_register; ++k) {
      CAPTURE(i, k);
      REQUIRE(same(together[i * lanes_of_register + k], alone[k]));
    }
  }
}

}  // namespace

TEST_CASE("Wide packs compute in each lane as packs of one register do") {
  const unsigned seed = 1;
  CAPTURE(seed);
  support::Random random(seed);
  for (int round = 0; round < 1000; ++round) {
    const Wide a = hostile_numbers(random), b = hostile_numbers(random);
    compare([](const auto& x, const auto& y) { return x + y; }, a, b);
    compare([](const auto& x, const auto& y) { return x - y; }, a, b);
    compare([](const auto& x, const auto& y) { return x * y; }, a, b);
    compare([](const auto& x, const auto& y) { return x / y; }, a, b);
    compare([](auto x, const auto& y) { return x += y, x *= y, x -= 2.0, x; }, a, b);
    compare([](const auto& x) { return -x; }, a);
    compare([](const auto& x) { return abs(x); }, a);
    compare([](const auto& x) { return sqrt(abs(x)); }, a);
    compare([](const auto& x) { return sin(x); }, a);
    compare([](const auto& x) { return cos(x); }, a);
  }
}

TEST_CASE("Masks of wide packs are those of their registers") {
  const unsigned seed = 2;
  CAPTURE(seed);
  support::Random random(seed);
  const auto chosen = [](const auto& mask, const auto& x, const auto& y) {
    return select(mask, x, y);
  };
  for (int round = 0; round < 1000; ++round) {
    const Wide a = hostile_numbers(random), b = hostile_numbers(random);
    compare([&](const auto& x, const auto& y) { return chosen(x < y, x, y); }, a, b);
    compare([&](const auto& x, const auto& y) { return chosen(x <= y, x, y); }, a, b);
    compare([&](const auto& x, const auto& y) { return chosen(x > y, x, y); }, a, b);
    compare([&](const auto& x, const auto& y) { return chosen(x >= y, x, y); }, a, b);
    compare([&](const auto& x, const auto& y) { return chosen(x == y, x, y); }, a, b);
    compare([&](const auto& x, const auto& y) { return chosen(x != y, x, y); }, a, b);
    compare([&](const auto& x, const auto& y) { return chosen(!is_finite(x), x, y); }, a, b);
    compare([&](const auto& x, const auto& y) { return chosen((x < y) & (x > 0), x, y); }, a, b);
    compare([&](const auto& x, const auto& y) { return chosen((x < y) | (x > 0), x, y); }, a, b);
    compare([&](const auto& x, const auto& y) { return chosen((x < y) ^ (x > 0), x, y); }, a, b);
    compare([&](const auto& x, const auto& y) { return chosen(not_of(x < y), x, y); }, a, b);
  }
}

TEST_CASE("A mask of several registers is asked about any, all and single lanes") {
  for (int lane = 0; lane < Wide::lanes; ++lane) {
    MaskOf<Wide> mask = mask_of<Wide>(false);
    CHECK_FALSE(any_of(mask));
    set_truth(mask, lane, true);
    CHECK(any_of(mask));
    CHECK_FALSE(all_of(mask));
    for (int k = 0; k < Wide::lanes; ++k) CHECK(is_true(mask, k) == (k == lane));
    mask |= mask_of<Wide>(true);
    CHECK(all_of(mask));
    set_truth(mask, lane, false);
    CHECK_FALSE(all_of(mask));
    CHECK(any_of(mask));
    mask &= not_of(mask);
    CHECK_FALSE(any_of(mask));
  }
}

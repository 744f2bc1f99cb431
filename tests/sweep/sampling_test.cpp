// SPDX-License-Identifier: Apache-2.0
#include <articula/sim/philox.hpp>
#include <articula/sweep/sampling/samples.hpp>

#include "catch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

using namespace articula;
using detail::philox;

// The vectors of Random123's kat_vectors for philox4x32 with ten rounds.
static_assert(philox({0, 0, 0, 0}, {0, 0}) ==
              detail::PhiloxCounter{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8});
static_assert(philox({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, {0xffffffff, 0xffffffff}) ==
              detail::PhiloxCounter{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd});
static_assert(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}) ==
              detail::PhiloxCounter{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1});

namespace {

std::vector<SweepParameter> unit_parameters(int count) {
  std::vector<SweepParameter> parameters;
  for (int k = 0; k < count; ++k) parameters.push_back({"p" + std::to_string(k), "1", 0, 1});
  return parameters;
}
/// How often each of `parts` equal parts of 0 .. 1 has a parameter's value.
std::vector<int> counts(const Samples& samples, std::size_t parameter, int parts) {
  std::vector<int> count(static_cast<std::size_t>(parts));
  std::vector<double> values(samples.parameters().size());
  for (std::uint64_t run = 0; run < samples.runs(); ++run) {
    samples.values(run, values);
    REQUIRE(values[parameter] >= 0);
    REQUIRE(values[parameter] < 1);
    ++count[static_cast<std::size_t>(values[parameter] * parts)];
  }
  return count;
}
bool are_all(const std::vector<int>& counts, int value) {
  return std::all_of(counts.begin(), counts.end(), [&](int count) { return count == value; });
}
/// The error of the mean of a product of all parameters, whose true mean is 2^-count.
double error_of_mean(SamplingMethod method, int count, std::uint64_t runs) {
  const Samples samples(unit_parameters(count), {method, runs, 5});
  std::vector<double> values(samples.parameters().size());
  double sum = 0;
  for (std::uint64_t run = 0; run < runs; ++run) {
    samples.values(run, values);
    double product = 1;
    for (const double value : values) product *= value;
    sum += product;
  }
  return std::abs(sum / static_cast<double>(runs) - std::ldexp(1, -count));
}

}  // namespace

TEST_CASE("a keyed permutation has every number once, in an order of its key") {
  for (const std::uint64_t count : {1ULL, 2ULL, 3ULL, 17ULL, 256ULL, 1000ULL}) {
    const detail::KeyedPermutation one(count, 1), other(count, 2);
    std::vector<std::uint64_t> seen, beside;
    for (std::uint64_t k = 0; k < count; ++k) {
      seen.push_back(one(k));
      beside.push_back(other(k));
    }
    if (count > 10) {
      CHECK(seen != beside);
      CHECK_FALSE(std::is_sorted(seen.begin(), seen.end()));
    }
    std::sort(seen.begin(), seen.end());
    for (std::uint64_t k = 0; k < count; ++k) REQUIRE(seen[k] == k);
  }
}

TEST_CASE("a Latin hypercube has one run in each part of each range") {
  for (const int runs : {1, 7, 1000}) {
    const Samples samples(unit_parameters(4),
                          {SamplingMethod::latin_hypercube, static_cast<std::uint64_t>(runs), 3});
    for (std::size_t p = 0; p < 4; ++p) CHECK(are_all(counts(samples, p, runs), 1));
  }
  const Samples random(unit_parameters(1), {SamplingMethod::random, 1000, 3});
  CHECK_FALSE(are_all(counts(random, 0, 1000), 1));
}

TEST_CASE("Sobol's sequence has one of its first 2^m runs in each part of each range") {
  const Samples samples(unit_parameters(6), {SamplingMethod::sobol, 1024, 3});
  for (std::size_t p = 0; p < 6; ++p) CHECK(are_all(counts(samples, p, 1024), 1));
  // The first two directions are a (0, 2)-sequence: one run in each of 32 by 32 squares.
  std::vector<int> squares(1024);
  std::vector<double> values(6);
  for (std::uint64_t run = 0; run < 1024; ++run) {
    samples.values(run, values);
    ++squares[static_cast<std::size_t>(values[0] * 32) * 32 +
              static_cast<std::size_t>(values[1] * 32)];
  }
  CHECK(are_all(squares, 1));
}

TEST_CASE("even samples give a mean with less error than random ones") {
  const double random = error_of_mean(SamplingMethod::random, 3, 4096);
  CHECK(random < 0.01);
  CHECK(error_of_mean(SamplingMethod::latin_hypercube, 3, 4096) < 0.003);
  CHECK(error_of_mean(SamplingMethod::sobol, 3, 4096) < 0.0005);
}

TEST_CASE("a grid has all combinations; the last parameter changes fastest") {
  auto parameters = unit_parameters(3);
  parameters[0].levels = 2;
  parameters[1].levels = 1;
  parameters[2] = {"ratio", "1", 1, 100, Spacing::logarithmic, 3};
  const Samples samples(parameters, {SamplingMethod::grid});
  REQUIRE(samples.runs() == 6);
  std::vector<double> values(3);
  const double ratios[] = {1, 10, 100};
  for (std::uint64_t run = 0; run < 6; ++run) {
    samples.values(run, values);
    CHECK(values[0] == (run < 3 ? 0 : 1));
    CHECK(values[1] == 0.5);
    CHECK(values[2] == Approx(ratios[run % 3]));
  }
}

TEST_CASE("parameters that make no sweep are refused") {
  const auto samples = [](std::vector<SweepParameter> parameters) {
    return Samples(std::move(parameters), {SamplingMethod::grid});
  };
  CHECK_THROWS_WITH(samples({{"a", "1", 0, 1}, {"a", "1", 0, 2}}), Catch::Contains("two param"));
  CHECK_THROWS_WITH(samples({{"a", "1", 0, 1, Spacing::logarithmic}}), Catch::Contains("above 0"));
  CHECK_THROWS_WITH(samples({{"a", "1", 0, std::numeric_limits<double>::infinity()}}),
                    Catch::Contains("not finite"));
  CHECK_THROWS_WITH(samples({{"a", "1", 0, 1, Spacing::linear, 0}}), Catch::Contains("levels 0"));
  CHECK_THROWS_WITH(samples({{"a", "1", 0, 1, Spacing::linear, 1000000},
                             {"b", "1", 0, 1, Spacing::linear, 1000000},
                             {"c", "1", 0, 1, Spacing::linear, 1000000}}),
                    Catch::Contains("more than"));
}

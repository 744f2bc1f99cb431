// SPDX-License-Identifier: Apache-2.0
/// @file The parameters of each run of a sweep. Needs the CMake target articula::sweep (Boost).
#pragma once

#include "articula/core/refuse.hpp"
#include "articula/sim/random_draw.hpp"
#include "articula/sweep/sampling/keyed_permutation.hpp"
#include "articula/sweep/sampling/sweep_parameter.hpp"

#include <boost/random/sobol.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace articula {

/// How the parameters of the runs are chosen.
enum class SamplingMethod : unsigned char {
  grid,             ///< all combinations of the parameters' levels; the last one changes fastest
  random,           ///< independent random values
  latin_hypercube,  ///< each of `runs` equal parts of each range occurs once
  sobol,            ///< Sobol's sequence with a random shift; even in every direction
};

/// Which runs a sweep has.
struct Sampling {
  SamplingMethod method = SamplingMethod::random;
  std::uint64_t runs = 1000;  ///< not used by a grid, whose levels tell
  std::uint64_t seed = 1;     ///< the same seed gives the same runs, to the last bit
};

/// The parameters of all runs. Those of a run depend on sampling and number alone. So runs may be
/// computed in any order and in any number of threads and processes.
class Samples {
 public:
  static constexpr std::uint64_t most_runs = std::uint64_t{1} << 40;

  /// @throws std::invalid_argument naming parameter or option, its value and what is accepted
  Samples(std::vector<SweepParameter> parameters, const Sampling& sampling)
      : parameters_(std::move(parameters)), sampling_(sampling) {
    for (std::size_t p = 0; p < parameters_.size(); ++p) {
      validate(parameters_[p]);
      for (std::size_t other = 0; other < p; ++other) {
        if (parameters_[other].name != parameters_[p].name) continue;
        detail::refuse({"sweep: two parameters have the name '", parameters_[p].name, "'"});
      }
    }
    if (sampling_.method > SamplingMethod::sobol)
      detail::refuse({"sweep: no such sampling method"});
    if (sampling_.method == SamplingMethod::grid) sampling_.runs = grid_size();
    if (sampling_.runs < 1 || sampling_.runs > most_runs) {
      detail::refuse({"sweep: runs ", sampling_.runs, " are not within 1 .. ", most_runs});
    }
    if (sampling_.method == SamplingMethod::sobol && !parameters_.empty()) {
      sobol_.emplace(parameters_.size());
    }
  }

  [[nodiscard]] std::uint64_t runs() const noexcept { return sampling_.runs; }
  [[nodiscard]] const Sampling& sampling() const noexcept { return sampling_; }
  [[nodiscard]] const std::vector<SweepParameter>& parameters() const noexcept {
    return parameters_;
  }

  /// The values of a run's parameters.
  /// @param run     0 .. runs() - 1
  /// @param values  receives them, one for each parameter
  /// Real-time: no (Sobol's sequence allocates).
  void values(std::uint64_t run, std::span<double> values) const {
    if (sampling_.method == SamplingMethod::grid) {
      for (std::size_t p = parameters_.size(); p-- > 0;) {
        const auto levels = static_cast<std::uint64_t>(parameters_[p].levels);
        const double level = static_cast<double>(run % levels);
        values[p] =
            parameters_[p].value(levels == 1 ? 0.5 : level / static_cast<double>(levels - 1));
        run /= levels;
      }
      return;
    }
    auto sobol = sobol_;
    if (sobol && run > 0) sobol->seed(run - 1);  // Boost leaves the point 0 out
    for (std::size_t p = 0; p < parameters_.size(); ++p) {
      const auto place = static_cast<std::uint32_t>(p);
      const std::uint64_t own = detail::random_bits(sampling_.seed, run, place);
      double share = detail::share_of_bits(own);
      if (sampling_.method == SamplingMethod::latin_hypercube) {
        const detail::KeyedPermutation order(sampling_.runs, key_of(place));
        share = (static_cast<double>(order(run)) + share) / static_cast<double>(sampling_.runs);
      } else if (sobol) {
        share = detail::share_of_bits((run == 0 ? 0 : (*sobol)()) ^ key_of(place));
      }
      values[p] = parameters_[p].value(share);
    }
  }

  /// The seed of a run's sensors and of all else in it that is random. Real-time: yes.
  [[nodiscard]] std::uint64_t seed(std::uint64_t run) const noexcept {
    return detail::random_bits(sampling_.seed, run, 0, of_noise);
  }

 private:
  static constexpr std::uint32_t of_noise = 1, of_parameters = 2;  // places in Philox's counter

  [[nodiscard]] std::uint64_t key_of(std::uint32_t parameter) const noexcept {
    return detail::random_bits(sampling_.seed, parameter, 0, of_parameters);
  }
  [[nodiscard]] std::uint64_t grid_size() const {
    std::uint64_t size = 1;
    for (const SweepParameter& parameter : parameters_) {
      const auto levels = static_cast<std::uint64_t>(parameter.levels);
      if (size > most_runs / levels) {
        detail::refuse({"sweep: the grid has more than ", most_runs, " runs"});
      }
      size *= levels;
    }
    return size;
  }

  std::vector<SweepParameter> parameters_;
  Sampling sampling_;
  std::optional<boost::random::sobol> sobol_{};
};

}  // namespace articula

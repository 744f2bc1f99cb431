// SPDX-License-Identifier: Apache-2.0
/// @file A search of parameters that make a sweep's result best. Needs the CMake target
/// articula::sweep_search (NLopt).
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/refuse.hpp"
#include "articula/sweep/sampling/sweep_parameter.hpp"
#include "articula/sweep/sweep.hpp"

#include <nlopt.h>

#include <cstddef>
#include <exception>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace articula {

/// What to search, and for how long.
struct SearchOptions {
  std::vector<SweepParameter> parameters{};  ///< with their ranges
  int evaluations = 200;                     ///< of the cost at most, 2 .. 1 000 000
};

/// What a search has found.
struct SearchResult {
  std::vector<double> parameters{};  ///< the best ones
  double cost = std::numeric_limits<double>::infinity();
  int evaluations = 0;
};

namespace detail {

/// A cost over the unit cube, for NLopt, with the best point so far.
struct SearchedCost {
  const std::vector<SweepParameter>& parameters;
  const std::function<double(const std::vector<double>&)>& cost;
  SearchResult best{};
  std::exception_ptr thrown{};
  nlopt_opt optimiser = nullptr;

  static double evaluate(unsigned count, const double* point, double*, void* data) {
    auto& own = *static_cast<SearchedCost*>(data);
    std::vector<double> values(count);
    for (unsigned p = 0; p < count; ++p) values[p] = own.parameters[p].value(point[p]);
    double cost = std::numeric_limits<double>::infinity();
    try {
      cost = own.cost(values);
    } catch (...) {  // NLopt is a library of C
      own.thrown = std::current_exception();
      nlopt_force_stop(own.optimiser);
    }
    ++own.best.evaluations;
    if (own.best.parameters.empty() || cost < own.best.cost) {
      own.best.cost = cost;
      own.best.parameters = std::move(values);
    }
    constexpr double worst = 1e300;  // an infinite one would spoil interpolations
    return is_finite(cost) ? cost : worst;
  }
};

}  // namespace detail

/// Minimises a cost by NLopt's DIRECT-L, and then by its BOBYQA from the best point (Powell, 2009).
/// DIRECT-L needs no derivatives and searches the whole range (Gablonsky, Kelley: A locally-biased
/// form of the DIRECT algorithm, 2001). The cost is usually a quantile over a sweep:
///
///     const SearchResult best = search_gains(options, [&](const std::vector<double>& gains) {
///       return sweep(experiment_with(gains), runs).summary("elbow.settling_time").quantile(0.95);
///     });
///
/// All sweeps of a search should have the same seed: their arms are the same, so the cost is a
/// function of the gains alone. An infinite cost is allowed, such as a quantile that is undefined.
/// @param options  the parameters; logarithmic ones are searched by their logarithm
/// @param cost     of values of the parameters
/// @throws std::invalid_argument if an option is out of range; what the cost throws
/// Real-time: no (allocates, throws).
[[nodiscard]] inline SearchResult search_gains(
    const SearchOptions& options, const std::function<double(const std::vector<double>&)>& cost) {
  constexpr int least = 2, most = 1'000'000;
  if (options.evaluations < least || options.evaluations > most) {
    detail::refuse(
        {"search: evaluations ", options.evaluations, " are not within ", least, " .. ", most});
  }
  if (options.parameters.empty()) detail::refuse({"search: there are no parameters"});
  for (const SweepParameter& parameter : options.parameters) validate(parameter);
  const auto size = static_cast<unsigned>(options.parameters.size());
  detail::SearchedCost searched{options.parameters, cost};
  const auto run = [&](nlopt_algorithm algorithm, int evaluations, std::vector<double> point) {
    const std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> optimiser(nlopt_create(algorithm, size),
                                                                      nlopt_destroy);
    searched.optimiser = optimiser.get();
    double lowest = 0;
    nlopt_set_lower_bounds1(optimiser.get(), 0);
    nlopt_set_upper_bounds1(optimiser.get(), 1);
    nlopt_set_min_objective(optimiser.get(), detail::SearchedCost::evaluate, &searched);
    nlopt_set_maxeval(optimiser.get(), evaluations);
    nlopt_set_xtol_abs1(optimiser.get(), 1e-6);
    nlopt_set_initial_step1(optimiser.get(), 0.05);
    static_cast<void>(nlopt_optimize(optimiser.get(), point.data(), &lowest));
    if (searched.thrown) std::rethrow_exception(searched.thrown);
  };
  const int wide = (2 * options.evaluations + 2) / 3;
  run(NLOPT_GN_DIRECT_L, wide, std::vector<double>(size, 0.5));
  const int left = options.evaluations - searched.best.evaluations;
  if (left > 0 && size > 1) {
    std::vector<double> point;
    for (std::size_t p = 0; p < size; ++p) {
      point.push_back(options.parameters[p].share(searched.best.parameters[p]));
    }
    run(NLOPT_LN_BOBYQA, left, point);
  }
  return searched.best;
}

}  // namespace articula

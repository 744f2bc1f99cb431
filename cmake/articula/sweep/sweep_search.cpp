// SPDX-License-Identifier: Apache-2.0
/// @file The search of a sweep from a file.
#include "sweep_plan.hpp"

#include <articula/model/build_model.hpp>
#include <articula/sweep/sweep.hpp>
#include <articula/text/numbers.hpp>
#ifdef ARTICULA_PROGRAM_HAS_SEARCH
#include <articula/sweep/search_gains.hpp>
#endif

#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace terminal {

namespace {

template <int... Joints>
AnyExperiment experiment_of_size(int joints, const SweepPlan& plan,
                                 std::integer_sequence<int, Joints...>) {
  AnyExperiment experiment;
  static_cast<void>(
      ((joints == Joints && (experiment = make_experiment<Joints>(plan), true)) || ...));
  return experiment;
}

#ifdef ARTICULA_PROGRAM_HAS_SEARCH
/// The plan with values in place of the ranges that are searched.
SweepPlan with_values(SweepPlan plan, const std::vector<double>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    articula::Variation fixed = plan.search.over[i];
    fixed.low = fixed.high = values[i];
    fixed.levels = 1;
    plan.vary.push_back(fixed);
  }
  return plan;
}

/// The seed is another than that of the plan's sweep, which judges the result by other arms. All
/// costs of a search have the same arms.
double cost_of(const SweepPlan& plan) {
  articula::SweepOptions options = plan.options;
  ++options.sampling.seed;
  const articula::SweepResult result = articula::sweep(experiment_of(plan), options);
  const auto runs = static_cast<double>(result.runs());
  const double stable = static_cast<double>(result.runs_with(articula::SimulationEnd::stable));
  // As the rank of the quantile: up to this share of the runs may do anything.
  if (stable < std::floor(plan.search.quantile * (runs - 1)) + 1) {
    return std::numeric_limits<double>::infinity();
  }
  return result.summary(plan.search.metric).quantile(plan.search.quantile);
}
#endif

}  // namespace

AnyExperiment experiment_of(const SweepPlan& plan) {
  if (plan.compiled != nullptr) {
    const std::unique_ptr<AnyExperiment> made(plan.compiled(plan.loop()));
    return *made;
  }
  const int joints = articula::model_size((*plan.robot)->joints).joints;
  return experiment_of_size(joints, plan, std::integer_sequence<int, ARTICULA_SWEPT_JOINTS>{});
}

#ifdef ARTICULA_PROGRAM_HAS_SEARCH
SearchedPlan search_sweep(SweepPlan plan) {
  using Clock = std::chrono::steady_clock;
  articula::SearchOptions options{.parameters = {}, .evaluations = plan.search.evaluations};
  for (const articula::Variation& own : plan.search.over) {
    options.parameters.push_back(own.parameter());
  }
  // All tries have the metrics of the plan itself.
  const std::vector<articula::SweepMetric> metrics = experiment_of(plan).metrics();
  std::string last_refusal;
  int evaluations = 0;
  double lowest = std::numeric_limits<double>::infinity();
  bool is_shown = false;
  auto next = Clock::now() + std::chrono::seconds(1);
  const articula::SearchResult best =
      articula::search_gains(options, [&](const std::vector<double>& values) {
        double cost = std::numeric_limits<double>::infinity();
        try {
          cost = cost_of(with_values(plan, values));
        } catch (const std::invalid_argument& error) {  // this loop cannot be simulated
          last_refusal = "; the last refusal was: " + std::string(error.what());
        }
        lowest = std::fmin(lowest, cost);
        ++evaluations;
        if (const auto now = Clock::now(); now >= next) {
          next = now + std::chrono::milliseconds(500);
          is_shown = true;
          std::fprintf(stderr, "\rsearch: %d of at most %d evaluations, the lowest cost is %g    ",
                       evaluations, options.evaluations, lowest);
        }
        return cost;
      });
  if (is_shown) std::fprintf(stderr, "\n");
  std::string unit;
  for (const articula::SweepMetric& each : metrics) {
    if (each.name == plan.search.metric && each.unit != "1") unit = " " + each.unit;
  }
  const std::string what = plan.search.metric + " at the quantile " +
                           articula::detail::number_text(plan.search.quantile);
  if (!std::isfinite(best.cost)) {
    throw Refusal("search: none of " + std::to_string(best.evaluations) + " tries has a finite " +
                  what + "; other ranges may have" + last_refusal);
  }
  SearchedPlan searched;
  Json parameters = Json::object();
  std::string found;
  for (std::size_t i = 0; i < best.parameters.size(); ++i) {
    const std::string& name = options.parameters[i].name;
    parameters[name] = best.parameters[i];
    found += ", " + name + " " + articula::detail::rounded_text(best.parameters[i]);
  }
  searched.line = "search: " + what + " is " + articula::detail::rounded_text(best.cost) + unit +
                  " after " + std::to_string(best.evaluations) + " evaluations" + found;
  searched.json = {{"metric", plan.search.metric},
                   {"quantile", plan.search.quantile},
                   {"cost", best.cost},
                   {"evaluations", best.evaluations},
                   {"parameters", parameters}};
  searched.plan = with_values(std::move(plan), best.parameters);
  return searched;
}
#else
SearchedPlan search_sweep(SweepPlan) {
  throw Refusal("search: this program was built without NLopt (Debian: libnlopt-dev)");
}
#endif

}  // namespace terminal

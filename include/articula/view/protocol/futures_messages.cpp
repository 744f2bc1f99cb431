// SPDX-License-Identifier: Apache-2.0
#include "articula/view/protocol/futures_messages.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace articula::view {

namespace {

constexpr std::array shares{0.0, 0.1, 0.5, 0.9, 1.0};  // of the futures below a quantile
constexpr std::size_t most_curves = 8;

/// Seven digits, more than a plot shows; null if it is not finite.
Json number(double x) {
  if (!std::isfinite(x)) return nullptr;
  const double unit = x == 0 ? 1 : std::pow(10.0, 6 - std::floor(std::log10(std::abs(x))));
  return std::isfinite(unit) && unit > 0 ? std::round(x * unit) / unit : x;
}

/// The quantiles at each sample that any future has reached.
Json quantiles(const remote::FuturesAnswer& answer, std::size_t joint) {
  Json bands = Json::array();
  for (std::size_t band = 0; band < shares.size(); ++band) bands.push_back(Json::array());
  std::vector<double> values;
  for (std::size_t sample = 0;; ++sample) {
    values.clear();
    for (const remote::FutureTrajectory& future : answer.futures) {
      const std::vector<double>& own = future.positions[joint];
      if (sample < own.size() && std::isfinite(own[sample])) values.push_back(own[sample]);
    }
    if (values.empty()) return bands;
    std::sort(values.begin(), values.end());
    for (std::size_t band = 0; band < shares.size(); ++band) {
      const double place = shares[band] * static_cast<double>(values.size() - 1);
      bands[band].push_back(number(values[static_cast<std::size_t>(std::lround(place))]));
    }
  }
}

}  // namespace

Asked read_futures(const Json& call) {
  remote::FuturesQuestion question;
  if (const auto gains = call.find("gains"); gains != call.end()) {
    for (const auto& [name, value] : gains->items()) {
      question.gains.push_back({name, value.get<double>()});
    }
  }
  FutureOptions& options = question.options;
  FutureSpread& spread = options.spread;
  options.count = call.value("count", options.count);
  options.horizon = call.value("horizon", options.horizon);
  options.samples = call.value("samples", options.samples);
  options.seed = static_cast<std::uint64_t>(call.value("seed", std::int64_t{1}));
  spread.mass = call.value("mass", spread.mass);
  spread.friction = call.value("friction", spread.friction);
  spread.delay = call.value("delay", spread.delay);
  spread.position_noise = call.value("position_noise", spread.position_noise);
  spread.velocity_noise = call.value("velocity_noise", spread.velocity_noise);
  return question;
}

Json futures_json(const remote::FuturesAnswer& answer, const remote::RobotSheet& robot) {
  const auto ended = [&](FutureEnd end) {
    return std::count_if(answer.futures.begin(), answer.futures.end(),
                         [&](const auto& future) { return future.end == end; });
  };
  Json json = {{"time", answer.time},
               {"horizon", answer.horizon},
               {"samples", answer.samples},
               {"count", answer.futures.size()},
               {"unstable", ended(FutureEnd::unstable)},
               {"non_finite", ended(FutureEnd::non_finite)},
               {"shares", shares},
               {"joints", Json::array()},
               {"margins", Json::array()}};
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    Json curves = Json::array();
    for (std::size_t k = 0; k < std::min(most_curves, answer.futures.size()); ++k) {
      Json& curve = curves.emplace_back(Json::array());
      for (const double q : answer.futures[k].positions[j]) curve.push_back(number(q));
    }
    json["joints"].push_back(
        {{"name", robot.joints[j].name}, {"quantiles", quantiles(answer, j)}, {"curves", curves}});
  }
  for (const remote::JointMargins& margins : answer.margins) {
    json["margins"].push_back({{"controller", margins.controller},
                               {"joint", margins.joint},
                               {"stable", margins.stable},
                               {"gain_margin", number(margins.gain_margin)},
                               {"phase_margin", number(margins.phase_margin)},
                               {"delay_margin", number(margins.delay_margin)}});
  }
  return json;
}

}  // namespace articula::view

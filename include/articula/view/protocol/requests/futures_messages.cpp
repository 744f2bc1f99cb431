// SPDX-License-Identifier: Apache-2.0
#include "articula/view/protocol/requests/futures_messages.hpp"

#include "articula/recording/change_json.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace articula::view {

namespace {

constexpr std::array shares{0.0, 0.1, 0.5, 0.9, 1.0};  // of the futures below a quantile
constexpr std::size_t most_curves = 8;

/// Seven digits, more than a plot shows; null if it is not finite.
Json rounded(double x) {
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
      bands[band].push_back(rounded(values[static_cast<std::size_t>(std::lround(place))]));
    }
  }
}

constexpr std::array start_members{
    Member{"time", Kind::number, true}, Member{"position", Kind::numbers, true},
    Member{"velocity", Kind::numbers, true}, Member{"effort", Kind::numbers, true}};
constexpr std::array cycle_members{Member{"position", Kind::numbers, true},
                                   Member{"velocity", Kind::numbers, true},
                                   Member{"effort", Kind::numbers, true},
                                   Member{"command", Kind::number_lists, true},
                                   Member{"reference_position", Kind::numbers, true},
                                   Member{"reference_velocity", Kind::numbers},
                                   Member{"reference_acceleration", Kind::numbers},
                                   Member{"reference_effort", Kind::numbers}};
constexpr std::array followed_members{
    Member{"position", Kind::numbers, true}, Member{"velocity", Kind::numbers},
    Member{"acceleration", Kind::numbers}, Member{"effort", Kind::numbers}};

/// Reads where the futures begin and what they follow.
/// @return empty if all is well, else what is wrong
std::string read_course(const Json& call, remote::FuturesQuestion& question) {
  if (const auto start = call.find("start"); start != call.end()) {
    if (std::string fault = fault_of(*start, start_members, "start."); !fault.empty()) return fault;
    question.start = {start->at("time").get<double>(), numbers_of(*start, "position"),
                      numbers_of(*start, "velocity"), numbers_of(*start, "effort")};
  }
  if (const auto history = call.find("history"); history != call.end()) {
    std::size_t index = 0;
    for (const Json& own : *history) {
      const std::string place = "history[" + std::to_string(index++) + "].";
      if (std::string fault = fault_of(own, cycle_members, place); !fault.empty()) return fault;
      question.history.push_back(
          {{0, numbers_of(own, "position"), numbers_of(own, "velocity"), numbers_of(own, "effort")},
           {numbers_of(own, "reference_position"), numbers_of(own, "reference_velocity"),
            numbers_of(own, "reference_acceleration"), numbers_of(own, "reference_effort")},
           own.at("command").get<std::vector<std::vector<double>>>()});
    }
  }
  if (const auto references = call.find("references"); references != call.end()) {
    std::size_t index = 0;
    for (const Json& own : *references) {
      const std::string place = "references[" + std::to_string(index++) + "].";
      if (std::string fault = fault_of(own, followed_members, place); !fault.empty()) return fault;
      question.references.push_back({numbers_of(own, "position"), numbers_of(own, "velocity"),
                                     numbers_of(own, "acceleration"), numbers_of(own, "effort")});
    }
  }
  question.reference_step = call.value("reference_step", question.reference_step);
  if (const auto steps = call.find("steps"); steps != call.end()) {
    for (const auto& [joint, height] : steps->items()) {
      question.steps.push_back({joint, height.get<double>()});
    }
  }
  return {};
}

}  // namespace

Asked read_futures(const Json& call) {
  remote::FuturesQuestion question;
  if (const auto gains = call.find("gains"); gains != call.end()) {
    for (const auto& [name, value] : gains->items()) {
      question.gains.push_back({name, gain_of_json(value).value()});
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
  if (std::string fault = read_course(call, question); !fault.empty())
    return Refusal{std::move(fault)};
  return question;
}

Json futures_json(const remote::FuturesAnswer& answer, const remote::RobotSheet& robot) {
  const auto ended = [&](SimulationEnd end) {
    return std::count_if(answer.futures.begin(), answer.futures.end(),
                         [&](const auto& future) { return future.end == end; });
  };
  Json json = {{"time", answer.time},
               {"horizon", answer.horizon},
               {"samples", answer.samples},
               {"count", answer.futures.size()},
               {"unstable", ended(SimulationEnd::unstable)},
               {"non_finite", ended(SimulationEnd::non_finite)},
               {"shares", shares},
               {"joints", Json::array()},
               {"margins", Json::array()}};
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    Json curves = Json::array();
    for (std::size_t k = 0; k < std::min(most_curves, answer.futures.size()); ++k) {
      Json& curve = curves.emplace_back(Json::array());
      for (const double q : answer.futures[k].positions[j]) curve.push_back(rounded(q));
    }
    json["joints"].push_back(
        {{"name", robot.joints[j].name}, {"quantiles", quantiles(answer, j)}, {"curves", curves}});
  }
  for (const remote::JointMargins& margins : answer.margins) {
    json["margins"].push_back({{"controller", margins.controller},
                               {"joint", margins.joint},
                               {"stable", margins.stable},
                               {"gain_margin", rounded(margins.gain_margin)},
                               {"phase_margin", rounded(margins.phase_margin)},
                               {"delay_margin", rounded(margins.delay_margin)}});
  }
  return json;
}

}  // namespace articula::view

// SPDX-License-Identifier: Apache-2.0
/// @file The metrics of one closed loop, measured while it runs.
#pragma once

#include "articula/core/joint_reference.hpp"
#include "articula/core/joint_state.hpp"
#include "articula/core/joint_vector.hpp"
#include "articula/core/scalar.hpp"
#include "articula/model/joint.hpp"
#include "articula/sweep/sweep_experiment.hpp"
#include "articula/sweep/variation/joint_unit.hpp"
#include "articula/tuning/step_metrics.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace articula {

/// A metric of one's own: the last of the values of `next`, which is called in each cycle.
///
///     OwnMetric<2>{{"peak_power", "W"}, [](double so_far, const JointState<2>& state, ...) {
///       return std::max(so_far, state.effort.dot(state.velocity)); }}
template <int N>
struct OwnMetric {
  SweepMetric metric{};
  /// Called with the value so far (0 at first), the true state and the reference.
  std::function<double(double, const JointState<N>&, const JointReference<N>&)> next{};
};

/// Measures a run: for joints that make a step, its metrics; for all joints, errors and efforts.
/// @tparam S  type of a number: double, or a pack with the numbers of several runs
template <int N, class S = double>
class RunMeasures {
 public:
  using Moves = std::array<bool, static_cast<std::size_t>(N)>;

  /// @param start   positions before the step [rad or m]
  /// @param target  positions to which the joints step [rad or m]
  /// @param moves   joints that make a step
  RunMeasures(const JointVector<N, S>& start, const JointVector<N>& target, const Moves& moves) {
    for (int j = 0; j < N; ++j) {
      const auto place = static_cast<std::size_t>(j);
      if (moves[place]) steps_[place].emplace(start[j], target[j]);
    }
  }

  /// Names and units of all metrics, joint by joint; the energy is the last.
  /// @param joints  N of them
  /// @param moves   joints that make a step
  [[nodiscard]] static std::vector<SweepMetric> metrics(std::span<const JointProperties> joints,
                                                        const Moves& moves) {
    std::vector<SweepMetric> all;
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const std::string prefix = std::string(joints[j].name.view()) + ".";
      const auto add = [&](const char* name, const char* angular) {
        all.push_back({prefix + name, detail::joint_unit(angular, {&joints[j].type, 1})});
      };
      if (moves[j]) {
        add("rise_time", "s");
        add("overshoot", "1");
        add("settling_time", "s");
        add("steady_error", "rad");
      }
      add("tracking_rms", "rad");
      add("tracking_peak", "rad");
      add("velocity_peak", "rad/s");
      add("effort_peak", "N m");
      add("effort_rms", "N m");
    }
    all.push_back({"energy", "J"});
    return all;
  }

  /// Adds the sample of a cycle. The last one is after the last cycle.
  /// @param time       [s]
  /// @param state      the true one; the effort is that of the period before
  /// @param reference  at this time, of all runs
  /// @param period     [s]
  /// Real-time: yes.
  void add(double time, const JointState<N, S>& state, const JointReference<N>& reference,
           double period) noexcept {
    using std::abs;
    ++samples_;
    for (int j = 0; j < N; ++j) {
      auto& step = steps_[static_cast<std::size_t>(j)];
      if (step) step->add(time, state.position[j]);
      const S error = abs(reference.position[j] - state.position[j]);
      const S effort = abs(state.effort[j]), speed = abs(state.velocity[j]);
      error_squares_[j] += error * error;
      effort_squares_[j] += effort * effort;
      raise(error_peak_[j], error);
      raise(effort_peak_[j], effort);
      raise(speed_peak_[j], speed);
      energy_ += effort * speed * period;
    }
  }

  /// The metrics of a run in the order of `metrics`.
  /// @param values  receives them; those beyond are left as they are
  /// Real-time: yes.
  void values(std::span<double> values, int lane = 0) const noexcept {
    std::size_t next = 0;
    const auto put = [&](const S& value) { values[next++] = lane_of(value, lane); };
    const auto put_if_defined = [&](std::optional<double> value) {
      values[next++] = value.value_or(std::numeric_limits<double>::quiet_NaN());
    };
    const auto put_mean = [&](const S& squares, double samples) {
      values[next++] = std::sqrt(lane_of(squares, lane) / samples);
    };
    for (int j = 0; j < N; ++j) {
      if (const auto& step = steps_[static_cast<std::size_t>(j)]) {
        put_if_defined(step->rise_time(lane));
        put_if_defined(step->overshoot(lane));
        put_if_defined(step->settling_time(lane));
        const auto error = step->steady_error(lane);
        put_if_defined(error ? std::optional(std::abs(*error)) : error);
      }
      put_mean(error_squares_[j], samples_);
      put(error_peak_[j]);
      put(speed_peak_[j]);
      put(effort_peak_[j]);
      put_mean(effort_squares_[j], samples_ - 1);  // none before the first
    }
    put(energy_);
  }

 private:
  using Vector = JointVector<N, S>;

  static void raise(S& peak, const S& value) noexcept { peak = select(peak < value, value, peak); }

  std::array<std::optional<BasicStepMetrics<S>>, static_cast<std::size_t>(N)> steps_{};
  Vector error_squares_ = Vector::Zero(), effort_squares_ = Vector::Zero();
  Vector error_peak_ = Vector::Zero(), effort_peak_ = Vector::Zero(), speed_peak_ = Vector::Zero();
  S energy_ = 0;
  double samples_ = 0;
};

}  // namespace articula

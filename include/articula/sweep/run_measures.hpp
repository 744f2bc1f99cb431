// SPDX-License-Identifier: Apache-2.0
/// @file The metrics of one closed loop, measured while it runs.
#pragma once

#include "articula/core/joint_reference.hpp"
#include "articula/core/joint_state.hpp"
#include "articula/core/joint_vector.hpp"
#include "articula/sweep/sweep_experiment.hpp"
#include "articula/tuning/step_metrics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
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
template <int N>
class RunMeasures {
 public:
  /// @param start   positions before the step [rad or m]
  /// @param target  positions to which the joints step [rad or m]
  RunMeasures(const JointVector<N>& start, const JointVector<N>& target) {
    for (int j = 0; j < N; ++j) {
      steps_[static_cast<std::size_t>(j)].emplace(start[j], target[j]);
    }
  }

  /// Names and units of all metrics, joint by joint; the energy is the last.
  /// @param moves  joints that make a step
  [[nodiscard]] static std::vector<SweepMetric> metrics(
      const std::array<std::string_view, static_cast<std::size_t>(N)>& joints,
      const std::array<bool, static_cast<std::size_t>(N)>& moves) {
    std::vector<SweepMetric> all;
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const std::string prefix = std::string(joints[j]) + ".";
      const auto add = [&](const char* name, const char* unit) {
        all.push_back({prefix + name, unit});
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

  /// Adds a cycle.
  /// @param time       [s]
  /// @param state      the true one; the effort is that of the period before
  /// @param reference  at this time
  /// @param period     [s]
  /// Real-time: yes.
  void add(double time, const JointState<N>& state, const JointReference<N>& reference,
           double period) noexcept {
    ++cycles_;
    for (int j = 0; j < N; ++j) {
      steps_[static_cast<std::size_t>(j)]->add(time, state.position[j]);
      const double error = std::abs(reference.position[j] - state.position[j]);
      const double effort = std::abs(state.effort[j]), speed = std::abs(state.velocity[j]);
      error_squares_[j] += error * error;
      effort_squares_[j] += effort * effort;
      error_peak_[j] = std::max(error_peak_[j], error);
      effort_peak_[j] = std::max(effort_peak_[j], effort);
      speed_peak_[j] = std::max(speed_peak_[j], speed);
      energy_ += effort * speed * period;
    }
  }

  /// The metrics in the order of `metrics`.
  /// @param values  receives them; those beyond are left as they are
  /// Real-time: yes.
  void values(const std::array<bool, static_cast<std::size_t>(N)>& moves,
              std::span<double> values) const noexcept {
    std::size_t next = 0;
    const auto put = [&](double value) { values[next++] = value; };
    const auto put_if_defined = [&](std::optional<double> value) {
      put(value.value_or(std::numeric_limits<double>::quiet_NaN()));
    };
    for (int j = 0; j < N; ++j) {
      const auto place = static_cast<std::size_t>(j);
      const StepMetrics& step = *steps_[place];
      if (moves[place]) {
        put_if_defined(step.rise_time());
        put_if_defined(step.overshoot());
        put_if_defined(step.settling_time());
        const auto error = step.steady_error();
        put_if_defined(error ? std::optional(std::abs(*error)) : error);
      }
      put(std::sqrt(error_squares_[j] / cycles_));
      put(error_peak_[j]);
      put(speed_peak_[j]);
      put(effort_peak_[j]);
      put(std::sqrt(effort_squares_[j] / cycles_));
    }
    put(energy_);
  }

 private:
  using Vector = JointVector<N>;

  std::array<std::optional<StepMetrics>, static_cast<std::size_t>(N)> steps_{};
  Vector error_squares_ = Vector::Zero(), effort_squares_ = Vector::Zero();
  Vector error_peak_ = Vector::Zero(), effort_peak_ = Vector::Zero(), speed_peak_ = Vector::Zero();
  double energy_ = 0;
  double cycles_ = 0;
};

}  // namespace articula

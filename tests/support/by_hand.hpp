// SPDX-License-Identifier: Apache-2.0
/// @file A controller that a test calls by hand, cycle by cycle, as a loop does.
#pragma once

#include <articula/command/command_numbers.hpp>
#include <articula/core/controller.hpp>
#include <articula/core/finite.hpp>

#include <utility>

namespace support {

/// Calls a controller with state, reference and period, and completes the input as a loop does:
/// what is applied is the last command, unless the test cuts it off or replaces it.
template <class C, int N = C::joint_count>
struct ByHand : C {
  using Command = articula::CommandOf<C, N>;
  using Vector = articula::JointVector<N>;
  using Input = articula::ControlInput<N>;

  using C::C;
  ByHand() = default;
  ByHand(C controller) : C(std::move(controller)) {}  // NOLINT: implicit

  articula::Applied<N> applied{};
  Vector cut = Vector::Zero();
  articula::Verdict verdict = articula::Verdict::fine;

  /// @param last  what was applied before, nothing at a cold start
  void start(const articula::JointState<N>& state,
             const articula::JointReference<N>& reference = {},
             const articula::Applied<N>& last = {}, double period = 1e-3) noexcept {
    applied = last;
    cut.setZero();
    articula::start_controller<C, N>(*this, Input{state, reference, period, applied});
  }

  /// A reference that is not finite brakes.
  Command update(const articula::JointState<N>& state, const articula::JointReference<N>& reference,
                 double period) noexcept {
    const Input in{state, reference, period, applied, cut};
    const auto outcome = articula::is_finite(reference)
                             ? articula::update_controller<C, N>(*this, in)
                             : articula::brake_controller<C, N>(*this, in);
    verdict = outcome.verdict;
    if (!failed()) applied = {numbers_of(outcome.command, state), articula::Held::push};
    cut.setZero();
    return outcome.command;
  }

  [[nodiscard]] bool failed() const noexcept { return verdict == articula::Verdict::failed; }
  [[nodiscard]] bool degraded() const noexcept { return verdict == articula::Verdict::degraded; }

  /// Cuts off a part of the last command.
  void cut_off(const Vector& excess) noexcept {
    cut += excess;
    applied.numbers -= excess;
  }
  /// Applies other numbers in place of a failed command.
  void apply(const Vector& numbers) noexcept { applied = {numbers, articula::Held::push}; }
};

}  // namespace support

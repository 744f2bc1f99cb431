// SPDX-License-Identifier: Apache-2.0
/// @file Chunks of a sweep, handed out and collected.
#pragma once

#include "articula/sweep/sweep.hpp"

#include <algorithm>
#include <cstdint>
#include <exception>
#include <map>
#include <utility>

namespace articula::detail {

/// Hands out the chunks of a sweep, and collects them in the order of the runs.
class ChunkOrder {
 public:
  /// @param result  gets the runs that it does not have
  /// @param ranks   that compute
  ChunkOrder(const SweepOptions& options, const Samples& samples, SweepResult& result,
             const SweepHooks& hooks, int ranks)
      : result_(&result),
        hooks_(&hooks),
        chunk_(options.chunk),
        runs_(samples.runs()),
        next_(std::min(result.runs(), samples.runs())),
        ahead_(8 * static_cast<std::uint64_t>(ranks) * options.chunk) {
    try {
      check_begun(result, samples);
    } catch (...) {
      fail(std::current_exception());
    }
  }

  /// True if a chunk can be handed out now: not too far ahead of the slowest, or an empty one since
  /// there are no more.
  [[nodiscard]] bool has_next() const noexcept {
    return !goes_on_ || next_ == runs_ || next_ < result_->runs() + ahead_;
  }
  /// True if no run is left to hand out.
  [[nodiscard]] bool is_empty() const noexcept { return !goes_on_ || next_ == runs_; }
  [[nodiscard]] SweepChunk next() noexcept {
    const SweepChunk chunk{next_, is_empty() ? 0 : std::min(chunk_, runs_ - next_)};
    next_ += chunk.count;
    return chunk;
  }
  void collect(ComputedChunk chunk) {
    if (!goes_on_) return;
    const std::uint64_t first = chunk.rows.front().number;
    waiting_.emplace(first, std::move(chunk));
    try {
      while (goes_on_ && !waiting_.empty() && waiting_.begin()->first == result_->runs()) {
        goes_on_ = detail::collect(waiting_.begin()->second, *result_, *hooks_);
        waiting_.erase(waiting_.begin());
      }
    } catch (...) {
      fail(std::current_exception());
    }
  }
  /// Ends the sweep with an exception, if there was none before.
  void fail(std::exception_ptr thrown) noexcept {
    if (!thrown_) thrown_ = std::move(thrown);
    goes_on_ = false;
  }
  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  SweepResult* result_;
  const SweepHooks* hooks_;
  std::uint64_t chunk_, runs_, next_, ahead_;
  std::map<std::uint64_t, ComputedChunk> waiting_{};  ///< predecessors are missing
  std::exception_ptr thrown_{};
  bool goes_on_ = true;
};

}  // namespace articula::detail

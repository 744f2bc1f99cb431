// SPDX-License-Identifier: Apache-2.0
/// @file A sweep on many processes. Needs the CMake target articula::sweep_mpi.
#pragma once

#include "articula/core/refuse.hpp"
#include "articula/sweep/jobs/mpi_names.hpp"
#include "articula/sweep/run_chunk.hpp"
#include "articula/sweep/sweep.hpp"

#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <map>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace articula {

namespace detail {

/// Rows as numbers for MPI, and back.
struct RowPacking {
  const Samples& samples;
  std::size_t metrics;

  [[nodiscard]] std::size_t width() const noexcept {
    return 1 + samples.parameters().size() + metrics;
  }
  /// The number of the first run, then the rows.
  [[nodiscard]] std::vector<double> pack(std::uint64_t first,
                                         const std::vector<SweepRow>& rows) const {
    std::vector<double> numbers{static_cast<double>(first)};
    for (const SweepRow& row : rows) {
      numbers.push_back(static_cast<double>(row.end));
      numbers.insert(numbers.end(), row.parameters.begin(), row.parameters.end());
      numbers.insert(numbers.end(), row.metrics.begin(), row.metrics.end());
    }
    return numbers;
  }
  [[nodiscard]] std::vector<SweepRow> unpack(const std::vector<double>& numbers) const {
    std::vector<SweepRow> rows;
    auto number = static_cast<std::uint64_t>(numbers.at(0));
    const auto parameters = static_cast<std::ptrdiff_t>(samples.parameters().size());
    for (auto at = numbers.begin() + 1; at != numbers.end();
         at += static_cast<std::ptrdiff_t>(width()), ++number) {
      rows.push_back({number,
                      samples.seed(number),
                      {at + 1, at + 1 + parameters},
                      {at + 1 + parameters, at + static_cast<std::ptrdiff_t>(width())},
                      static_cast<FutureEnd>(static_cast<int>(*at))});
    }
    return rows;
  }
};

enum MpiTag : int { tag_rows = 1, tag_error = 2, tag_chunk = 3 };

/// Computes chunks until there are no more.
template <SweepExperiment E>
void work_for_mpi(const E& experiment, const Samples& samples, const RowPacking& packing,
                  MPI_Comm all) {
  std::vector<double> numbers;  // of the last chunk; none at first
  int tag = tag_rows;
  for (;;) {
    MPI_Send(numbers.data(), static_cast<int>(numbers.size()), detail::mpi_double(), 0, tag, all);
    std::uint64_t chunk[2] = {};
    MPI_Recv(chunk, 2, detail::mpi_uint64(), 0, tag_chunk, all, MPI_STATUS_IGNORE);
    if (chunk[1] == 0) return;
    try {
      numbers = packing.pack(chunk[0], run_chunk(experiment, samples, {chunk[0], chunk[1]}));
      tag = tag_rows;
    } catch (const std::exception& error) {
      const std::string message = error.what();
      numbers.assign(message.begin(), message.end());
      tag = tag_error;
    }
  }
}

}  // namespace detail

/// Goes on with a sweep in all processes of a communicator: all of them call this. Rank 0 hands out
/// chunks to ranks that are idle, and collects the rows in the order of the runs; so its result has
/// the same bits as that of continue_sweep. With one rank, it is continue_sweep. Each other rank
/// computes in one thread: start one more rank than processors.
/// @param result  of rank 0: the runs so far; gets the others. Not used by other ranks.
/// @param hooks   of rank 0
/// @param all     the ranks; MPI is initialised
/// @throws as continue_sweep, in rank 0
/// Real-time: no (allocates, throws, waits).
template <SweepExperiment E>
void continue_sweep_with_mpi(const E& experiment, const SweepOptions& options, SweepResult& result,
                             const SweepHooks& hooks = {}, MPI_Comm all = detail::mpi_world()) {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(all, &rank);
  MPI_Comm_size(all, &ranks);
  if (ranks == 1) return continue_sweep(experiment, options, result, hooks);
  const Samples samples(experiment.parameters(), options.sampling);
  validate(options, experiment.metrics());
  const detail::RowPacking packing{samples, experiment.metrics().size()};
  if (options.chunk * packing.width() > 100'000'000) {  // MPI counts in int
    detail::refuse({"sweep: chunk ", options.chunk, " is too large for one message"});
  }
  if (rank != 0) return detail::work_for_mpi(experiment, samples, packing, all);

  std::uint64_t next = std::min(result.runs(), samples.runs());
  const std::uint64_t ahead = 8 * static_cast<std::uint64_t>(ranks) * options.chunk;
  std::map<std::uint64_t, std::vector<SweepRow>> waiting;  // rows whose predecessors are missing
  std::deque<int> idle;
  std::string error;
  std::exception_ptr thrown;
  try {
    detail::check_begun(result, samples);
  } catch (...) {
    thrown = std::current_exception();
  }
  bool goes_on = thrown == nullptr;
  for (int working = ranks - 1; working > 0;) {
    // Chunks for all idle ranks, not too far ahead of the slowest; in the end, none.
    while (!idle.empty() && (!goes_on || next < result.runs() + ahead)) {
      std::uint64_t chunk[2] = {next, goes_on ? std::min(options.chunk, samples.runs() - next) : 0};
      next += chunk[1];
      MPI_Send(chunk, 2, detail::mpi_uint64(), idle.front(), detail::tag_chunk, all);
      idle.pop_front();
      if (chunk[1] == 0) --working;
    }
    if (working == 0) break;
    MPI_Status status;
    int is_there = 0;
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, all, &is_there, &status);
    if (is_there == 0) {  // a blocking call would take a whole processor
      std::this_thread::sleep_for(std::chrono::microseconds(50));
      continue;
    }
    int size = 0;
    MPI_Get_count(&status, detail::mpi_double(), &size);
    std::vector<double> numbers(static_cast<std::size_t>(size));
    MPI_Recv(numbers.data(), size, detail::mpi_double(), status.MPI_SOURCE, status.MPI_TAG, all,
             MPI_STATUS_IGNORE);
    idle.push_back(status.MPI_SOURCE);
    if (status.MPI_TAG == detail::tag_error) {
      if (error.empty()) error.assign(numbers.begin(), numbers.end());
      goes_on = false;
    }
    if (!goes_on || numbers.empty()) continue;
    auto rows = packing.unpack(numbers);
    waiting.emplace(rows.front().number, std::move(rows));
    try {
      while (goes_on && !waiting.empty() && waiting.begin()->first == result.runs()) {
        for (const SweepRow& row : waiting.begin()->second) {
          result.add(row);
          if (hooks.row) hooks.row(row);
        }
        waiting.erase(waiting.begin());
        goes_on = !hooks.progress || hooks.progress(result);
      }
    } catch (...) {  // the other ranks must hear of the end first
      thrown = std::current_exception();
      goes_on = false;
    }
  }
  if (thrown) std::rethrow_exception(thrown);
  if (!error.empty()) throw std::runtime_error(error);
}

}  // namespace articula

// SPDX-License-Identifier: Apache-2.0
/// @file A sweep with files on many processes. Needs the CMake target articula::sweep_mpi.
#pragma once

#include "articula/sweep/jobs/mpi_names.hpp"
#include "articula/sweep/jobs/mpi_sweep.hpp"
#include "articula/sweep/jobs/own_communicator.hpp"
#include "articula/sweep/jobs/resumable_sweep.hpp"

#include <mpi.h>

#include <cstddef>
#include <exception>
#include <stdexcept>
#include <string>

namespace articula {

/// resumable_sweep in all processes of a communicator: all of them call this. Rank 0 has the files
/// and the hooks.
///
///     int main() try {
///       const MpiSession mpi;
///       const SweepResult result =
///           resumable_sweep_with_mpi(experiment, options, {.rows = "rows.csv"});
///       if (mpi.rank() == 0) std::printf("%g\n", result.summary("energy").mean());
///     } catch (const std::exception& error) {
///       std::fprintf(stderr, "%s\n", error.what());
///       return 1;
///     }
/// @return  rank 0: the result; the others: a result without runs
/// @throws as resumable_sweep, in rank 0. What it throws before the first run, for example for a
///         file that cannot be written, the other ranks throw, too, as std::runtime_error.
/// @throws std::invalid_argument in all ranks if their sweeps or their SweepFiles::identity differ
/// Real-time: no (writes files, waits).
template <SweepExperiment E>
[[nodiscard]] SweepResult resumable_sweep_with_mpi(const E& experiment, const SweepOptions& options,
                                                   const SweepFiles& files,
                                                   const SweepHooks& hooks = {},
                                                   MPI_Comm all = detail::mpi_world()) {
  if (!detail::has_mpi()) return resumable_sweep(experiment, options, files, hooks);
  const detail::OwnCommunicator ranks(all);
  detail::check_same_sweep(detail::hash_of_options(experiment, options, files.identity),
                           ranks.get());
  int rank = 0;
  MPI_Comm_rank(ranks.get(), &rank);
  std::string reason;  // why rank 0 has not begun
  const auto tell = [&] {
    auto size = static_cast<int>(reason.size());
    MPI_Bcast(&size, 1, detail::mpi_int(), 0, ranks.get());
    reason.resize(static_cast<std::size_t>(size));
    MPI_Bcast(reason.data(), size, detail::mpi_byte(), 0, ranks.get());
  };
  if (rank == 0) {
    bool has_begun = false;
    const auto run = [&](const SweepOptions& each, SweepResult& result, const SweepHooks& own) {
      has_begun = true;
      tell();
      continue_sweep_with_mpi(experiment, each, result, own, ranks.get());
    };
    try {
      return resumable_sweep_by(experiment, options, files, hooks, run);
    } catch (const std::exception& error) {
      reason = error.what();
      if (!has_begun) tell();
      throw;
    }
  }
  tell();  // receives it
  if (!reason.empty()) throw std::runtime_error(reason);
  SweepResult none(experiment.metrics(), options);
  continue_sweep_with_mpi(experiment, options, none, {}, ranks.get());
  return none;
}

}  // namespace articula

// SPDX-License-Identifier: Apache-2.0
/// @file A sweep with files on many processes. Needs the CMake target articula::sweep_mpi.
#pragma once

#include "articula/sweep/jobs/mpi_names.hpp"
#include "articula/sweep/jobs/mpi_sweep.hpp"
#include "articula/sweep/jobs/own_communicator.hpp"
#include "articula/sweep/jobs/resumable_sweep.hpp"

#include <mpi.h>

#include <stdexcept>

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
/// @throws as resumable_sweep, in rank 0. If it throws before the first run, for example for a file
///         that cannot be written, the other ranks throw std::runtime_error.
/// Real-time: no (writes files, waits).
template <SweepExperiment E>
[[nodiscard]] SweepResult resumable_sweep_with_mpi(const E& experiment, const SweepOptions& options,
                                                   const SweepFiles& files,
                                                   const SweepHooks& hooks = {},
                                                   MPI_Comm all = detail::mpi_world()) {
  const detail::OwnCommunicator ranks(all);
  int rank = 0;
  MPI_Comm_rank(ranks.get(), &rank);
  int begins = 0;
  const auto tell = [&](int own) {
    begins = own;
    MPI_Bcast(&begins, 1, detail::mpi_int(), 0, ranks.get());
  };
  const auto run = [&](const SweepOptions& each, SweepResult& result, const SweepHooks& own) {
    tell(1);
    continue_sweep_with_mpi(experiment, each, result, own, ranks.get());
  };
  if (rank == 0) {
    try {
      return resumable_sweep_by(experiment, options, files, hooks, run);
    } catch (...) {
      if (begins == 0) tell(0);
      throw;
    }
  }
  tell(0);  // receives what rank 0 tells
  if (begins == 0) throw std::runtime_error("sweep: rank 0 has ended before the first run");
  SweepResult none(experiment.metrics(), options);
  continue_sweep_with_mpi(experiment, options, none, {}, ranks.get());
  return none;
}

}  // namespace articula

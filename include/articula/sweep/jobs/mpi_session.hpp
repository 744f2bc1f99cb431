// SPDX-License-Identifier: Apache-2.0
/// @file MPI for the duration of a program that may run with and without mpirun. Needs the CMake
/// target articula::sweep_mpi.
#pragma once

#include "articula/sweep/jobs/mpi_names.hpp"

#include <mpi.h>

#include <algorithm>
#include <array>
#include <cstdlib>

namespace articula {

/// Initialises MPI where the program was started by mpirun or srun, and ends it in the destructor.
/// Without them, it does nothing: there is one rank. A rank that fails while others work calls `abort`:
/// the destructor waits for all ranks.
class MpiSession {
 public:
  MpiSession() : is_active_(is_launched()) {
    if (!is_active_) return;
    int granted = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &granted);
    MPI_Comm_rank(detail::mpi_world(), &rank_);
    MPI_Comm_size(detail::mpi_world(), &ranks_);
  }
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;
  ~MpiSession() {
    if (is_active_) MPI_Finalize();
  }

  [[nodiscard]] bool is_active() const noexcept { return is_active_; }
  [[nodiscard]] int rank() const noexcept { return rank_; }
  [[nodiscard]] int ranks() const noexcept { return ranks_; }

  /// Ends the program in all ranks, for example after an exception in one of them.
  void abort(int status) const {
    if (is_active_) MPI_Abort(detail::mpi_world(), status);
  }

 private:
  [[nodiscard]] static bool is_launched() {
    constexpr auto variables =
        std::to_array<const char*>({"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"});
    return std::any_of(variables.begin(), variables.end(),
                       [](const char* name) { return std::getenv(name) != nullptr; });
  }

  bool is_active_;
  int rank_ = 0, ranks_ = 1;
};

}  // namespace articula

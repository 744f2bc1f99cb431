// SPDX-License-Identifier: Apache-2.0
/// @file MPI for the duration of a program that may run with and without mpirun. Needs the CMake
/// target articula::sweep_mpi.
#pragma once

#include "articula/sweep/jobs/mpi_names.hpp"
#include "articula/sweep/jobs/own_communicator.hpp"

#include <mpi.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>

namespace articula {

/// Initialises MPI where the program was started by mpirun or srun, and ends it in the destructor.
/// Without them, it does nothing: there is one rank.
///
/// The destructor waits for all ranks. After an exception, it waits for a few seconds and then ends
/// the program in all ranks, since they may wait for this one.
class MpiSession {
 public:
  /// @throws std::runtime_error if the launcher is that of another MPI
  MpiSession() : is_active_(is_launched()) {
    if (!is_active_) return;
    int granted = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &granted);
    MPI_Comm_rank(detail::mpi_world(), &rank_);
    MPI_Comm_size(detail::mpi_world(), &ranks_);
    check_launcher();
    ranks_of_end_.emplace(detail::mpi_world());
  }
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;
  ~MpiSession() {
    if (!is_active_) return;
    MPI_Request others{};
    MPI_Ibarrier(ranks_of_end_->get(), &others);
    int have_come = 0;
    constexpr auto pause = std::chrono::milliseconds(1);
    constexpr int pauses = 3000;  // longer than ranks need that end at the same time
    for (int k = 0; std::uncaught_exceptions() > exceptions_ && have_come == 0; ++k) {
      MPI_Test(&others, &have_come, MPI_STATUS_IGNORE);
      std::this_thread::sleep_for(pause);
      if (k < pauses) continue;
      std::fprintf(stderr,
                   "articula: rank %d ends by an exception while others work; catch it in "
                   "the scope of MpiSession to see its text\n",
                   rank_);
      abort(1);
    }
    if (have_come == 0) MPI_Wait(&others, MPI_STATUS_IGNORE);
    ranks_of_end_.reset();
    MPI_Finalize();
  }

  [[nodiscard]] bool is_active() const noexcept { return is_active_; }
  [[nodiscard]] int rank() const noexcept { return rank_; }
  [[nodiscard]] int ranks() const noexcept { return ranks_; }

  /// The lowest rank in which a condition holds; `ranks()` if it holds in none. All ranks call
  /// this.
  [[nodiscard]] int first_rank_with(bool condition) const {
    int first = condition ? rank_ : ranks_;
    if (is_active_) {
      MPI_Allreduce(MPI_IN_PLACE, &first, 1, detail::mpi_int(), detail::mpi_least(),
                    ranks_of_end_->get());
    }
    return first;
  }
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

  /// Each process of a launcher that this MPI does not understand would take itself for rank 0.
  void check_launcher() const {
    for (const char* variable : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}) {
      const char* const size = std::getenv(variable);
      if (size == nullptr || ranks_ > 1 || std::atoi(size) <= 1) continue;
      MPI_Finalize();
      throw std::runtime_error(std::string("MPI has one process, and ") + variable + " is " + size +
                               ": start the program by the mpirun of the MPI it is linked with");
    }
  }

  bool is_active_;
  int rank_ = 0, ranks_ = 1;
  std::optional<detail::OwnCommunicator> ranks_of_end_{};  ///< in which the destructor waits
  int exceptions_ = std::uncaught_exceptions();
};

}  // namespace articula

// SPDX-License-Identifier: Apache-2.0
/// @file An MPI communicator for the messages of its owner alone. Needs the CMake target
/// articula::sweep_mpi.
#pragma once

#include <mpi.h>

namespace articula::detail {

/// The ranks of a communicator in one of their own, so that messages of the program are not taken
/// for those of its owner. All ranks make and end it.
class OwnCommunicator {
 public:
  explicit OwnCommunicator(MPI_Comm all) { MPI_Comm_dup(all, &own_); }
  OwnCommunicator(const OwnCommunicator&) = delete;
  OwnCommunicator& operator=(const OwnCommunicator&) = delete;
  ~OwnCommunicator() { MPI_Comm_free(&own_); }
  [[nodiscard]] MPI_Comm get() const noexcept { return own_; }

 private:
  MPI_Comm own_{};
};

}  // namespace articula::detail

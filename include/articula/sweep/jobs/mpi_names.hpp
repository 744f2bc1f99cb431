// SPDX-License-Identifier: Apache-2.0
/// @file MPI's predefined names, whose macros contain casts of C. Needs the CMake target
/// articula::sweep_mpi.
#pragma once

#include <mpi.h>

namespace articula::detail {

// NOLINTBEGIN(bugprone-casting-through-void)
/// All ranks.
[[nodiscard]] inline MPI_Comm mpi_world() noexcept { return MPI_COMM_WORLD; }
[[nodiscard]] inline MPI_Datatype mpi_byte() noexcept { return MPI_BYTE; }
[[nodiscard]] inline MPI_Datatype mpi_int() noexcept { return MPI_INT; }
[[nodiscard]] inline MPI_Datatype mpi_uint64() noexcept { return MPI_UINT64_T; }
[[nodiscard]] inline MPI_Op mpi_least() noexcept { return MPI_MIN; }
// NOLINTEND(bugprone-casting-through-void)

}  // namespace articula::detail

// SPDX-License-Identifier: Apache-2.0
/// @file Messages of many ranks. Needs the CMake target articula::sweep_mpi.
#pragma once

#include "articula/sweep/jobs/mpi_names.hpp"

#include <mpi.h>

#include <array>
#include <cstddef>
#include <memory>
#include <string_view>

namespace articula::detail {

/// Receives messages of any rank while its owner does other things. Several receives wait at any
/// time, so MPI transfers a message while the ones before are read.
class MpiInbox {
 public:
  /// @param largest  size of a message [bytes]
  MpiInbox(std::size_t largest, MPI_Comm all) : largest_(largest), all_(all) {
    for (std::size_t place = 0; place < count; ++place) {
      buffers_[place] = std::make_unique_for_overwrite<char[]>(largest);
      receive(place);
    }
  }
  MpiInbox(const MpiInbox&) = delete;
  MpiInbox& operator=(const MpiInbox&) = delete;
  /// Takes no more messages.
  ~MpiInbox() {
    for (MPI_Request& request : requests_) {
      MPI_Cancel(&request);
      MPI_Wait(&request, MPI_STATUS_IGNORE);
    }
  }

  /// Takes a message, if one has arrived. Two messages of a rank may come in either order.
  /// @param read  called with the rank, the tag and the bytes, which then end
  /// @return      false if there is none
  template <class Read>
  bool take(const Read& read) {
    int place = 0, is_there = 0, size = 0;
    MPI_Status status;
    MPI_Testany(static_cast<int>(count), requests_.data(), &place, &is_there, &status);
    if (is_there == 0) return false;
    MPI_Get_count(&status, mpi_byte(), &size);
    const auto at = static_cast<std::size_t>(place);
    read(status.MPI_SOURCE, status.MPI_TAG,
         std::string_view(buffers_[at].get(), static_cast<std::size_t>(size)));
    receive(at);
    return true;
  }

 private:
  static constexpr std::size_t count = 16;  // receives that wait

  void receive(std::size_t place) {
    MPI_Irecv(buffers_[place].get(), static_cast<int>(largest_), mpi_byte(), MPI_ANY_SOURCE,
              MPI_ANY_TAG, all_, &requests_[place]);
  }

  std::size_t largest_;
  MPI_Comm all_;
  std::array<std::unique_ptr<char[]>, count> buffers_{};
  std::array<MPI_Request, count> requests_{};
};

}  // namespace articula::detail

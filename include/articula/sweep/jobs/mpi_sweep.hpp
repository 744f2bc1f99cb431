// SPDX-License-Identifier: Apache-2.0
/// @file A sweep on many processes. Needs the CMake target articula::sweep_mpi.
#pragma once

#include "articula/core/refuse.hpp"
#include "articula/sweep/jobs/chunk_order.hpp"
#include "articula/sweep/jobs/chunk_packing.hpp"
#include "articula/sweep/jobs/chunk_thread.hpp"
#include "articula/sweep/jobs/mpi_inbox.hpp"
#include "articula/sweep/jobs/mpi_names.hpp"
#include "articula/sweep/jobs/own_communicator.hpp"
#include "articula/sweep/jobs/sweep_identity.hpp"
#include "articula/sweep/run_chunk.hpp"
#include "articula/sweep/sweep.hpp"

#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace articula {

namespace detail {

enum MpiTag : int { tag_rows = 1, tag_error = 2, tag_chunk = 3 };

/// Of the text of an error [bytes].
inline constexpr std::size_t longest_error = 4096;

/// Computes chunks until there are no more. Rank 0 sends each rank as many as it may have at once,
/// and another for each that comes back.
template <class Compute>
void work_for_mpi(const Compute& compute, const ChunkPacking& packing, MPI_Comm all) {
  std::string bytes;  // of the last chunk, which MPI may still read
  MPI_Request sent{};
  bool is_sending = false;
  for (int ended = 0; ended < chunks_of_rank;) {
    std::uint64_t chunk[2] = {};
    MPI_Recv(chunk, 2, mpi_uint64(), 0, tag_chunk, all, MPI_STATUS_IGNORE);
    if (chunk[1] == 0) {
      ++ended;
      continue;
    }
    int tag = tag_rows;
    std::string next;
    try {
      next = packing.pack(compute({chunk[0], chunk[1]}));
    } catch (const std::exception& error) {
      next = std::string(error.what()).substr(0, longest_error);
      tag = tag_error;
    }
    if (is_sending) MPI_Wait(&sent, MPI_STATUS_IGNORE);
    bytes = std::move(next);
    MPI_Isend(bytes.data(), static_cast<int>(bytes.size()), mpi_byte(), 0, tag, all, &sent);
    is_sending = true;
  }
  if (is_sending) MPI_Wait(&sent, MPI_STATUS_IGNORE);
}

/// What rank 0 does while the others work: hands out chunks and collects rows, until there are no
/// more.
/// @param chunk  runs in it at most
/// @param own    computes chunks of this rank, as ChunkThread does
template <class OwnChunks>
void hand_out_for_mpi(ChunkOrder& order, const ChunkPacking& packing, std::uint64_t chunk,
                      int ranks, OwnChunks& own, MPI_Comm all) {
  MpiInbox inbox(std::max(packing.largest(chunk), longest_error), all);
  std::deque<int> idle;  // a rank for each chunk that it can have
  for (int k = 0; k < chunks_of_rank; ++k) {
    for (int rank = 1; rank < ranks; ++rank) idle.push_back(rank);
  }
  auto places = idle.size();  // of chunks, in the ranks that are not dismissed
  constexpr std::chrono::microseconds shortest(20), longest(1000);
  auto pause = shortest;
  const auto read = [&](int rank, int tag, std::string_view bytes) {
    idle.push_back(rank);
    if (tag == tag_error) {
      order.fail(std::make_exception_ptr(std::runtime_error(std::string(bytes))));
    } else {
      order.collect(packing.unpack(bytes));
    }
  };
  while (places > 0 || own.owes_chunk() || !order.is_empty()) {
    while (!idle.empty() && order.has_next()) {
      const SweepChunk next = order.next();
      const std::uint64_t numbers[2] = {next.first, next.count};
      MPI_Send(numbers, 2, mpi_uint64(), idle.front(), tag_chunk, all);
      idle.pop_front();
      if (next.count == 0) --places;
    }
    if (inbox.take(read)) {
      pause = shortest;
    } else if (auto done = own.take()) {
      done->thrown ? order.fail(done->thrown) : order.collect(std::move(done->chunk));
      pause = shortest;
    } else if (own.wants_chunk() && !order.is_empty() && order.has_next()) {
      own.give(order.next());
    } else {  // a blocking call of MPI would take a whole processor
      own.wait(pause);
      pause = std::min(2 * pause, longest);
    }
  }
}

/// True if MPI is initialised: a program that was started without mpirun may leave it out.
[[nodiscard]] inline bool has_mpi() noexcept {
  int is_initialised = 0;
  MPI_Initialized(&is_initialised);
  return is_initialised != 0;
}

/// Refuses sweeps that differ from rank to rank, for example by files of their own.
/// @param hash  of the sweep of this rank
/// @throws std::invalid_argument in all ranks, naming the first one that differs from rank 0
inline void check_same_sweep(std::uint64_t hash, MPI_Comm all) {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(all, &rank);
  MPI_Comm_size(all, &ranks);
  std::uint64_t first = hash;
  MPI_Bcast(&first, 1, mpi_uint64(), 0, all);
  int other = first == hash ? ranks : rank;
  MPI_Allreduce(MPI_IN_PLACE, &other, 1, mpi_int(), mpi_least(), all);
  if (other < ranks) {
    refuse({"sweep: rank ", other,
            " has another sweep than rank 0: parameters, metrics, options "
            "or files differ"});
  }
}

}  // namespace detail

/// Goes on with a sweep in all processes of a communicator: all of them call this. Each rank
/// computes in one thread. The main thread of rank 0 hands out chunks to ranks that are idle, and
/// collects the rows in the order of the runs. So its result has the same bits as that of
/// continue_sweep. A second thread of rank 0 computes while no other rank has to wait for the main
/// thread. With one rank, it is continue_sweep.
/// @param result  of rank 0: the runs so far; gets the others. Not used by other ranks.
/// @param hooks   of rank 0
/// @param all     the ranks; MPI is initialised with MPI_THREAD_FUNNELED or more, as by MpiSession.
///                Without MPI_Init there is one rank.
/// @throws as continue_sweep, in rank 0; std::invalid_argument in all ranks if their sweeps differ
/// Real-time: no (allocates, throws, waits).
template <SweepExperiment E>
void continue_sweep_with_mpi(const E& experiment, const SweepOptions& options, SweepResult& result,
                             const SweepHooks& hooks = {}, MPI_Comm all = detail::mpi_world()) {
  int rank = 0, ranks = 1;
  if (detail::has_mpi()) {
    MPI_Comm_rank(all, &rank);
    MPI_Comm_size(all, &ranks);
  }
  if (ranks == 1) return continue_sweep(experiment, options, result, hooks);
  const Samples samples(experiment.parameters(), options.sampling);
  validate(options, experiment.metrics());
  const detail::ChunkPacking packing{samples, experiment.metrics().size()};
  if (packing.largest(options.chunk) > 1'000'000'000) {  // MPI counts in int
    detail::refuse({"sweep: chunk ", options.chunk, " is too large for one message"});
  }
  const detail::OwnCommunicator own_ranks(all);
  detail::check_same_sweep(detail::hash_of_options(experiment, options, ""), own_ranks.get());
  int with_lines = hooks.lines ? 1 : 0;
  MPI_Bcast(&with_lines, 1, detail::mpi_int(), 0, own_ranks.get());
  const auto compute = [&](const SweepChunk& chunk) {
    return compute_chunk(experiment, samples, chunk, with_lines != 0);
  };
  if (rank != 0) return detail::work_for_mpi(compute, packing, own_ranks.get());

  detail::ChunkOrder order(options, samples, result, hooks, ranks);
  detail::ChunkThread own(compute);
  detail::hand_out_for_mpi(order, packing, options.chunk, ranks, own, own_ranks.get());
  order.rethrow();
}

}  // namespace articula

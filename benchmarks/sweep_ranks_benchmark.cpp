// SPDX-License-Identifier: Apache-2.0
// Sweeps on many ranks: what a row costs the rank that computes it, and rank 0.
// simulated_ranks/run.sh has both for more ranks than this machine has.
#include <articula/sweep/jobs/chunk_packing.hpp>
#include <articula/sweep/run_chunk.hpp>

#include <benchmark/benchmark.h>

#include "plain_rows.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

namespace {

using namespace articula;

constexpr std::uint64_t chunk_size = 64;

/// The parts of the work beside the runs.
class Rows {
 public:
  Rows() : file_(std::tmpfile()) {
    for (std::uint64_t k = 0; k < 100; ++k) {
      computed_.push_back(compute_chunk(experiment_, samples_, {k * chunk_size, chunk_size}, true));
      packed_.push_back(packing_.pack(computed_.back()));
    }
  }
  Rows(const Rows&) = delete;
  Rows& operator=(const Rows&) = delete;
  ~Rows() { std::fclose(file_); }

  /// In the rank that computes a chunk: lines of CSV, and bytes for MPI.
  void write_lines() {
    ComputedChunk& chunk = computed_[next_++ % computed_.size()];
    chunk.lines.clear();
    for (const SweepRow& row : chunk.rows) append_row(chunk.lines, row);
    benchmark::DoNotOptimize(packing_.pack(chunk));
  }
  /// In rank 0.
  void collect() {
    const ComputedChunk chunk = packing_.unpack(packed_[next_++ % packed_.size()]);
    for (const SweepRow& row : chunk.rows) result_.add(row);
    std::fwrite(chunk.lines.data(), 1, chunk.lines.size(), file_);
    if (next_ % 1000 == 0) std::rewind(file_);
  }

 private:
  PlainRows experiment_{};
  Samples samples_{experiment_.parameters(), {.runs = 1'000'000}};
  detail::ChunkPacking packing_{samples_, PlainRows::metric_count};
  SweepResult result_{experiment_.metrics(), {}};
  std::vector<ComputedChunk> computed_{};
  std::vector<std::string> packed_{};
  std::size_t next_ = 0;
  std::FILE* file_;
};

void lines(benchmark::State& bench) {
  Rows rows;
  for (auto _ : bench) rows.write_lines();
  bench.SetItemsProcessed(bench.iterations() * static_cast<std::int64_t>(chunk_size));
}
void collection(benchmark::State& bench) {
  Rows rows;
  for (auto _ : bench) rows.collect();
  bench.SetItemsProcessed(bench.iterations() * static_cast<std::int64_t>(chunk_size));
}
BENCHMARK(lines)->Name("sweep_ranks/lines_of_64_rows");
BENCHMARK(collection)->Name("sweep_ranks/collection_of_64_rows");

}  // namespace

// SPDX-License-Identifier: Apache-2.0
/// @file Chunks of a sweep as bytes.
#pragma once

#include "articula/sweep/run_chunk.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace articula::detail {

/// Chunks as bytes for MPI, and back: number of the first run, number of runs, rows as doubles,
/// lines.
struct ChunkPacking {
  const Samples& samples;
  std::size_t metrics;

  [[nodiscard]] std::size_t width() const noexcept {
    return 1 + samples.parameters().size() + metrics;
  }
  /// The largest size of a chunk [bytes].
  /// @param runs  in it
  [[nodiscard]] std::size_t largest(std::uint64_t runs) const noexcept {
    constexpr std::size_t number = 25, start = 60;  // letters in a line of CSV
    return 16 + static_cast<std::size_t>(runs) * ((8 + number) * width() + start);
  }
  [[nodiscard]] std::string pack(const ComputedChunk& chunk) const {
    std::string bytes;
    bytes.reserve(16 + 8 * chunk.rows.size() * width() + chunk.lines.size());
    const auto put = [&](const auto* values, std::size_t count) {
      bytes.append(reinterpret_cast<const char*>(values), count * sizeof *values);
    };
    const std::uint64_t head[2] = {chunk.rows.front().number, chunk.rows.size()};
    put(head, 2);
    for (const SweepRow& row : chunk.rows) {
      const auto end = static_cast<double>(row.end);
      put(&end, 1);
      put(row.parameters.data(), row.parameters.size());
      put(row.metrics.data(), row.metrics.size());
    }
    return bytes += chunk.lines;
  }
  [[nodiscard]] ComputedChunk unpack(std::string_view bytes) const {
    const char* at = bytes.data();
    const auto take = [&](auto* values, std::size_t count) {
      std::memcpy(values, at, count * sizeof *values);
      at += count * sizeof *values;
    };
    std::uint64_t head[2] = {};
    take(head, 2);
    ComputedChunk chunk;
    chunk.rows.reserve(head[1]);
    for (std::uint64_t number = head[0]; number < head[0] + head[1]; ++number) {
      SweepRow row{.number = number,
                   .seed = samples.seed(number),
                   .parameters = std::vector<double>(samples.parameters().size()),
                   .metrics = std::vector<double>(metrics)};
      double end = 0;
      take(&end, 1);
      row.end = static_cast<SimulationEnd>(static_cast<int>(end));
      take(row.parameters.data(), row.parameters.size());
      take(row.metrics.data(), row.metrics.size());
      chunk.rows.push_back(std::move(row));
    }
    chunk.lines.assign(at, bytes.data() + bytes.size());
    return chunk;
  }
};

}  // namespace articula::detail

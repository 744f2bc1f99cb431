// SPDX-License-Identifier: Apache-2.0
#include <articula/articula.hpp>
#include <articula/recording/mcap_record_writer.hpp>
#include <articula/recording/record_stream.hpp>
#include <articula/robots/q2d.hpp>

#include <cstdio>
#include <filesystem>

int main() {
  using Loop = articula::Loop<articula::Q2dSim, articula::PidPlusGravity>;
  using Record = articula::CycleRecordOf<Loop>;
  Loop loop;
  articula::McapRecordWriter<articula::Q2d, Loop::Command> mcap(RECORDS);
  articula::RecordStream<Record> stream({[&](const Record& record) { mcap.write(record); }});
  articula::SimulatedClock clock;
  const auto report = articula::run(
      loop, clock, {.cycles = 100},
      [&](auto& now, const auto& so_far) { return stream.push(articula::record_of(now, so_far)); });
  stream.close();
  mcap.close();
  const auto size = std::filesystem::file_size(RECORDS);
  std::printf("%d cycles, %d bytes\n", static_cast<int>(report.cycles), static_cast<int>(size));
  return report.cycles == 100 && size > 100 * 100 ? 0 : 1;
}

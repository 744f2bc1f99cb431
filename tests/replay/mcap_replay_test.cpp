// SPDX-License-Identifier: Apache-2.0
#include <articula/recording/csv_record_reader.hpp>
#include <articula/recording/csv_writer.hpp>
#include <articula/recording/mcap_record_reader.hpp>
#include <articula/recording/mcap_record_writer.hpp>
#include <articula/robots/gripper_arm.hpp>

#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "catch.hpp"
#include "recorded_runs.hpp"
#include "remote/record.hpp"
#include "scratch_file.hpp"

using namespace articula;

namespace {

/// All numbers of a record.
template <int N, class Command>
std::vector<double> numbers_in(const CycleRecord<N, Command>& record) {
  std::vector<double> all{record.time};
  const auto add = [&](const auto& vector) { all.insert(all.end(), vector.begin(), vector.end()); };
  add(record.state.position);
  add(record.state.velocity);
  add(record.state.effort);
  add(record.reference.position);
  add(record.reference.velocity);
  add(record.reference.acceleration);
  add(record.reference.effort);
  for (const auto& part : parts_of(record.command)) add(*part.values);
  return all;
}

/// @param keeps_infinity  the file has infinite numbers; otherwise they come back as NaN
template <int N, class Command>
bool are_same(const CycleRecord<N, Command>& a, const CycleRecord<N, Command>& b,
              bool keeps_infinity) {
  const auto x = numbers_in(a), y = numbers_in(b);
  for (std::size_t k = 0; k < x.size(); ++k) {
    const bool is_lost = std::isnan(x[k]) || (std::isinf(x[k]) && !keeps_infinity);
    if (is_lost ? !std::isnan(y[k])
                : std::bit_cast<std::uint64_t>(x[k]) != std::bit_cast<std::uint64_t>(y[k])) {
      return false;
    }
  }
  return a.cycle == b.cycle && a.status == b.status && a.input == b.input &&
         a.timing.latency == b.timing.latency && a.timing.period == b.timing.period &&
         a.timing.update == b.timing.update;
}

/// A record of random bits, finite and not.
template <int N, class Command>
CycleRecord<N, Command> random_record(support::Random& random) {
  const auto bits = [&] {
    const auto half = [&] { return static_cast<std::uint64_t>(random.integer(0, 0x7fffffff)); };
    return std::bit_cast<double>(half() << 33 ^ half() << 11 ^ half());
  };
  CycleRecord<N, Command> record;
  record.cycle = static_cast<std::uint64_t>(random.integer(0, 1 << 30));
  record.time = random.number(0, 1e5);
  record.status = static_cast<Status>(random.integer(0, 9));
  for (int j = 0; j < N; ++j) {
    for (auto* vector : {&record.state.position, &record.state.velocity, &record.state.effort,
                         &record.reference.position, &record.reference.velocity,
                         &record.reference.acceleration, &record.reference.effort}) {
      (*vector)[j] = bits();
    }
    for (const auto& part : parts_of(record.command)) {
      (*part_of(record.command, part.quantity))[j] = bits();
    }
  }
  record.reference.effort[0] = random.one_in(2) ? -0.0 : std::numeric_limits<double>::denorm_min();
  const auto nanoseconds = [&] { return std::chrono::nanoseconds(random.integer(0, 1 << 30)); };
  record.timing = {nanoseconds(), nanoseconds(), nanoseconds()};
  record.input = {.read = static_cast<Status>(random.integer(0, 9)),
                  .write = static_cast<Status>(random.integer(0, 9)),
                  .request = static_cast<LoopRequest>(random.integer(0, 3)),
                  .change = static_cast<Status>(random.integer(0, 9)),
                  .posted = random.one_in(2),
                  .overruns = static_cast<std::uint32_t>(random.integer(0, 1 << 30)),
                  .missed = static_cast<std::uint64_t>(random.integer(0, 1 << 30)) << 20};
  return record;
}

template <class R, class Command>
void check_round_trip(unsigned seed) {
  constexpr int N = joint_count<R>;
  support::Random random(seed);
  const support::ScratchFile mcap("trip.mcap"), csv("trip.csv");
  std::vector<CycleRecord<N, Command>> records;
  {
    McapRecordWriter<R, Command> mcap_writer(mcap.path());
    CsvWriter<R, Command> csv_writer(csv.path());
    for (int k = 0; k < 500; ++k) {
      records.push_back(random_record<N, Command>(random));
      mcap_writer.write(records.back());
      csv_writer.write(records.back());
    }
  }
  const auto from_mcap = read_mcap_recording<Command>(R(), mcap.path());
  const auto from_csv = read_csv_recording<Command>(R(), csv.path());
  REQUIRE(from_mcap.cycles.size() == records.size());
  REQUIRE(from_csv.cycles.size() == records.size());
  int same = 0;
  for (std::size_t k = 0; k < records.size(); ++k) {
    same += are_same(records[k], from_mcap.cycles[k], false);
    same += are_same(records[k], from_csv.cycles[k], true);
  }
  CHECK(same == 1000);
}

}  // namespace

TEST_CASE("what was written as MCAP or CSV is read with the same bits") {
  check_round_trip<Q2d, EffortCommand<2>>(1);
  check_round_trip<Q2d, MultiModeCommand<2>>(2);
  check_round_trip<GripperArm, PositionCommand<joint_count<GripperArm>>>(3);
}

TEST_CASE("a run with faults, switches and gains is replayed from an MCAP file to the last bit") {
  const auto recording = support::switched_run(7, 40);
  const support::ScratchFile file("run.mcap");
  McapRecordWriter<Q2d, EffortCommand<2>> writer(file.path());
  for (const auto& record : recording.cycles) {
    std::vector<LoopChange> changes;
    for (const LoopChange& change : recording.changes) {
      if (change.cycle == record.cycle) changes.push_back(change);
    }
    writer.write(record, changes);
  }
  writer.close();
  const auto read = read_mcap_recording<EffortCommand<2>>(Q2d(), file.path());
  REQUIRE(read.cycles.size() == recording.cycles.size());
  REQUIRE(read.changes.size() == recording.changes.size());
  const auto difference = Replay<support::SwitchedLoop>(read).run();
  CHECK((difference ? to_string(*difference) : "") == "");

  auto without = read;
  without.changes.clear();
  CHECK(Replay<support::SwitchedLoop>(without).run());
}

TEST_CASE("a run is replayed from a CSV file, with its changes from elsewhere") {
  const auto recording = support::switched_run(8, 40);
  const support::ScratchFile file("run.csv");
  CsvWriter<Q2d, EffortCommand<2>> writer(file.path(), {.links = {"tool_link"}});
  for (const auto& record : recording.cycles) writer.write(record);
  writer.close();
  auto read = read_csv_recording<EffortCommand<2>>(Q2d(), file.path());
  REQUIRE(read.cycles.size() == recording.cycles.size());
  read.changes = recording.changes;
  const auto difference = Replay<support::SwitchedLoop>(read).run();
  CHECK((difference ? to_string(*difference) : "") == "");
}

TEST_CASE("changes of a loop go through JSON") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const LoopChange change{.cycle = 5,
                          .request = {.stop = {"a", "b"},
                                      .start = {"c"},
                                      .strictness = Strictness::best_effort,
                                      .replace = true},
                          .gains = {{"x.y.p", 0.1}, {"x.y.low", -infinity}, {"x.y.up", infinity}}};
  const LoopChange read = change_of_json(5, Json::parse(change_json(change).dump()));
  CHECK(read.cycle == 5);
  CHECK(read.gains == change.gains);
  const std::vector<Name> stop(read.request.stop.begin(), read.request.stop.end());
  CHECK(stop == std::vector<Name>{"a", "b"});
  CHECK(std::vector<Name>(read.request.start.begin(), read.request.start.end()) ==
        std::vector<Name>{"c"});
  CHECK(read.request.strictness == Strictness::best_effort);
  CHECK(read.request.replace);
  CHECK(change_json({}).dump() == "{}");
}

TEST_CASE("an MCAP file that lacks its end is read as far as it goes") {
  const support::ScratchFile file("cut.mcap");
  {
    McapRecordWriter<Q2d, EffortCommand<2>> writer(file.path());
    for (int k = 0; k < 400; ++k) writer.write(support::some_record());
  }
  std::size_t before = 400;
  for (auto size = std::filesystem::file_size(file.path()); size > 3000; size -= 2989) {
    std::filesystem::resize_file(file.path(), size);
    const auto read = read_mcap_recording<EffortCommand<2>>(Q2d(), file.path());
    CHECK(read.cycles.size() <= before);
    CHECK(read.cycles.size() + 10 >= before);  // of the 1 kB that each has, none but the cut ones
    before = read.cycles.size();
  }
  CHECK(before < 10);
}

TEST_CASE("files of other robots, commands and kinds are refused with the reason") {
  const support::ScratchFile mcap("other.mcap"), csv("other.csv");
  {
    McapRecordWriter<Q2d, EffortCommand<2>> mcap_writer(mcap.path());
    CsvWriter<Q2d, EffortCommand<2>> csv_writer(csv.path());
    mcap_writer.write(support::some_record());
    csv_writer.write(support::some_record());
  }
  using Arm = GripperArm;
  using Command = PositionCommand<joint_count<Arm>>;
  CHECK_THROWS_WITH(read_mcap_recording<Command>(Arm(), mcap.path()),
                    Catch::Contains(mcap.path().string() + ", record 1: "));
  CHECK_THROWS_WITH(read_csv_recording<Command>(Arm(), csv.path()),
                    Catch::Contains("it was recorded for another robot or kind of command"));
  CHECK_THROWS_WITH(read_csv_recording<MultiModeCommand<2>>(Q2d(), csv.path()),
                    Catch::Contains("another robot or kind of command"));
  CHECK_THROWS_WITH(read_mcap_recording<MultiModeCommand<2>>(Q2d(), mcap.path()),
                    Catch::Contains("record 1: "));
  CHECK_THROWS_WITH(read_mcap_recording<EffortCommand<2>>(Q2d(), csv.path()),
                    csv.path().string() + " is no MCAP file");
  CHECK_THROWS_WITH(read_mcap_recording<EffortCommand<2>>(Q2d(), "/nowhere/a.mcap"),
                    "cannot read /nowhere/a.mcap");
  CHECK_THROWS_WITH(read_csv_recording<EffortCommand<2>>(Q2d(), "/nowhere/a.csv"),
                    "cannot read /nowhere/a.csv");
  std::ofstream(csv.path(), std::ios::app) << "1,2,3\n";
  CHECK_THROWS_WITH(read_csv_recording<EffortCommand<2>>(Q2d(), csv.path()),
                    csv.path().string() + ": line 3 has 3 cells, but the header has 29");
}

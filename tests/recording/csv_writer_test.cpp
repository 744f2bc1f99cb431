// SPDX-License-Identifier: Apache-2.0
#include <articula/loop/csv_writer.hpp>
#include <articula/robots/q2d.hpp>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "catch.hpp"
#include "record.hpp"
#include "scratch_file.hpp"

using namespace articula;

namespace {

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> result;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) result.push_back(cell);
  return result;
}

}  // namespace

TEST_CASE("a CSV file has a header with units and a line per record, exact to the last bit") {
  const support::ScratchFile file("records.csv");
  CsvWriter<Q2d, EffortCommand<2>> writer(file.path());
  const auto record = support::some_record();
  writer.write(record);
  writer.write(record);
  writer.close();

  std::ifstream stream(file.path());
  std::string line;
  REQUIRE(std::getline(stream, line));
  const auto header = cells(line);
  REQUIRE(header.size() == 3 + 2 * 8 + 3);
  CHECK(header[1] == "time [s]");
  CHECK(header[3] == "shoulder_active_joint position [rad]");
  CHECK(header[10] == "shoulder_active_joint command [N m]");
  CHECK(header[16] == "elbow_active_joint reference acceleration [rad/s^2]");
  CHECK(header[19] == "latency [s]");
  for (int row = 0; row < 2; ++row) {
    REQUIRE(std::getline(stream, line));
    const auto values = cells(line);
    REQUIRE(values.size() == header.size());
    CHECK(values[0] == "12");
    CHECK(std::stod(values[1]) == record.time);
    CHECK(values[2] == "overrun");
    CHECK(std::stod(values[3]) == record.state.position[0]);
    CHECK(std::stod(values[10]) == record.command.effort[0]);
    CHECK(std::stod(values[16]) == record.reference.acceleration[1]);
    CHECK(std::stod(values[19]) == Approx(3e-6));
  }
  CHECK_FALSE(std::getline(stream, line));
}

TEST_CASE("a command of several numbers has a column for each") {
  const support::ScratchFile file("multi_mode.csv");
  CsvWriter<Q2d, MultiModeCommand<2>> writer(file.path());
  CycleRecord<2, MultiModeCommand<2>> record;
  record.command = {{1, 2}, {3, 4}, {5, 6}, {7, 8}, {9, 10}};
  writer.write(record);
  writer.close();
  std::ifstream stream(file.path());
  std::string line;
  REQUIRE(std::getline(stream, line));
  const auto header = cells(line);
  REQUIRE(std::getline(stream, line));
  const auto values = cells(line);
  REQUIRE(values.size() == header.size());
  const std::vector<std::string> names{"position [rad]", "velocity [rad/s]", "stiffness [N m/rad]",
                                       "damping [N m s/rad]", "effort [N m]"};
  for (std::size_t k = 0; k < names.size(); ++k) {
    CHECK(header[10 + k] == "shoulder_active_joint command " + names[k]);
    CHECK(header[22 + k] == "elbow_active_joint command " + names[k]);
    CHECK(std::stoul(values[10 + k]) == 2 * k + 1);
    CHECK(std::stoul(values[22 + k]) == 2 * k + 2);
  }
}

TEST_CASE("a file that cannot be written is an error") {
  CHECK_THROWS_WITH((CsvWriter<Q2d, EffortCommand<2>>("/nowhere/records.csv")),
                    "cannot write /nowhere/records.csv");
  CsvWriter<Q2d, EffortCommand<2>> full("/dev/full");
  CHECK_THROWS_AS(
      [&] {
        for (int k = 0; k < 10000; ++k) full.write(support::some_record());
        full.close();
      }(),
      std::runtime_error);
}

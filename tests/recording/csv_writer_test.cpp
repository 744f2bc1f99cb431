// SPDX-License-Identifier: Apache-2.0
#include <articula/recording/csv_writer.hpp>
#include <articula/robots/gripper_arm.hpp>
#include <articula/robots/q2d.hpp>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <locale>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "remote/record.hpp"
#include "scratch_file.hpp"

using namespace articula;

namespace {

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> result;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) result.push_back(cell);
  return result;
}

/// The header and the first row of a file, whose columns must agree.
std::pair<std::vector<std::string>, std::vector<std::string>> first_row(
    const std::filesystem::path& path) {
  std::ifstream stream(path);
  std::string header, row;
  REQUIRE(std::getline(stream, header));
  REQUIRE(std::getline(stream, row));
  REQUIRE(cells(header).size() == cells(row).size());
  return {cells(header), cells(row)};
}

/// Writes 1234.5 as 1.234,5.
struct CommaPoint : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

/// The locale of the program while it lives.
class ProgramLocale {
 public:
  explicit ProgramLocale(const std::locale& locale) : before_(std::locale::global(locale)) {}
  ~ProgramLocale() { std::locale::global(before_); }
  ProgramLocale(const ProgramLocale&) = delete;
  ProgramLocale& operator=(const ProgramLocale&) = delete;

 private:
  std::locale before_;
};

}  // namespace

TEST_CASE("a CSV file has a header with units and a line per record, exact to the last bit") {
  const support::ScratchFile file("records.csv");
  CsvWriter<Q2d, EffortCommand<2>> writer(file.path());
  const auto record = support::some_record();
  writer.write(record);
  writer.write(record);
  writer.close();
  writer.close();  // does nothing

  std::ifstream stream(file.path());
  std::string line;
  REQUIRE(std::getline(stream, line));
  const auto header = cells(line);
  REQUIRE(header.size() == 3 + 2 * 8 + 3 + 7);
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

TEST_CASE("a program whose locale has decimal commas writes the same file") {
  const support::ScratchFile file("locale.csv");
  auto record = support::some_record();
  record.cycle = 1234567;
  {
    const ProgramLocale comma(std::locale(std::locale::classic(), new CommaPoint));
    CsvWriter<Q2d, EffortCommand<2>> writer(file.path());
    writer.write(record);
    writer.close();
  }
  const auto [header, values] = first_row(file.path());
  CHECK(header.size() == 3 + 2 * 8 + 3 + 7);
  CHECK(values[0] == "1234567");
  CHECK(std::stod(values[1]) == record.time);
}

TEST_CASE("mimic joints and named links have columns at the end") {
  const support::ScratchFile file("extras.csv");
  constexpr int n = joint_count<GripperArm>;
  CycleRecord<n, PositionCommand<n>> record;
  for (int j = 0; j < n; ++j) {
    record.state.position[j] = 0.1 * (j + 1);
    record.state.velocity[j] = 0.2 * (j + 1);
  }
  const auto all = moving_joint_positions(GripperArm(), record.state.position);
  const auto rates = moving_joint_velocities(GripperArm(), record.state.velocity);
  const auto names = moving_joint_names(GripperArm());
  const std::string link(model_of(GripperArm()).links.back().name.view());
  constexpr std::size_t mimics = moving_joint_count<GripperArm> - n, columns = 3 + n * 8 + 3 + 7;
  REQUIRE(mimics == 5);
  {
    CsvWriter<GripperArm, PositionCommand<n>> writer(file.path(), {.links = {link}});
    writer.write(record);
    writer.close();
  }
  const auto [header, values] = first_row(file.path());
  REQUIRE(header.size() == columns + 2 * mimics + 7);
  std::size_t found = 0;
  for (std::size_t c = columns; c < columns + 2 * mimics; c += 2) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (header[c] != std::string(names[i]) + " position [rad]") continue;
      ++found;
      CHECK(header[c + 1] == std::string(names[i]) + " velocity [rad/s]");
      CHECK(std::stod(values[c]) == all[static_cast<int>(i)]);
      CHECK(std::stod(values[c + 1]) == rates[static_cast<int>(i)]);
    }
  }
  CHECK(found == mimics);

  const auto pose = forward_kinematics(GripperArm(), record.state.position, link);
  const std::size_t first = columns + 2 * mimics;
  const std::vector<std::string> parts{" x [m]", " y [m]", " z [m]", " qx", " qy", " qz", " qw"};
  std::vector<double> written;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    CHECK(header[first + k] == link + parts[k]);
    written.push_back(std::stod(values[first + k]));
  }
  CHECK(Eigen::Vector3d(written[0], written[1], written[2]) == pose.translation());
  const Eigen::Quaterniond rotation(written[6], written[3], written[4], written[5]);
  CHECK((rotation.toRotationMatrix() - pose.linear()).norm() < 1e-14);  // rounding

  CsvWriter<GripperArm, PositionCommand<n>> without(file.path(), {.mimic_joints = false});
  without.write(record);
  without.close();
  CHECK(first_row(file.path()).first.size() == columns);
  CHECK_THROWS_WITH((CsvWriter<Q2d, EffortCommand<2>>(file.path(), {.links = {"hand"}})),
                    Catch::Matchers::Contains("'hand'"));
}

TEST_CASE("a file that cannot be written is an error") {
  CHECK_THROWS_WITH((CsvWriter<Q2d, EffortCommand<2>>("/nowhere/records.csv")),
                    "cannot write /nowhere/records.csv: No such file or directory");
  CsvWriter<Q2d, EffortCommand<2>> full("/dev/full");
  CHECK_THROWS_AS(
      [&] {
        for (int k = 0; k < 10000; ++k) full.write(support::some_record());
        full.close();
      }(),
      std::runtime_error);
}

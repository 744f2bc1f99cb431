// SPDX-License-Identifier: Apache-2.0
/// @file Writes recorded cycles to a CSV file.
#pragma once

#include "articula/command/command_parts.hpp"
#include "articula/core/refuse.hpp"
#include "articula/model/robot.hpp"
#include "articula/recording/cycle_record.hpp"
#include "articula/recording/output_file.hpp"
#include "articula/recording/record_extras.hpp"

#include <array>
#include <charconv>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace articula {

/// Writes recorded cycles to a file: a header with the name and the unit of every column, then one
/// row for each cycle. For PlotJuggler or Foxglove use McapRecordWriter.
///
///     CsvWriter<Q2d, EffortCommand<2>> csv("motion.csv", {.links = {"tool_link"}});
///     csv.write(record_of(loop, report));
///
/// Reading a number back gives the same bits. The decimal point does not depend on the program's
/// locale. A command of several numbers for a joint has a column for each. The last columns are
/// those of mimic joints and of link poses: position [m] and a unit quaternion.
/// @tparam R            the robot
/// @tparam CommandType  of the loop
template <Robot R, class CommandType>
class CsvWriter {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using Record = CycleRecord<joint_count, CommandType>;

  /// Creates the file and writes the header.
  /// @param robot     whose loop is recorded
  /// @param path      of the file
  /// @param contents  what is written in addition to the commanded joints
  /// @throws std::runtime_error naming the file and the reason, if it cannot be written
  /// @throws std::invalid_argument if the robot has no link of a name in `contents`
  /// Real-time: no (allocates, calls the system); likewise all functions of this class.
  CsvWriter(const R& robot, const std::filesystem::path& path, const RecordContents& contents = {})
      : robot_(robot), extras_(robot, contents), file_(path) {
    add_header();
    write_row();
  }
  explicit CsvWriter(const std::filesystem::path& path, const RecordContents& contents = {})
    requires DescribedRobot<R>
      : CsvWriter(R(), path, contents) {}

  /// Writes one record.
  /// @throws std::runtime_error naming the file and the reason, if it cannot be written
  void write(const Record& record) {
    row_ = std::to_string(record.cycle);
    add(record.time);
    add(to_string(record.status));
    for (int j = 0; j < joint_count; ++j) {
      for (const auto* vector :
           {&record.state.position, &record.state.velocity, &record.state.effort,
            &record.reference.position, &record.reference.velocity, &record.reference.acceleration,
            &record.reference.effort}) {
        add((*vector)[j]);
      }
      for (const auto& part : parts_of(record.command)) add((*part.values)[j]);
    }
    const CycleTiming& timing = record.timing;
    for (const auto duration : {timing.latency, timing.period, timing.update}) {
      add(std::chrono::duration<double>(duration).count());
    }
    const CycleInput& input = record.input;
    for (const Status status : {input.read, input.write, input.change}) add(to_string(status));
    for (const std::uint64_t number :
         {static_cast<std::uint64_t>(input.request), std::uint64_t{input.posted},
          std::uint64_t{input.overruns}, input.missed}) {
      add(std::to_string(number));
    }
    add_extras(record.state);
    write_row();
  }

  /// Completes the file. Does nothing if the file is closed already. The destructor completes the
  /// file, too, but loses the error.
  /// @throws std::runtime_error naming the file and the reason, if not all could be written
  void close() {
    if (!file_.is_open()) return;
    file_.close();
    file_.check();
  }

 private:
  // Units in the order of CommandQuantity, then that of accelerations.
  using Units = std::array<std::string_view, 6>;
  static constexpr Units angular{"rad", "rad/s", "N m", "N m/rad", "N m s/rad", "rad/s^2"};
  static constexpr Units linear{"m", "m/s", "N", "N/m", "N s/m", "m/s^2"};

  void add_header() {
    row_ = "cycle,time [s],status";
    for (const JointProperties& joint : model_of(robot_).joints) {
      const Units& units = joint.type == JointType::prismatic ? linear : angular;
      const auto add_column = [&](std::string_view name, std::size_t unit) {
        add(detail::message_of({joint.name.view(), " ", name, " [", units[unit], "]"}));
      };
      add_column("position", 0);
      add_column("velocity", 1);
      add_column("effort", 2);
      add_column("reference position", 0);
      add_column("reference velocity", 1);
      add_column("reference acceleration", 5);
      add_column("reference effort", 2);
      const CommandType command;
      const auto parts = parts_of(command);
      for (const auto& part : parts) {
        std::string name = "command";
        if (parts.size() > 1) (name += ' ') += to_string(part.quantity);
        add_column(name, static_cast<std::size_t>(part.quantity));
      }
    }
    row_ += ",latency [s],period [s],update [s],read,write,change,request,posted,overruns,missed";
    for (const MimicJoint& joint : extras_.mimic_joints) {
      const std::string_view length = joint.slides ? "m" : "rad";
      add(detail::message_of({joint.name, " position [", length, "]"}));
      add(detail::message_of({joint.name, " velocity [", length, "/s]"}));
    }
    for (const RecordedLink& link : extras_.links) {
      for (const char* column : {" x [m]", " y [m]", " z [m]", " qx", " qy", " qz", " qw"}) {
        add(link.name + column);
      }
    }
  }

  void add_extras(const JointState<joint_count>& state) {
    if (!extras_.mimic_joints.empty()) {
      const auto q = moving_joint_positions(robot_, state.position);
      const auto v = moving_joint_velocities(robot_, state.velocity);
      for (const MimicJoint& joint : extras_.mimic_joints) {
        add(q[joint.index]);
        add(v[joint.index]);
      }
    }
    for (const RecordedLink& link : extras_.links) {
      const Eigen::Isometry3d pose = forward_kinematics(robot_, state.position, link.index);
      const Eigen::Quaterniond rotation(pose.linear());
      for (const double value : pose.translation()) add(value);
      for (const double value : rotation.coeffs()) add(value);  // x, y, z, w
    }
  }

  void add(std::string_view cell) { (row_ += ',') += cell; }
  void add(double value) {
    std::array<char, 32> text;  // at most 24 characters: sign, 17 digits, point and exponent
    char* const end = text.data() + text.size();
    add({text.data(), std::to_chars(text.data(), end, value, std::chars_format::general, 17).ptr});
  }
  void write_row() {
    file_.write(row_ += '\n');
    file_.check();
  }

  [[no_unique_address]] R robot_;
  RecordExtras<R> extras_;
  detail::OutputFile file_;
  std::string row_{};  ///< the cells of the present row
};

}  // namespace articula

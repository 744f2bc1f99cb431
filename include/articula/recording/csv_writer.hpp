// SPDX-License-Identifier: Apache-2.0
/// @file Records as comma-separated values.
#pragma once

#include "articula/core/command_parts.hpp"
#include "articula/core/refuse.hpp"
#include "articula/model/robot.hpp"
#include "articula/recording/cycle_record.hpp"
#include "articula/recording/output_file.hpp"
#include "articula/recording/record_extras.hpp"

#include <array>
#include <charconv>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace articula {

/// Writes records to a file: a header that names every column with its unit, then one line each.
/// Numbers are written so that reading them back gives the same, with a decimal point whatever the
/// program's locale is. A command of several numbers for a joint has a column for each. Mimic joints
/// and poses of links come last in the row; the rotation of a link is a unit quaternion.
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
  /// @param contents  columns besides those of the commanded joints
  /// @throws std::runtime_error naming the file and the reason, if it cannot be written
  /// @throws std::invalid_argument if the robot has no link of a name in `contents`
  /// Real-time: no (allocates, calls the system), nor has any other function of this class.
  CsvWriter(const R& robot, const std::filesystem::path& path, const RecordContents& contents = {})
      : robot_(robot), extras_(robot, contents), file_(path) {
    add_header();
    write_row();
  }
  /// For a robot known at compile time.
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
  void add_header() {
    row_ = "cycle,time [s],status";
    for (const JointProperties& joint : model_of(robot_).joints) {
      const bool slides = joint.type == JointType::prismatic;
      const std::string name(joint.name.view());
      const std::string length = slides ? "m" : "rad", effort = slides ? "N" : "N m";
      const auto unit = [&](CommandQuantity quantity) -> std::string {
        if (quantity == CommandQuantity::position) return length;
        if (quantity == CommandQuantity::velocity) return length + "/s";
        if (quantity == CommandQuantity::effort) return effort;
        if (quantity == CommandQuantity::stiffness) return effort + "/" + length;
        return effort + " s/" + length;
      };
      const auto add_column = [&](std::string_view what, const std::string& its_unit) {
        add(detail::message_of({name, " ", what, " [", its_unit, "]"}));
      };
      for (const std::string_view what : {"", "reference "}) {
        add_column(detail::message_of({what, "position"}), length);
        add_column(detail::message_of({what, "velocity"}), length + "/s");
        if (!what.empty()) add_column("reference acceleration", length + "/s^2");
        add_column(detail::message_of({what, "effort"}), effort);
      }
      const CommandType command;
      const auto parts = parts_of(command);
      for (const auto& part : parts) {
        const std::string_view quantity = parts.size() > 1 ? to_string(part.quantity) : "";
        add_column(detail::message_of({"command", quantity.empty() ? "" : " ", quantity}),
                   unit(part.quantity));
      }
    }
    row_ += ",latency [s],period [s],update [s]";
    for (const MimicJoint& joint : extras_.mimic_joints()) {
      const std::string_view length = joint.slides ? "m" : "rad";
      add(detail::message_of({joint.name, " position [", length, "]"}));
      add(detail::message_of({joint.name, " velocity [", length, "/s]"}));
    }
    for (const RecordedLink& link : extras_.links()) {
      for (const char* column : {" x [m]", " y [m]", " z [m]", " qx", " qy", " qz", " qw"}) {
        add(link.name + column);
      }
    }
  }

  void add_extras(const JointState<joint_count>& state) {
    if (!extras_.mimic_joints().empty()) {
      const auto q = moving_joint_positions(robot_, state.position);
      const auto v = moving_joint_velocities(robot_, state.velocity);
      for (const MimicJoint& joint : extras_.mimic_joints()) {
        add(q[joint.index]);
        add(v[joint.index]);
      }
    }
    for (const RecordedLink& link : extras_.links()) {
      const Eigen::Isometry3d pose = forward_kinematics(robot_, state.position, link.index);
      const Eigen::Quaterniond rotation(pose.linear());
      for (const double value : pose.translation()) add(value);
      for (const double value : rotation.coeffs()) add(value);  // x, y, z, w
    }
  }

  void add(std::string_view cell) { (row_ += ',') += cell; }
  void add(double value) {
    std::array<char, 32> digits;  // 24 are enough: sign, point, exponent and 17 digits
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                   std::chars_format::general, 17)
                         .ptr;
    add(std::string_view(digits.data(), static_cast<std::size_t>(end - digits.data())));
  }
  void write_row() {
    file_.write(row_ += '\n');
    file_.check();
  }

  [[no_unique_address]] R robot_;
  RecordExtras<R> extras_;
  detail::OutputFile file_;
  std::string row_{};  ///< of the file, while its cells are added
};

}  // namespace articula

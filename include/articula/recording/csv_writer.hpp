// SPDX-License-Identifier: Apache-2.0
/// @file Records as comma-separated values.
#pragma once

#include "articula/core/command_parts.hpp"
#include "articula/model/robot.hpp"
#include "articula/recording/cycle_record.hpp"
#include "articula/recording/record_extras.hpp"

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <limits>
#include <locale>
#include <stdexcept>
#include <string>

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

  /// @param contents  what is written besides the joints that can be commanded
  /// @throws std::runtime_error if the file cannot be written, std::invalid_argument if the robot
  ///         has no link of a name
  CsvWriter(const R& robot, const std::filesystem::path& path, const RecordContents& contents = {})
      : robot_(robot), extras_(robot, contents), path_(path.string()), file_(path) {
    file_.imbue(std::locale::classic());
    file_.precision(std::numeric_limits<double>::max_digits10);
    write_header();
    check();
  }
  /// For a robot known at compile time.
  explicit CsvWriter(const std::filesystem::path& path, const RecordContents& contents = {})
    requires DescribedRobot<R>
      : CsvWriter(R(), path, contents) {}

  /// Writes one record.
  /// @throws std::runtime_error if it cannot be written
  void write(const Record& record) {
    file_ << record.cycle << ',' << record.time << ',' << to_string(record.status);
    for (int j = 0; j < joint_count; ++j) {
      for (const auto* vector :
           {&record.state.position, &record.state.velocity, &record.state.effort,
            &record.reference.position, &record.reference.velocity, &record.reference.acceleration,
            &record.reference.effort}) {
        file_ << ',' << (*vector)[j];
      }
      for (const auto& part : parts_of(record.command)) file_ << ',' << (*part.values)[j];
    }
    const CycleTiming& timing = record.timing;
    for (const auto duration : {timing.latency, timing.period, timing.update}) {
      file_ << ',' << std::chrono::duration<double>(duration).count();
    }
    write_extras(record.state);
    file_ << '\n';
    check();
  }

  /// Completes the file. Does nothing if it is closed already. The destructor completes it, too, but
  /// does not say whether all was written.
  /// @throws std::runtime_error if not all could be written
  void close() {
    if (!file_.is_open()) return;
    file_.close();
    check();
  }

 private:
  void write_header() {
    file_ << "cycle,time [s],status";
    for (const JointProperties& joint : model_of(robot_).joints) {
      const bool slides = joint.type == JointType::prismatic;
      const std::string name(joint.name.view()), q = slides ? "m" : "rad";
      const std::string effort = slides ? " [N]" : " [N m]";
      const std::string position = " [" + q + "]", velocity = " [" + q + "/s]";
      const auto unit = [&](CommandQuantity quantity) -> std::string {
        if (quantity == CommandQuantity::position) return position;
        if (quantity == CommandQuantity::velocity) return velocity;
        if (quantity == CommandQuantity::effort) return effort;
        if (quantity == CommandQuantity::stiffness) return slides ? " [N/m]" : " [N m/rad]";
        return slides ? " [N s/m]" : " [N m s/rad]";
      };
      for (const std::string& column :
           {"position" + position, "velocity" + velocity, "effort" + effort,
            "reference position" + position, "reference velocity" + velocity,
            "reference acceleration [" + q + "/s^2]", "reference effort" + effort}) {
        file_ << ',' << name << ' ' << column;
      }
      const CommandType command;
      const auto parts = parts_of(command);
      for (const auto& part : parts) {
        file_ << ',' << name << " command";
        if (parts.size() > 1) file_ << ' ' << to_string(part.quantity);
        file_ << unit(part.quantity);
      }
    }
    file_ << ",latency [s],period [s],update [s]";
    for (const MimicJoint& joint : extras_.mimic_joints()) {
      const std::string unit = joint.slides ? "m" : "rad";
      file_ << ',' << joint.name << " position [" << unit << "]," << joint.name << " velocity ["
            << unit << "/s]";
    }
    for (const RecordedLink& link : extras_.links()) {
      for (const char* column : {" x [m]", " y [m]", " z [m]", " qx", " qy", " qz", " qw"}) {
        file_ << ',' << link.name << column;
      }
    }
    file_ << '\n';
  }

  void write_extras(const JointState<joint_count>& state) {
    if (!extras_.mimic_joints().empty()) {
      const auto q = moving_joint_positions(robot_, state.position);
      const auto v = moving_joint_velocities(robot_, state.velocity);
      for (const MimicJoint& joint : extras_.mimic_joints()) {
        file_ << ',' << q[joint.index] << ',' << v[joint.index];
      }
    }
    for (const RecordedLink& link : extras_.links()) {
      const Eigen::Isometry3d pose = forward_kinematics(robot_, state.position, link.index);
      const Eigen::Quaterniond rotation(pose.linear());
      for (const double value : pose.translation()) file_ << ',' << value;
      for (const double value : rotation.coeffs()) file_ << ',' << value;  // x, y, z, w
    }
  }

  void check() const {
    if (!file_) throw std::runtime_error("cannot write " + path_);
  }

  [[no_unique_address]] R robot_;
  RecordExtras<R> extras_;
  std::string path_;
  std::ofstream file_;
};

}  // namespace articula

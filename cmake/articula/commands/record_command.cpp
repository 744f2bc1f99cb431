// SPDX-License-Identifier: Apache-2.0
/// @file record: all cycles of a running loop to an MCAP file.
#include "connection.hpp"
#include "files/within.hpp"
#include "program.hpp"

#include <articula/core/status.hpp>
#include <articula/recording/mcap_writer.hpp>
#include <articula/recording/record_json.hpp>
#include <articula/recording/ros_record_writer.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace terminal {

namespace {

/// Makes messages as McapRecordWriter writes them of the columns that the server sends.
class CycleRows {
 public:
  explicit CycleRows(const Json& robot) : robot_(robot.value("name", "robot")) {
    for (const Json& joint : robot.value("joints", Json::array())) {
      joints_.push_back(joint.value("name", ""));
    }
    for (const Json& quantity : robot.value("commands", Json::array())) {
      commands_.push_back(quantity.get<std::string>());
    }
  }

  /// The JSON of one cycle.
  [[nodiscard]] Json row(const Json& columns, std::size_t k) const {
    const Json time = columns.at("time").at(k);
    Json row{{"timestamp", time}};
    Json& joints = row[robot_];
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      const auto of = [&](const char* name) { return columns.at(name).at(j).at(k); };
      Json& joint = joints[joints_[j]];
      joint = {
          {"position", of("position")}, {"velocity", of("velocity")}, {"effort", of("effort")}};
      joint["reference"] = {{"position", of("reference_position")},
                            {"velocity", of("reference_velocity")},
                            {"acceleration", of("reference_acceleration")},
                            {"effort", of("reference_effort")}};
      for (const std::string& quantity : commands_) {
        const Json& value = columns.at("command").at(quantity).at(j).at(k);
        (commands_.size() == 1 ? joint["command"] : joint["command"][quantity]) = value;
      }
    }
    row["cycle"] = columns.at("number").at(k);
    const int status = columns.at("status").at(k).get<int>();
    row["status"] = std::string(to_string(static_cast<articula::Status>(status)));
    row["status_number"] = status;
    for (const char* name : {"latency", "period", "update"}) {
      row["timing"][name] = columns.at(name).at(k);
    }
    for (const auto& [name, values] : columns.at("input").items()) {
      row["input"][name] = values.at(k);
    }
    return row;
  }

  /// A row to make the schema of.
  [[nodiscard]] Json example() const {
    const auto per_joint = [this] {
      Json columns = Json::array();
      for (std::size_t j = 0; j < joints_.size(); ++j) columns.push_back({0.0});
      return columns;
    };
    Json columns{{"time", {0.0}},    {"number", {0}},   {"status", {0}},
                 {"latency", {0.0}}, {"period", {0.0}}, {"update", {0.0}}};
    for (const char* name :
         {"read", "write", "request", "change", "posted", "overruns", "missed"}) {
      columns["input"][name] = {0};
    }
    for (const char* name : {"position", "velocity", "effort", "reference_position",
                             "reference_velocity", "reference_acceleration", "reference_effort"}) {
      columns[name] = per_joint();
    }
    for (const std::string& quantity : commands_) columns["command"][quantity] = per_joint();
    return row(columns, 0);
  }

 private:
  std::string robot_;
  std::vector<std::string> joints_, commands_;
};

/// The gains of all controllers as a change. Those that are infinite are left out.
Json present_settings(Connection& connection) {
  Json change = Json::object();
  const Json answer = connection.call("/describe_parameters");
  for (const Json& gain : answer.value("parameters", Json::array())) {
    const Json& value = gain.at("value");
    if (value.is_number()) change["gains"][gain.at("name").get<std::string>()] = value;
  }
  return change;
}

/// Cycles that came, and those that were lost on the way.
struct Counts {
  std::uint64_t cycles = 0, lost = 0;
};

/// Calls function(columns, k) for each cycle that comes, until Ctrl-C or the end of a time.
/// @param robot    as the view describes it
/// @param seconds  in the time of the loop, so that it is a number of cycles
template <class Function>
Counts for_each_cycle(Connection& connection, const Json& robot, double seconds,
                      Function&& function) {
  const double most = std::round(seconds / robot.at("period").get<double>());
  connection.subscribe("/cycles");
  end_on_signal();
  Counts counts;
  std::uint64_t last = 0;
  const auto full = [&] { return static_cast<double>(counts.cycles + counts.lost) >= most; };
  while (!is_ended() && !full()) {
    const auto message = connection.next(1.0);
    if (!message) continue;  // the simulated time may be stopped
    const Json& columns = message->content;
    for (std::size_t k = 0; k < columns.at("time").size() && !full(); ++k) {
      const auto number = columns.at("number").at(k).get<std::uint64_t>();
      if (counts.cycles > 0 && number > last + 1) counts.lost += number - last - 1;
      last = number;
      function(columns, k);
      ++counts.cycles;
    }
  }
  return counts;
}

double time_of(const Json& columns, std::size_t k) {
  const Json& time = columns.at("time").at(k);
  return time.is_number() ? std::max(time.get<double>(), 0.0) : 0.0;
}

/// Messages in JSON, from which the run can be computed again.
Counts record_cycles(Connection& connection, const std::string& file, double seconds) {
  const Json robot = connection.call("/robot");
  const CycleRows rows(robot);
  articula::McapWriter writer(file, "cycle", "articula.Cycle",
                              articula::schema_of(rows.example()).dump());
  Json settings = present_settings(connection);
  const Counts counts =
      for_each_cycle(connection, robot, seconds, [&](const Json& columns, std::size_t k) {
        Json row = rows.row(columns, k);
        if (!settings.empty()) row["changes"].push_back(std::exchange(settings, Json()));
        for (const Json& change : columns.at("changes")) {
          if (change.at("cycle") == columns.at("number").at(k)) {
            row["changes"].push_back(change.at("change"));
          }
        }
        writer.write(std::chrono::nanoseconds(std::llround(time_of(columns, k) * 1e9)), row.dump());
      });
  writer.close();
  return counts;
}

/// Messages of ROS 2.
Counts record_ros(Connection& connection, const std::string& file, double seconds) {
  const Json robot = connection.call("/robot");
  std::vector<std::string> joints;
  for (const Json& joint : robot.at("joints")) joints.push_back(joint.at("name"));
  using articula::RosRecordWriter;
  RosRecordWriter writer(file, joints);
  const Counts counts =
      for_each_cycle(connection, robot, seconds, [&](const Json& columns, std::size_t k) {
        const auto all = [&](const Json& quantity) {
          std::vector<double> values;
          for (const Json& joint : quantity) {
            const Json& value = joint.at(k);
            values.push_back(value.is_number() ? value.get<double>()
                                               : std::numeric_limits<double>::quiet_NaN());
          }
          return values;
        };
        const double time = time_of(columns, k);
        writer.write(
            RosRecordWriter::Topic::joint_states, time,
            {all(columns.at("position")), all(columns.at("velocity")), all(columns.at("effort"))});
        writer.write(RosRecordWriter::Topic::reference, time,
                     {all(columns.at("reference_position")), all(columns.at("reference_velocity")),
                      all(columns.at("reference_effort"))});
        const auto command = [&](const char* quantity) {
          const Json& commands = columns.at("command");
          return commands.contains(quantity) ? all(commands.at(quantity)) : std::vector<double>();
        };
        writer.write(RosRecordWriter::Topic::command, time,
                     {command("position"), command("velocity"), command("effort")});
      });
  writer.close();
  return counts;
}

struct Options {
  std::string file;
  double seconds = 1e6;
  bool as_ros = false, overwrites = false;
};

void record(const Program& program, const Options& options) {
  const auto& [file, seconds, as_ros, overwrites] = options;
  std::error_code ignored;
  if (!overwrites && std::filesystem::is_regular_file(file, ignored)) {
    throw Refusal(file + ": the file exists; --force overwrites it");
  }
  Connection connection(program);
  connection.note_pause();
  const auto [cycles, lost] =
      as_ros ? record_ros(connection, file, seconds) : record_cycles(connection, file, seconds);
  program.print({{"file", file}, {"cycles", cycles}, {"lost", lost}},
                file + ": " + std::to_string(cycles) + " cycles" +
                    (lost == 0 ? "" : ", " + std::to_string(lost) + " lost on the way"));
}

}  // namespace

void add_record_command(CLI::App& app, Program& program) {
  const auto options = std::make_shared<Options>();
  CLI::App* command =
      add_command(app, program, "record", "Records all cycles to an MCAP file until Ctrl-C.",
                  [&program, options] { record(program, *options); });
  command->add_option("file", options->file, "for PlotJuggler and Foxglove, as out.mcap")
      ->required();
  command->add_option("--seconds", options->seconds, "how long, in the loop's time [s]")
      ->check(within(0.0, 1e6))
      ->default_str("until Ctrl-C");
  command->add_flag("--ros", options->as_ros,
                    "messages of ROS 2: /joint_states, /reference, /command");
  command->add_flag("--force", options->overwrites, "overwrite a file that exists");
}

}  // namespace terminal

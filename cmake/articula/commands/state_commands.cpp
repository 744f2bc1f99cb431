// SPDX-License-Identifier: Apache-2.0
/// @file status, watch, controllers: what the loop does.
#include "commands/joint_states.hpp"
#include "connection.hpp"
#include "files/within.hpp"
#include "program.hpp"
#include "table.hpp"

#include <CLI/CLI.hpp>

#include <unistd.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>

namespace terminal {

namespace {

/// The number of an array's place as a JSON number or null, and 0 if there is none.
Json at(const Json& message, const char* member, std::size_t place) {
  const auto found = message.find(member);
  if (found == message.end() || !found->is_array() || place >= found->size()) return nullptr;
  return (*found)[place];
}

std::string shown_at(const Json& message, const char* member, std::size_t place) {
  const Json number = at(message, member, place);
  return number.is_number() && std::isfinite(number.get<double>()) ? shown(number.get<double>())
                                                                   : "-";
}

Json joints_json(const Json& states) {
  Json joints = Json::array();
  const Json names = states.value("name", Json::array());
  for (std::size_t i = 0; i < names.size(); ++i) {
    joints.push_back({{"name", names[i]},
                      {"position", at(states, "position", i)},
                      {"reference_position", at(states, "reference_position", i)},
                      {"velocity", at(states, "velocity", i)},
                      {"effort", at(states, "effort", i)}});
  }
  return joints;
}

std::string joints_text(const Json& states) {
  std::vector<Row> rows{{"joint", "position", "reference", "velocity", "effort"}};
  const Json names = states.value("name", Json::array());
  for (std::size_t i = 0; i < names.size(); ++i) {
    rows.push_back({names[i].get<std::string>(), shown_at(states, "position", i),
                    shown_at(states, "reference_position", i), shown_at(states, "velocity", i),
                    shown_at(states, "effort", i)});
  }
  return table(rows);
}

std::string controllers_text(const Json& controllers) {
  std::vector<Row> rows;
  for (const Json& controller : controllers) {
    rows.push_back({controller.value("name", ""), controller.value("status", "")});
  }
  return rows.empty() ? "no controllers" : table(rows);
}

/// The answer without what every answer has.
Json contents(Json answer) {
  answer.erase("success");
  answer.erase("message");
  return answer;
}

void print_status(const Program& program) {
  Connection connection(program);
  Json robot = contents(connection.call("/robot"));
  const Json situation = contents(connection.call("/situation"));
  const Json statistics = contents(connection.call("/statistics"));
  const auto states = JointStates(connection).next(Connection::default_patience);
  if (!states) throw NoConnection("the server sends no states of the joints");
  robot.erase("urdf");  // long, and of no use here

  const bool is_simulated = robot.value("is_simulated", false);
  const std::string mode = situation.value("mode", ""), fault = situation.value("fault", "ok");
  const std::string operating = situation.value("operator", "");
  std::vector<Row> rows{
      {"robot", robot.value("name", "") + (is_simulated ? ", simulated" : "") + ", " +
                    shown(1 / robot.value("period", 1e-3)) + " Hz"},
      {"mode", mode + (situation.value("paused", false) ? ", paused" : "") +
                   (situation.value("speed", 1.0) != 1
                        ? ", time runs " + shown(situation.value("speed", 1.0)) + " times as fast"
                        : "")},
      {mode == "fault" || fault == "ok" ? "fault" : "last fault",
       fault == "ok" ? "none" : fault + ": " + situation.value("advice", "")},
      {"motion", situation.value("motion", "")},
      {"operator", operating.empty() ? "nobody" : operating},
      {"requests", situation.value("operates", false) ? "allowed" : "not allowed: read-only"},
      {"cycles", std::to_string(statistics.value("cycles", std::uint64_t{0})) + ", " +
                     std::to_string(statistics.value("overruns", std::uint64_t{0})) + " overruns"}};
  const auto durations = [&](const std::string& kind) {
    const auto part = [&](const char* which) {
      return shown_duration(statistics.value(kind + which, 0.0));
    };
    return "median " + part("_median") + ", 99 % " + part("_99") + ", longest " + part("_max");
  };
  rows.push_back({"latency", durations("latency")});
  rows.push_back({"update", durations("execution")});

  program.print({{"robot", robot},
                 {"situation", situation},
                 {"statistics", statistics},
                 {"joints", joints_json(*states)}},
                table(rows) + "\n\n" +
                    controllers_text(situation.value("controllers", Json::array())) + "\n\n" +
                    joints_text(*states));
}

/// Prints states until Ctrl-C, or for a time.
void watch(const Program& program, double rate, double seconds) {
  Connection connection(program);
  connection.note_pause();
  JointStates joint_states(connection);
  end_on_signal();
  const bool is_screen = !program.json && isatty(fileno(stdout)) != 0;
  double first = -1, due = 0;
  while (!is_ended()) {
    const auto states = joint_states.next(Connection::default_patience);
    if (is_ended()) break;
    if (!states) {
      if (connection.call("/situation").value("paused", false)) continue;
      throw NoConnection("the server sends no states of the joints any more");
    }
    const Json stamp = states->value("header", Json::object()).value("stamp", Json::object());
    const double now = stamp.value("sec", 0.0) + 1e-9 * stamp.value("nsec", 0.0);
    if (first < 0) first = due = now;
    if (now - first > seconds) break;
    if (now < due) continue;
    due = std::max(due + 1 / rate, now);
    if (program.json) {
      program.print({{"time", now - first}, {"joints", joints_json(*states)}}, "");
    } else {
      if (is_screen) std::fputs("\x1b[H\x1b[J", stdout);  // in place of what was there before
      program.print({}, joints_text(*states) + (is_screen ? "" : "\n"));
    }
  }
}

}  // namespace

void add_state_commands(CLI::App& app, Program& program) {
  add_command(app, program, "status", "Shows robot, mode, fault, controllers, timing and joints.",
              [&program] { print_status(program); });
  add_command(
      app, program, "controllers", "Lists the controllers and what they are doing.", [&program] {
        Connection connection(program);
        const Json controllers = connection.call("/situation").value("controllers", Json::array());
        program.print({{"controllers", controllers}}, controllers_text(controllers));
      });

  struct Watch {
    double rate = 5, seconds = 1e6;
  };
  const auto options = std::make_shared<Watch>();
  CLI::App* command =
      add_command(app, program, "watch", "Prints the state of the joints until Ctrl-C.",
                  [&program, options] { watch(program, options->rate, options->seconds); });
  command->add_option("--rate", options->rate, "times a second")
      ->check(within(0.01, 60.0))
      ->capture_default_str();
  command->add_option("--seconds", options->seconds, "how long [s]")
      ->check(within(0.0, 1e6))
      ->default_str("until Ctrl-C");
}

}  // namespace terminal

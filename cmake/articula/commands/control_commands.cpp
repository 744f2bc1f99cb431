// SPDX-License-Identifier: Apache-2.0
/// @file activate, deactivate, stop, fault ack, switch: what the loop shall do.
#include "connection.hpp"
#include "program.hpp"

#include <CLI/CLI.hpp>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace terminal {

namespace {

/// A command that calls a service without arguments.
void add_plain_command(CLI::App& parent, Program& program, const std::string& name,
                       const std::string& description, const std::string& service) {
  add_command(parent, program, name, description, [&program, service] {
    Connection connection(program);
    const Json answer = connection.operate(service);
    const std::string message = answer.value("message", "");
    program.print(answer, message.empty() ? "done" : message);
  });
}

}  // namespace

void add_control_commands(CLI::App& app, Program& program) {
  add_plain_command(app, program, "activate", "Activates the loop: the joints are controlled.",
                    "/activate");
  add_plain_command(app, program, "deactivate", "Deactivates the loop.", "/deactivate");

  const auto stopped = std::make_shared<std::vector<std::string>>();
  add_command(app, program, "stop", "Stops joints as fast as the limits allow.",
              [&program, stopped] {
                Connection connection(program);
                program.print(connection.operate("/stop", {{"joints", *stopped}}), "done");
              })
      ->add_option("joints", *stopped, "those that stop; without them, all")
      ->type_name("JOINT");

  CLI::App* fault = app.add_subcommand("fault", "Faults of the loop.")->require_subcommand(1);
  fault->fallthrough();
  add_plain_command(*fault, program, "ack", "Acknowledges the fault; the loop is inactive then.",
                    "/acknowledge_fault");

  struct Switch {
    std::vector<std::string> start, stop;
    bool best_effort = false, replace = false;
  };
  const auto options = std::make_shared<Switch>();
  CLI::App* command = add_command(
      app, program, "switch", "Starts and stops controllers, without a step of the command.",
      [&program, options] {
        if (options->start.empty() && options->stop.empty()) {
          throw WrongUsage("switch: name a controller by --start or --stop");
        }
        Connection connection(program);
        Json answer =
            connection.operate("/switch_controllers", {{"start", options->start},
                                                       {"stop", options->stop},
                                                       {"best_effort", options->best_effort},
                                                       {"replace", options->replace}});
        const std::string message = answer.value("message", "");
        program.print(answer, message.empty() ? "done" : message);
      });
  command->add_option("--start", options->start, "a controller to start")->type_name("CONTROLLER");
  command->add_option("--stop", options->stop, "a controller to stop")->type_name("CONTROLLER");
  command->add_flag("--best-effort", options->best_effort,
                    "do what can be done, instead of all or nothing");
  command->add_flag("--replace", options->replace, "stop what is active on the same joints");
}

}  // namespace terminal

// SPDX-License-Identifier: Apache-2.0
/// @file What the commands of the program articula have in common.
#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace terminal {

/// JSON whose members stay in the order in which they were written.
using Json = nlohmann::ordered_json;

/// What the program returns to the shell.
enum ExitCode : int {
  done = 0,
  refused = 1,        ///< the loop, or a file, does not allow it
  wrong_usage = 2,    ///< the command line
  no_connection = 3,  ///< no server, or not one that can be talked to
};

/// Something that the loop refused, or a file that cannot be used.
struct Refusal : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// A command line that makes no sense.
struct WrongUsage : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// No server, or not one that can be talked to.
struct NoConnection : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The options of all commands, and the command that was chosen.
struct Program {
  std::string address = "127.0.0.1";
  std::uint16_t port = 8765;
  std::string token{};
  bool json = false;

  /// Set by the command line's command.
  std::function<void()> command{};

  /// Prints a result: one JSON document with --json, else the text, with a line break after each.
  void print(const Json& document, const std::string& text) const;
};

/// Adds a command. Its function runs after all of the command line is known to be good.
CLI::App* add_command(CLI::App& parent, Program& program, const std::string& name,
                      const std::string& description, std::function<void()> function);

/// The types of options and arguments whose names a shell completes from the running loop. An
/// option gets its type by CLI::Option::type_name.
inline const std::vector<std::string> named_values{"CONTROLLER", "GAIN",        "GAIN=VALUE",
                                                   "JOINT",      "JOINT=VALUE", "LINK"};

void add_state_commands(CLI::App& app, Program& program);
void add_control_commands(CLI::App& app, Program& program);
void add_gain_commands(CLI::App& app, Program& program);
void add_motion_commands(CLI::App& app, Program& program);
void add_simulation_commands(CLI::App& app, Program& program);
void add_record_command(CLI::App& app, Program& program);
void add_joints_command(CLI::App& app, Program& program);
void add_run_command(CLI::App& app, Program& program);
void add_simulate_command(CLI::App& app, Program& program);
void add_sweep_command(CLI::App& app, Program& program);
void add_new_command(CLI::App& app, Program& program);
void add_names_command(CLI::App& app, Program& program);
void add_completion_command(CLI::App& app, Program& program);

}  // namespace terminal

// SPDX-License-Identifier: Apache-2.0
/// @file articula: running loops from a terminal, and robots from files. docs/terminal.md.
///
/// Exit status: 0 done, 1 refused, 2 wrong usage, 3 no connection.
#include "program.hpp"

#include <articula/text/characters.hpp>
#include <articula/text/similar_word.hpp>
#include <articula/version.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <utility>
#include <vector>

namespace terminal {

void Program::print(const Json& document, const std::string& text) const {
  const std::string line =
      json ? document.dump(-1, ' ', false, Json::error_handler_t::replace) : text;
  std::printf("%s\n", line.c_str());
  if (std::fflush(stdout) != 0) throw Refusal("the output cannot be written");
}

CLI::App* add_command(CLI::App& parent, Program& program, const std::string& name,
                      const std::string& description, std::function<void()> function) {
  CLI::App* command = parent.add_subcommand(name, description);
  command->fallthrough();
  command->callback([&program, function = std::move(function)] { program.command = function; });
  return command;
}

namespace {

/// Tells why a command was not done, in one line.
int tell(const Program& program, ExitCode code, std::string message) {
  while (!message.empty() && message.back() == '\n') message.pop_back();
  if (program.json) {
    std::printf("%s\n", Json{{"success", false}, {"message", message}, {"exit_code", int{code}}}
                            .dump(-1, ' ', false, Json::error_handler_t::replace)
                            .c_str());
  } else {
    std::fprintf(stderr, "articula: %s\n", message.c_str());
  }
  return code;
}

/// The innermost command of a command line, or the program.
const CLI::App& command_of(const CLI::App& app) {
  const CLI::App* command = &app;
  while (!command->get_subcommands().empty()) command = command->get_subcommands().front();
  return *command;
}

/// A command and those that it belongs to, as "gains set".
std::string words_of(const CLI::App& command) {
  const CLI::App* const parent = command.get_parent();
  const bool is_inner = parent != nullptr && parent->get_parent() != nullptr;
  return (is_inner ? words_of(*parent) + " " : "") + command.get_name();
}

/// What is wrong with a command line that lacks something which is required.
std::string lack_of(const CLI::App& app, const CLI::RequiredError& error) {
  const CLI::App& parent = command_of(app);
  std::vector<std::string> names;
  for (const CLI::App* command : parent.get_subcommands([](const CLI::App* each) {
         return !each->get_group().empty();  // not hidden
       })) {
    names.push_back(command->get_name());
  }
  if (names.empty()) {  // an argument of a command
    return std::string(error.what()) + ", see: articula " + words_of(parent) + " --help";
  }
  const std::vector<std::string> words = app.remaining(true);
  const std::string word = words.empty() || words.front().starts_with('-') ? "" : words.front();
  return (word.empty() ? "a command is missing"
                       : "there is no command " + articula::detail::quoted_text(word)) +
         ", expected one such as: articula " +
         (&parent == &app ? "go shoulder_active_joint=0.5"
                          : parent.get_name() + " " + names.front()) +
         articula::detail::choice_of(word, "commands", names);
}

/// What is wrong with a command line that has more than its command takes.
std::string excess_of(const CLI::App& app) {
  const CLI::App& command = command_of(app);
  std::vector<std::string> names;
  for (const CLI::App* each = &command; each != nullptr; each = each->get_parent()) {
    for (const CLI::Option* option : each->get_options()) {
      const std::string name = option->get_name();
      const bool is_new = std::find(names.begin(), names.end(), name) == names.end();
      if (option->nonpositional() && is_new) names.push_back(name);
    }
  }
  const std::vector<std::string> words = app.remaining(true);
  const std::string word = words.empty() ? "" : words.front();
  return words_of(command) + " takes no " + articula::detail::quoted_text(word) +
         articula::detail::choice_of(word, "options", names);
}

int run(int count, char** words) {
  Program program;
  CLI::App app("articula: running control loops from a terminal, and robots from files");
  app.name("articula");
  app.require_subcommand(1);
  app.set_version_flag("--version", "articula " + std::string(articula::library_version));
  app.add_option("--address", program.address, "of the loop's program")->capture_default_str();
  app.add_option("--port", program.port, "of the loop's program; run takes a free one for 0")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  app.add_option("--token", program.token, "of the loop's program, if it has one")
      ->envname("ARTICULA_TOKEN");
  app.add_flag("--json", program.json, "print one JSON document for each result");
  app.footer("exit status: 0 done, 1 refused, 2 wrong usage, 3 no connection");
  add_state_commands(app, program);
  add_control_commands(app, program);
  add_gain_commands(app, program);
  add_motion_commands(app, program);
  add_simulation_commands(app, program);
  add_record_command(app, program);
  add_joints_command(app, program);
  add_run_command(app, program);
  add_simulate_command(app, program);
#ifdef ARTICULA_PROGRAM_HAS_SWEEP
  add_sweep_command(app, program);
#endif
  add_new_command(app, program);
  add_names_command(app, program);
  add_completion_command(app, program);
  // Known before the command line is parsed, whose faults are told as JSON, too.
  for (int i = 1; i < count; ++i) program.json = program.json || std::string(words[i]) == "--json";
  try {
    app.parse(count, words);
    program.command();
    return done;
  } catch (const CLI::RequiredError& error) {
    return tell(program, wrong_usage, lack_of(app, error));
  } catch (const CLI::ExtrasError&) {
    return tell(program, wrong_usage, excess_of(app));
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    return tell(program, wrong_usage, error.what());
  } catch (const WrongUsage& error) {
    return tell(program, wrong_usage, error.what());
  } catch (const NoConnection& error) {
    return tell(program, no_connection, error.what());
  } catch (const std::exception& error) {
    return tell(program, refused, error.what());
  }
}

}  // namespace

}  // namespace terminal

int main(int count, char** words) { return terminal::run(count, words); }

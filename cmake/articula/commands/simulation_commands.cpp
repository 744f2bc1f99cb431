// SPDX-License-Identifier: Apache-2.0
/// @file pause, resume, step, speed, reset, pull: requests that only simulations understand.
#include "connection.hpp"
#include "files/joint_values.hpp"
#include "files/within.hpp"
#include "program.hpp"

#include <CLI/CLI.hpp>

#include <chrono>
#include <functional>
#include <memory>
#include <vector>

namespace terminal {

namespace {

/// A command that calls a service with what `request` makes of its options.
CLI::App* add_call(CLI::App& app, Program& program, const std::string& name,
                   const std::string& description, const std::string& service,
                   std::function<Json()> request) {
  return add_command(app, program, name, description,
                     [&program, service, request = std::move(request)] {
                       const Json arguments = request();
                       Connection connection(program);
                       const Json answer = connection.operate(service, arguments);
                       const std::string message = answer.value("message", "");
                       program.print(answer, message.empty() ? "done" : message);
                     });
}

struct Pull {
  std::string link{};
  std::vector<double> point{0, 0, 0}, force{};
  double seconds = 1;
};

void pull(const Program& program, const Pull& options) {
  Connection connection(program);
  end_on_signal();
  Json request{{"link", options.link}, {"point", options.point}, {"force", options.force}};
  const Json answer = connection.call("/pull", request);
  const auto end = std::chrono::steady_clock::now() +
                   std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                       std::chrono::duration<double>(options.seconds));
  while (!is_ended() && std::chrono::steady_clock::now() < end) connection.next(0.02);
  request["force"] = {0, 0, 0};
  connection.operate("/pull", request);
  const std::string message = answer.value("message", "");
  program.print(answer, message.empty() ? "done" : message);
}

}  // namespace

void add_simulation_commands(CLI::App& app, Program& program) {
  add_call(app, program, "pause", "Stops the simulated time.", "/pause",
           [] { return Json{{"paused", true}}; });
  add_call(app, program, "resume", "Continues the simulated time.", "/pause",
           [] { return Json{{"paused", false}}; });

  const auto cycles = std::make_shared<int>(1);
  add_call(app, program, "step", "Makes some cycles while the simulated time is stopped.", "/step",
           [cycles] { return Json{{"cycles", *cycles}}; })
      ->add_option("cycles", *cycles, "how many")
      ->check(within(1, 1000000))
      ->capture_default_str();

  const auto factor = std::make_shared<double>(1);
  add_call(app, program, "speed", "Sets the simulated time that passes in a second.", "/set_speed",
           [factor] { return Json{{"factor", *factor}}; })
      ->add_option("factor", *factor, "0.01 to 100")
      ->required()
      ->check(within(0.01, 100.0));

  const auto positions = std::make_shared<std::vector<std::string>>();
  add_call(app, program, "reset", "Puts the simulated robot at rest into a position.", "/reset",
           [positions] { return Json{{"positions", values_by_name(*positions, "joint")}}; })
      ->add_option("positions", *positions, "as shoulder=0.5 [rad or m]; other joints at 0")
      ->type_name("JOINT=VALUE");

  const auto options = std::make_shared<Pull>();
  CLI::App* command = add_command(app, program, "pull", "Pulls at a link of the simulated robot.",
                                  [&program, options] { pull(program, *options); });
  command->add_option("link", options->link, "the link")->required()->type_name("LINK");
  command->add_option("--force", options->force, "x y z in the root link's frame [N]")
      ->required()
      ->expected(3);
  command->add_option("--point", options->point, "x y z in the link's frame [m]")
      ->expected(3)
      ->default_str("its origin");
  command->add_option("--seconds", options->seconds, "how long, of real time [s]")
      ->check(within(0.0, 1e6))
      ->capture_default_str();
}

}  // namespace terminal

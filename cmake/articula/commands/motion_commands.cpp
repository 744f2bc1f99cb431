// SPDX-License-Identifier: Apache-2.0
/// @file go, publish, play: motion of the reference.
#include "commands/joint_states.hpp"
#include "connection.hpp"
#include "files/joint_values.hpp"
#include "files/trajectory_file.hpp"
#include "files/within.hpp"
#include "program.hpp"
#include "table.hpp"

#include <CLI/CLI.hpp>

#include <chrono>
#include <cmath>
#include <iostream>
#include <memory>
#include <vector>

namespace terminal {

namespace {

void print_answer(const Program& program, const Json& answer) {
  const std::string message = answer.value("message", "");
  program.print(answer, message.empty() ? "done" : message);
}

/// Waits for the end of a motion: until the situation has been another one for a moment, since an
/// answer may be earlier than the situation.
void wait_while(Connection& connection, const std::string& motion) {
  end_on_signal();
  for (int others = 0; others < 3;) {
    const Json situation = connection.call("/situation");
    if (situation.value("mode", "") == "fault") {
      throw Refusal("the loop has a fault: " + situation.value("fault", "") + ": " +
                    situation.value("advice", ""));
    }
    others = situation.value("motion", "") == motion ? 0 : others + 1;
    if (is_ended()) {
      connection.operate("/stop");
      throw Refusal("stopped by Ctrl-C");
    }
    connection.next(0.1);
  }
}

/// Where joints and reference are after a motion. The reference is elsewhere if another request took
/// it there, and goes along with a joint that no controller moves to it.
void check_arrival(Connection& connection, const Json& targets) {
  const auto states = JointStates(connection).next(Connection::default_patience);
  if (!states) return;
  const Json &names = states->at("name"), &references = states->at("reference_position");
  for (std::size_t i = 0; i < references.size(); ++i) {  // mimic joints come behind them
    const auto target = targets.find(names.at(i).get<std::string>());
    const Json &position = states->at("position").at(i), &reference = references.at(i);
    if (target == targets.end() || !position.is_number() || !reference.is_number()) continue;
    const double wanted = target->get<double>();
    constexpr double rounding = 1e-6, far = 0.05;  // [rad or m]; the usual error of a controller
    if (std::abs(reference.get<double>() - wanted) > rounding) {
      throw Refusal("go: the reference of joint '" + target.key() + "' is at " +
                    shown(reference.get<double>()) + ", not at " + shown(wanted) +
                    ": another request has ended the motion, or no active controller follows it");
    }
    if (std::abs(position.get<double>() - wanted) > far) {
      std::cerr << "note: joint '" << target.key() << "' is at " << shown(position.get<double>())
                << ", its reference at " << shown(wanted)
                << ": the controller needs more time or effort; 'articula status' shows both\n";
    }
  }
}

void go(const Program& program, const std::vector<std::string>& arguments, double speed,
        bool waits) {
  if (arguments.empty()) {
    throw WrongUsage(
        "go: give joints and their positions, as in: articula go shoulder_active_joint=0.5");
  }
  const Json request{{"positions", values_by_name(arguments, "joint")}, {"speed", speed}};
  Connection connection(program);
  if (!waits) return print_answer(program, connection.operate("/go", request));
  connection.refuse_pause();
  const Json answer = connection.call("/go", request);
  wait_while(connection, "go");
  connection.call("/release_controls");
  check_arrival(connection, request["positions"]);
  print_answer(program, answer);
}

struct Publication {
  std::vector<std::string> positions, velocities, efforts;
  double rate = 0, seconds = 1e6;
};

void publish(const Program& program, const Publication& publication) {
  const Json request{{"positions", values_by_name(publication.positions, "joint")},
                     {"velocities", values_by_name(publication.velocities, "joint")},
                     {"efforts", values_by_name(publication.efforts, "joint")}};
  if (request["positions"].empty() && request["velocities"].empty() && request["efforts"].empty()) {
    throw WrongUsage("publish: give joint=position, --velocity or --effort");
  }
  Connection connection(program);
  if (publication.rate == 0) {
    return print_answer(program, connection.operate("/set_reference", request));
  }
  end_on_signal();
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  std::uint64_t count = 0;
  while (!is_ended() && elapsed() < publication.seconds) {
    connection.call("/set_reference", request);
    ++count;
    const double wait = static_cast<double>(count) / publication.rate - elapsed();
    if (wait > 0) connection.next(wait);
  }
  connection.call("/release_controls");
  program.print({{"success", true}, {"published", count}},
                "published " + std::to_string(count) + " times");
}

/// A signal of the same shape on some joints.
struct SignalPlan {
  std::vector<std::string> heights;
  bool is_step = false, is_effort = false;
  double ramp = 0, sine = 0, square = 0;  ///< 0: not this one
  std::vector<double> chirp;              ///< first and last frequency [Hz]; empty: not this one
  double seconds = 10;
};

/// The members of the signal that do not depend on the joint.
Json shape_of(const SignalPlan& plan) {
  std::vector<Json> shapes;
  if (plan.is_step) shapes.push_back({{"kind", "step"}});
  if (plan.ramp > 0) shapes.push_back({{"kind", "ramp"}, {"duration", plan.ramp}});
  if (plan.sine > 0) shapes.push_back({{"kind", "sine"}, {"frequency", plan.sine}});
  if (plan.square > 0) shapes.push_back({{"kind", "square"}, {"frequency", plan.square}});
  if (!plan.chirp.empty()) {
    shapes.push_back({{"kind", "chirp"},
                      {"first_frequency", plan.chirp[0]},
                      {"last_frequency", plan.chirp[1]},
                      {"duration", plan.seconds}});
  }
  if (shapes.size() != 1) {
    throw WrongUsage("signal: give one of --step, --ramp, --sine, --square and --chirp");
  }
  return shapes.front();
}

void play_signal(const Program& program, const SignalPlan& plan) {
  Json signals = Json::array();
  const Json shape = shape_of(plan);
  const std::string kind = shape.at("kind");
  const char* size = kind == "step" || kind == "ramp" ? "height" : "amplitude";
  const Json heights = values_by_name(plan.heights, "joint");
  for (const auto& [joint, value] : heights.items()) {
    Json signal = shape;
    signal["joint"] = joint;
    signal[size] = value;
    if (plan.is_effort) signal["target"] = "effort";
    signals.push_back(signal);
  }
  Connection connection(program);
  connection.refuse_pause();
  constexpr double one_day = 86400;  // the simulated time may be slow, or paused
  print_answer(program, connection.operate("/play_signals",
                                           {{"signals", signals}, {"duration", plan.seconds}},
                                           plan.seconds + one_day));
}

}  // namespace

void add_motion_commands(CLI::App& app, Program& program) {
  struct Go {
    std::vector<std::string> positions;
    double speed = 1;
    bool waits = false;
  };
  const auto options = std::make_shared<Go>();
  CLI::App* command = add_command(
      app, program, "go", "Moves joints along a jerk-limited profile; the others rest.",
      [&program, options] { go(program, options->positions, options->speed, options->waits); });
  command->add_option("positions", options->positions, "one or more, as shoulder=0.5 [rad or m]")
      ->type_name("JOINT=VALUE");
  command->add_option("--speed", options->speed, "share of the velocity limits, 0.01 to 1")
      ->check(within(0.01, 1.0))
      ->capture_default_str();
  command->add_flag("--wait", options->waits,
                    "wait for the end; Ctrl-C, or the end of this program, stops the motion");

  const auto publication = std::make_shared<Publication>();
  command = add_command(app, program, "publish", "Sets the reference at once, or again and again.",
                        [&program, publication] { publish(program, *publication); });
  command->add_option("positions", publication->positions, "as shoulder=0.5 [rad or m]")
      ->type_name("JOINT=VALUE");
  command->add_option("--velocity", publication->velocities, "as shoulder=0.1 [rad/s or m/s]")
      ->type_name("JOINT=VALUE");
  command->add_option("--effort", publication->efforts, "as shoulder=2 [N m or N]")
      ->type_name("JOINT=VALUE");
  command->add_option("--rate", publication->rate, "times a second, until Ctrl-C")
      ->check(within(0.01, 1000.0))
      ->default_str("once");
  command->add_option("--seconds", publication->seconds, "how long, with --rate [s]")
      ->check(within(0.0, 1e6))
      ->needs("--rate")
      ->default_str("until Ctrl-C");

  const auto plan = std::make_shared<SignalPlan>();
  command = add_command(app, program, "signal",
                        "Adds a signal to the reference of joints, and waits for its end.",
                        [&program, plan] { play_signal(program, *plan); });
  command
      ->add_option("heights", plan->heights,
                   "height or amplitude, as elbow=0.1 [rad or m; N m or N]")
      ->required()
      ->type_name("JOINT=VALUE");
  command->add_flag("--step", plan->is_step, "a step at once");
  command->add_option("--ramp", plan->ramp, "a ramp, its duration [s]")->check(within(1e-3, 1e6));
  command->add_option("--sine", plan->sine, "its frequency [Hz]")->check(within(1e-3, 1000.0));
  command->add_option("--square", plan->square, "its frequency [Hz]")->check(within(1e-3, 1000.0));
  command->add_option("--chirp", plan->chirp, "its first and last frequency [Hz]")
      ->expected(2)
      ->check(within(1e-3, 1000.0));
  command->add_flag("--effort", plan->is_effort, "of the effort, in place of the position");
  command->add_option("--seconds", plan->seconds, "how long [s]")
      ->check(within(1e-3, 1e6))
      ->capture_default_str();

  const auto file = std::make_shared<std::string>();
  command = add_command(
      app, program, "play",
      "Follows a trajectory and waits for its end. The end of this program stops the motion.",
      [&program, file] {
        const Json trajectory = read_trajectory_file(*file);
        Connection connection(program);
        connection.refuse_pause();
        constexpr double one_day = 86400;  // the simulated time may be slow, or paused
        print_answer(program, connection.operate("/play_trajectory", trajectory,
                                                 duration_of(trajectory) + one_day));
      });
  command->add_option("file", *file, "trajectory_msgs/JointTrajectory in YAML or JSON")->required();
}

}  // namespace terminal

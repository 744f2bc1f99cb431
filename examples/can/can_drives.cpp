// SPDX-License-Identifier: Apache-2.0
/// @file Simulates the Quanser arm and its drives on a CAN interface.
#include "bench.hpp"

#include "articula/loop/realtime/stop_on_signal.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <exception>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

using namespace articula;
using namespace articula::examples;

namespace {

/// Reads the command line.
/// @return empty after printing help
/// @throws std::invalid_argument with the invalid option
std::optional<BenchOptions> parse_options(int argc, const char* const* argv) {
  BenchOptions options;
  std::string protocol = "quanser";
  std::array<double, 2> initial{};
  std::vector<std::string> faults;
  CLI::App app{
      "Simulates the Quanser arm and its drives on a CAN interface until interrupted. "
      "Time passes with each SYNC, and by the clock while SYNC is missing."};
  app.add_option("--interface", options.interface, "The CAN interface")
      ->type_name("NAME")
      ->capture_default_str();
  app.add_option("--protocol", protocol, "Protocol of the drives: quanser or cia402")
      ->type_name("NAME")
      ->check(CLI::IsMember({"quanser", "cia402"}))
      ->capture_default_str();
  app.add_option("--initial", initial, "Initial position of shoulder and elbow [rad]")
      ->type_name("J1,J2")
      ->delimiter(',');
  app.add_option("--duration", options.duration, "Duration [s]; 0: until interrupted")
      ->type_name("T")
      ->capture_default_str();
  app.add_flag("--lockstep", options.lockstep, "Time passes only with SYNC, never by the clock");
  app.add_option(
         "--sync-period", options.sync_period,
         "Period of SYNC from the drives, by the clock, 0.001 to 1 s; 0: the host sends SYNC. "
         "CiA 402 only")
      ->type_name("T")
      ->capture_default_str();
  app.add_option("--seed", options.seed, "Seed of the random bytes")
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--fault", faults,
                 "A fault, KIND[:JOINT]@START[+DURATION] in seconds of the "
                 "drives' time, joints 1 and 2: silence, garbage, delay (5 ms), fault, restart, "
                 "bus-off, no-sync; may be repeated")
      ->type_name("FAULT");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& asked_for_help) {
    app.exit(asked_for_help);
    return {};
  } catch (const CLI::ParseError& error) {
    throw std::invalid_argument(error.what());
  }
  options.cia402 = protocol == "cia402";
  options.simulator.initial_position = JointVector<2>(initial.data());
  if (!is_finite(options.duration) || options.duration < 0) {
    throw std::invalid_argument("--duration: not a number of at least 0");
  }
  if (options.sync_period != 0) {
    if (!(options.sync_period >= 1e-3 && options.sync_period <= 1)) {
      throw std::invalid_argument("--sync-period: not a number from 0.001 to 1, or 0");
    }
    if (!options.cia402) throw std::invalid_argument("--sync-period: only for CiA 402");
    if (options.lockstep) {
      throw std::invalid_argument("--sync-period: SYNC by the clock excludes --lockstep");
    }
    // One period between two SYNC, integrated in steps of a millisecond.
    options.simulator.substeps = static_cast<int>(std::ceil(options.sync_period / 1e-3));
    options.simulator.period = options.sync_period;
  }
  for (const std::string& fault : faults) options.faults.push_back(parse_fault(fault, 2));
  validate(Q2d(), options.simulator);
  return options;
}

template <class Protocol>
void play(const BenchOptions& options) {
  StopFlag stop;
  const StopOnSignal stop_on_signal(stop);
  Bench<Protocol> bench(options);
  std::cout << "playing on " << options.interface << std::endl;
  const BenchReport report = bench.play(stop);
  std::cout << report.syncs << " cycles, " << report.silent_periods << " periods without, "
            << report.sent << " frames sent, " << report.not_sent << " not; arm at "
            << report.position.transpose() << " rad, highest effort "
            << report.highest_effort.transpose() << " N m" << std::endl;
}

int complain(std::string message, int exit_status) {
  std::ranges::replace_if(message, [](unsigned char c) { return std::iscntrl(c); }, ' ');
  std::cerr << "can_drives: " << message << '\n';
  return exit_status;
}

}  // namespace

/// @return 0; 1 if the interface fails; 2 for invalid options
int main(int argc, char** argv) try {
  const std::optional<BenchOptions> options = parse_options(argc, argv);
  if (!options) return 0;
  if (options->cia402) {
    play<Cia402Protocol>(*options);
  } else {
    play<QuanserProtocol>(*options);
  }
  return 0;
} catch (const std::invalid_argument& error) {
  return complain(error.what(), 2);
} catch (const std::exception& error) {
  return complain(error.what(), 1);
}

// SPDX-License-Identifier: Apache-2.0
/// @file The controllers that a configuration file of ROS names, and the classes that they mean.
#pragma once

#include <articula/config/read/controller_config.hpp>
#include <articula/config/yaml/source.hpp>
#include <articula/model/vector3.hpp>

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace terminal {

/// A controller class of articula.
enum class ControllerKind : unsigned char {
  bypass,
  pid,
  pid_plus_gravity,
  computed_torque,
  velocity_by_effort,
  position_by_velocity,
  forward_velocity,
  forward_position,
};

/// What drives take.
enum class Drives : unsigned char { efforts, velocities, positions };

/// What a class is called, what it needs and what it commands.
struct KindTraits {
  std::string_view class_name{};  ///< as "PidPlusGravity"
  std::string_view name{};        ///< as "pid_plus_gravity"
  bool has_gains = false;
  Drives drives = Drives::efforts;
};
[[nodiscard]] const KindTraits& traits_of(ControllerKind kind);

/// A controller of the file.
struct PlannedController {
  std::string name{};     ///< by which it is switched
  std::string section{};  ///< by which load_pid_gains finds its parameters; empty: it has none
  ControllerKind kind{};
  articula::ControllerConfig config{};  ///< without joints it acts on all
  bool has_tolerances = false;          ///< of trajectories, for load_trajectory_tolerances
};

/// What a file says about a loop.
struct ControllersPlan {
  articula::ConfigSource source{""};  ///< the file, and values of its placeholders
  double period = 1e-3;               ///< [s]
  int substeps = 1;                   ///< of a simulation, in a period
  int priority = 0;                   ///< of the loop's thread; 0: as any other
  std::vector<int> processors{};
  std::optional<articula::Vector3<double>> gravity{};  ///< free fall, in the root's frame [m/s^2]
  std::string root{}, tip{};                           ///< of the chain of joints; empty: all
  Drives drives = Drives::efforts;
  std::vector<PlannedController> controllers{};
  std::vector<std::string> notes{};  ///< what has no effect, a line each
};

/// The sections of controllers that have tolerances of trajectories, in the order of the file.
[[nodiscard]] std::vector<std::string> sections_with_tolerances(const ControllersPlan& plan);

/// So many steps of a simulation in a period that none is longer than a millisecond.
[[nodiscard]] int default_substeps(double period);

/// Reads the controllers that the file's controller_manager lists; of a file without one, its only
/// controller. Controllers of a kind that there is not, and those that command something else than
/// the first one, are left out with a note.
/// @param chosen  names of the controllers to read, of which none is left out; empty: all
/// @throws articula::FileError with file, line, key and what was expected; Refusal if no controller
///         remains, or one that is chosen cannot be used
[[nodiscard]] ControllersPlan read_controllers(const articula::ConfigSource& source,
                                               const std::vector<std::string>& chosen = {});

/// One source of the YAML files that a command line names.
/// @throws Refusal if one of them is a robot
[[nodiscard]] articula::ConfigSource controllers_source(const std::vector<std::string>& files,
                                                        const articula::ConfigValues& values);

/// Adds the option for values of placeholders in a controllers' file.
void add_values_option(CLI::App& command, articula::ConfigValues& values);

}  // namespace terminal

// SPDX-License-Identifier: Apache-2.0
/// @file Loads waveforms for joints from a file. Needs the CMake target articula::config
/// (yaml-cpp).
#pragma once

#include "articula/config/read/find_sections.hpp"
#include "articula/config/read/read_signals.hpp"
#include "articula/config/read/robot_joints.hpp"
#include "articula/config/read/section.hpp"
#include "articula/config/yaml/source.hpp"

#include <string_view>

namespace articula {

/// Loads waveforms for a robot's joints, for example from the PR2's controller tutorial:
///
///     waveforms:
///       r_shoulder_pan_joint: {type: sine, amplitude: 2.0, frequency: 0.5}   # N m, Hz
///
///     const SignalConfig config = load_signals(Pr2(), "pr2_waveforms.yaml");
///     const JointSignals<Pr2> waves(config.signals);
///
/// Waveforms are efforts, or positions with `target: position`. Layouts and keys:
/// docs/configuration.md.
/// @param source  a file, or a ConfigSource::text
/// @param name    of the section; empty: all waveforms of the file
/// @throws FileError with file, line, key and what was expected: for an unknown joint or key, a
///         signal that cannot be evaluated, or no waveform at all
/// @throws FileError likewise if an effort is beyond the drive's limit, alone or summed up
/// Real-time: no (reads a file, allocates, throws).
template <Robot R>
[[nodiscard]] SignalConfig load_signals(const R& robot, const ConfigSource& source,
                                        std::string_view name = {}) {
  detail::ConfigSections all = detail::find_sections(source, name);
  const detail::RobotJoints joints = detail::joints_of(robot);
  const auto relevant = [&](const detail::ConfigSection& section) {
    return section.parameters.has_any({"waveforms", "amplitude", "height"}) ||
           detail::is_joint(section, joints) ||
           detail::misplaced_waveforms(section.parameters, joints) != nullptr ||
           detail::misspelt_waveforms(section.parameters) != nullptr;
  };
  const auto limits = effort_limits(robot);
  detail::SignalReader reader(joints, {limits.data(), limits.data() + limits.size()});
  for (const auto& section :
       detail::chosen_sections(all, {name, "section of waveforms", relevant})) {
    reader.read(section);
  }
  reader.finish();
  SignalConfig config = reader.take();
  config.notes.insert(config.notes.begin(), all.notes.begin(), all.notes.end());
  return config;
}

}  // namespace articula

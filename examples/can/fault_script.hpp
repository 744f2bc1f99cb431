// SPDX-License-Identifier: Apache-2.0
/// @file Scripted faults of the drives on the bus: kinds and times.
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace articula::examples {

/// Kinds of faults.
enum class FaultKind {
  silence,  ///< a drive sends no frames
  garbage,  ///< a drive's feedback is replaced by frames of random bytes
  delay,    ///< all frames are sent 5 ms late
  fault,    ///< a drive faults by itself
  restart,  ///< a drive loses its supply briefly
  no_sync,  ///< the drives send no SYNC
  bus_off,  ///< the controllers report bus-off
};

/// One fault: `kind[:joint]@start[+duration]`, joints counted from 1, times in seconds.
struct ScriptedFault {
  FaultKind kind = FaultKind::silence;
  int joint = 0;        ///< index; -1: all
  double start = 0;     ///< by the drives' time [s]
  double duration = 0;  ///< [s]; 0: once, or until the end

  [[nodiscard]] bool applies_to(int which) const { return joint < 0 || joint == which; }
  [[nodiscard]] bool is_on(double time) const {
    return time >= start && (duration == 0 || time < start + duration);
  }
};

namespace detail {

/// The name of a kind, and whether it is for one drive.
struct FaultName {
  std::string_view name;
  FaultKind kind;
  bool has_joint;
};
inline constexpr std::array fault_names{
    FaultName{"silence", FaultKind::silence, true},
    FaultName{"garbage", FaultKind::garbage, true},
    FaultName{"delay", FaultKind::delay, false},
    FaultName{"fault", FaultKind::fault, true},
    FaultName{"restart", FaultKind::restart, true},
    FaultName{"bus-off", FaultKind::bus_off, false},
    FaultName{"no-sync", FaultKind::no_sync, false},
};

}  // namespace detail

/// Reads a fault.
/// @throws std::invalid_argument with the invalid part
[[nodiscard]] inline ScriptedFault parse_fault(const std::string& text, int joints) {
  const auto refuse = [&](const std::string& why) -> void {
    throw std::invalid_argument("--fault: '" + text + "': " + why);
  };
  const auto number = [&](std::string_view digits, const char* what) {
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    const bool whole = error == std::errc() && end == digits.data() + digits.size();
    if (!whole || !(value >= 0 && value <= 1e6)) {
      refuse(std::string(what) + " is not a number from 0 to 1e6");
    }
    return value;
  };
  ScriptedFault fault{.joint = -1};
  std::string_view rest = text;
  const std::size_t at = rest.find('@');
  if (at == rest.npos) refuse("'@START' is missing");
  std::string_view head = rest.substr(0, at), times = rest.substr(at + 1);
  const std::size_t colon = head.find(':');
  const auto known =
      std::ranges::find(detail::fault_names, head.substr(0, colon), &detail::FaultName::name);
  if (known == detail::fault_names.end()) refuse("unknown kind of fault");
  fault.kind = known->kind;
  if (colon != head.npos) {
    const double joint = number(head.substr(colon + 1), "the joint");
    if (!known->has_joint) refuse("this kind takes no joint");
    if (joint < 1 || joint > joints || joint != static_cast<int>(joint)) {
      refuse("the joint is not 1 .. " + std::to_string(joints));
    }
    fault.joint = static_cast<int>(joint) - 1;
  }
  const std::size_t plus = times.find('+');
  fault.start = number(times.substr(0, plus), "the start");
  if (plus != times.npos) fault.duration = number(times.substr(plus + 1), "the duration");
  return fault;
}

}  // namespace articula::examples

// SPDX-License-Identifier: Apache-2.0
#include "files/drives_file.hpp"

#include <articula/config/read/find_sections.hpp>
#include <articula/config/yaml/node.hpp>
#include <articula/model/build_model.hpp>
#include <articula/text/file_error.hpp>
#include <articula/text/numbers.hpp>
#include <articula/text/similar_word.hpp>

#include <algorithm>
#include <limits>

namespace terminal {

namespace {

using articula::FileError;
using articula::detail::ConfigNode;
using articula::detail::ConfigSection;

enum class Kind : unsigned char { whole, real, watchdog };

/// A member of the struct that describes a drive.
struct Member {
  std::string name{};
  bool is_needed = false;  ///< nothing is right for all drives
  Kind kind = Kind::real;
  int least = 0, most = 0;  ///< of a whole number
};

/// A protocol, and what describes a drive that speaks it. Members have the order of the struct.
struct Protocol {
  PlannedDrives types{};
  std::vector<Member> members{};
};

constexpr int any = std::numeric_limits<int>::max();

Protocol protocol_called(const ConfigNode& name) {
  if (name.index_in({"cia402", "quanser"}) == 0) {
    return {{.header = "articula/hardware/cia402/cia402_codec.hpp",
             .codec = "Cia402Codec",
             .list = "Cia402DriveList"},
            {{"node", true, Kind::whole, 1, 127},
             {"rated_effort", true},
             {"position_scale", true},
             {"velocity_scale", true},
             {"zero_position", false, Kind::whole, -any, any},
             {"watchdog", false, Kind::watchdog},
             {"host_node", false, Kind::whole, 1, 127}}};
  }
  return {{.header = "articula/hardware/quanser/quanser_codec.hpp",
           .codec = "QuanserCodec",
           .list = "QuanserModules",
           .commands_efforts_only = true},
          {{"node", true, Kind::whole, 1, 31},
           {"motor_counts_per_turn", true},
           {"gear_ratio", true},
           {"load_counts_per_turn", true},
           {"position_at_zero"},
           {"encoder_tolerance"}}};
}

std::string value_of(const ConfigNode& node, const Member& member) {
  switch (member.kind) {
    case Kind::whole:
      return std::to_string(node.integer(member.least, member.most));
    case Kind::watchdog: {
      const std::vector<std::string> words{"commands", "heartbeat", "none"};
      return "articula::Cia402Watchdog::" + words[node.index_in(words)];
    }
    case Kind::real:
      break;
  }
  return articula::detail::number_text(node.number());
}

/// The initialiser of a drive. The driver itself checks what the figures mean.
std::string code_of(const ConfigNode& drive, const Protocol& protocol) {
  if (!drive.is_map()) drive.refuse("a map of the drive's figures, such as {node: 1, ...}");
  std::vector<std::string> names;
  for (const Member& member : protocol.members) names.push_back(member.name);
  for (const ConfigNode& item : drive.items) {
    if (std::ranges::find(names, item.key) != names.end()) continue;
    throw FileError(item.key_place, "a drive has no '" + item.key + "'",
                    articula::detail::one_of_words(item.key, names));
  }
  std::string code;
  for (const Member& member : protocol.members) {
    const ConfigNode* const value = drive.find(member.name);
    if (value == nullptr && member.is_needed) {
      throw FileError(drive.place, "the drive has no " + member.name,
                      member.name + ": a figure of docs/hardware.md");
    }
    if (value == nullptr) continue;
    code += (code.empty() ? "{." : ", .") + member.name + " = " + value_of(*value, member);
  }
  return code + "}";
}

}  // namespace

PlannedDrives read_drives(const ControllersPlan& plan, const std::string& interface,
                          const articula::UrdfDescription& robot) {
  const std::string& file = plan.source.name();
  const auto all = articula::detail::find_sections(plan.source);
  const auto section = std::ranges::find(all.sections, "can_drives", &ConfigSection::name);
  if (section == all.sections.end()) {
    throw FileError({.file = file}, "it does not describe the drives on the bus",
                    "a section can_drives (docs/terminal.md)");
  }
  section->check();
  const ConfigNode& parameters = section->parameters;
  const ConfigNode* const name = parameters.find("protocol");
  if (name == nullptr) parameters.refuse("the protocol of the drives: protocol: cia402 or quanser");
  const Protocol protocol = protocol_called(*name);
  if (protocol.types.commands_efforts_only && plan.drives != Drives::efforts) {
    throw FileError(name->place,
                    "drives of this protocol take efforts alone, and controller '" +
                        plan.controllers.front().name + "' commands another quantity",
                    "a controller of efforts, or protocol: cia402");
  }

  PlannedDrives planned = protocol.types;
  planned.interface = interface;
  std::vector<std::string> words{"protocol"};
  for (const articula::Joint& joint : robot->joints) {
    if (!articula::detail::is_free(joint)) continue;
    const std::string joint_name(joint.name.view());
    const ConfigNode* const drive = parameters.find(joint_name);
    if (drive == nullptr) {
      parameters.refuse("the drive of joint '" + joint_name + "', such as " + joint_name +
                        ": {node: 1, ...}");
    }
    planned.drives.push_back({joint_name, code_of(*drive, protocol)});
    words.push_back(joint_name);
  }
  for (const ConfigNode& item : parameters.items) {
    if (std::ranges::find(words, item.key) != words.end()) continue;
    throw FileError(item.key_place, "the robot has no joint '" + item.key + "' that a drive moves",
                    articula::detail::one_of_words(item.key, words));
  }
  return planned;
}

}  // namespace terminal

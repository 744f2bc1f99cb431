// SPDX-License-Identifier: Apache-2.0
/// @file Converts a URDF to a header with the robot's description; articula_add_robot runs it.
///
/// It parses its options without CLI11: it is built on each user's machine, where it must need
/// nothing but urdfdom.
#include "header_text.hpp"

#include <articula/urdf/read_urdf.hpp>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace {

constexpr const char* usage =
    "usage: urdf_to_robot --urdf FILE --output FILE --type NAME [--namespace NAME] [--root LINK]\n"
    "                     [--tip LINK] [--lock JOINT[=POSITION]]... [--gravity X Y Z]\n"
    "                     [--right-angle-tolerance NUMBER] [--allow-unphysical] [--kinematic]";

struct Arguments {
  std::string urdf{};
  std::string output{};
  articula::HeaderNames names{};
  articula::UrdfOptions options{};
};

/// A finite number.
/// @param where  the option, for the message
double number(const std::string& where, const std::string& text) {
  const auto number = articula::detail::number_of(text);
  if (!number) throw std::invalid_argument(where + ": '" + text + "' is not a finite number");
  return *number;
}

/// A joint, or joint=position.
articula::LockedJoint locked_joint(const std::string& text) {
  const std::size_t equals = text.rfind('=');
  if (equals == std::string::npos) return text;
  return {text.substr(0, equals), number("LOCK " + text, text.substr(equals + 1))};
}

Arguments parse(const std::vector<std::string>& words) {
  Arguments arguments;
  articula::UrdfOptions& options = arguments.options;
  const std::map<std::string_view, std::string*> texts{
      {"--urdf", &arguments.urdf},       {"--output", &arguments.output},
      {"--type", &arguments.names.type}, {"--namespace", &arguments.names.name_space},
      {"--root", &options.root},         {"--tip", &options.tip}};
  std::size_t at = 0;
  const auto value = [&]() -> const std::string& {
    if (++at >= words.size()) throw std::invalid_argument(words[at - 1] + " needs a value");
    return words[at];
  };
  for (; at < words.size(); ++at) {
    const std::string& word = words[at];
    if (const auto text = texts.find(word); text != texts.end()) {
      *text->second = value();
    } else if (word == "--lock") {
      options.locked.push_back(locked_joint(value()));
    } else if (word == "--gravity") {
      for (double* component : {&options.gravity.x, &options.gravity.y, &options.gravity.z}) {
        *component = number("GRAVITY", value());
      }
    } else if (word == "--right-angle-tolerance") {
      options.right_angle_tolerance = number("RIGHT_ANGLE_TOLERANCE", value());
    } else if (word == "--allow-unphysical") {
      options.allow_unphysical = true;
    } else if (word == "--kinematic") {
      options.kinematic = true;
    } else {
      throw std::invalid_argument("unknown option '" + word + "'\n" + usage);
    }
  }
  if (arguments.urdf.empty() || arguments.output.empty()) throw std::invalid_argument(usage);
  return arguments;
}

void write(const std::string& name, const std::string& text) {
  std::ofstream file(name, std::ios::binary);
  file << text << std::flush;
  if (!file) throw std::runtime_error(name + ": the file cannot be written");
}

}  // namespace

int main(int count, char** words) {
  try {
    const Arguments arguments = parse({words + 1, words + count});
    const articula::UrdfDescription description =
        articula::read_urdf(std::filesystem::path(arguments.urdf), arguments.options);
    write(arguments.output, header_text(description, arguments.names));
    for (const std::string& notice : description->notices) {
      std::fprintf(stderr, "warning: %s: %s\n", arguments.urdf.c_str(), notice.c_str());
    }
    return 0;
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "urdf_to_robot: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
}

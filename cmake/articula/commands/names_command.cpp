// SPDX-License-Identifier: Apache-2.0
/// @file names: what a shell completes with the names of the running loop.
#include "connection.hpp"
#include "program.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

namespace terminal {

namespace {

/// Where names of a kind are found: a service, and the list in its answer.
struct Source {
  const char* service;
  const char* list;
};

Source source_of(const std::string& kind) {
  if (kind == "CONTROLLER") return {"/situation", "controllers"};
  if (kind.starts_with("GAIN")) return {"/describe_parameters", "parameters"};
  return {"/robot", kind == "LINK" ? "links" : "joints"};
}

/// Whether a shell leaves the name as it is. Shells expand what they complete, and a loop's names
/// are not this user's: "$(...)" would be run.
bool is_plain(const std::string& name) {
  constexpr std::string_view others = "_-./:";
  return !name.empty() && std::ranges::all_of(name, [&](unsigned char c) {
    return std::isalnum(c) != 0 || others.find(static_cast<char>(c)) != std::string_view::npos;
  });
}

/// Prints nothing where there is no loop: a message would stand in the middle of what is typed.
void print_names(const Program& program, const std::string& kind) {
  const Source source = source_of(kind);
  const std::string ending = kind.ends_with("=VALUE") ? "=" : "";
  try {
    Connection connection(program);
    for (const Json& item : connection.call(source.service).value(source.list, Json::array())) {
      const std::string name = item.is_string() ? item.get<std::string>() : item.value("name", "");
      if (is_plain(name)) std::printf("%s%s\n", name.c_str(), ending.c_str());
    }
  } catch (const std::runtime_error&) {
  }
}

}  // namespace

void add_names_command(CLI::App& app, Program& program) {
  const auto kind = std::make_shared<std::string>();
  CLI::App* command =
      add_command(app, program, "names", "Prints names of the running loop, for a shell.",
                  [&program, kind] { print_names(program, *kind); });
  command->group("");  // hidden: the scripts of `completion` call it
  command->add_option("kind", *kind)->required()->check(CLI::IsMember(named_values));
}

}  // namespace terminal

// SPDX-License-Identifier: Apache-2.0
/// @file gains get, gains set.
#include "connection.hpp"
#include "files/joint_values.hpp"
#include "program.hpp"
#include "table.hpp"

#include <articula/text/similar_word.hpp>

#include <CLI/CLI.hpp>

#include <memory>
#include <string_view>
#include <vector>

namespace terminal {

namespace {

bool is_below(const std::string& name, const std::string& prefix) {
  return name == prefix || (name.starts_with(prefix) && name[prefix.size()] == '.');
}

std::string range_text(const Json& parameter) {
  const Json lowest = parameter.value("lowest", Json()),
             highest = parameter.value("highest", Json());
  if (lowest.is_number() && highest.is_number()) {
    return shown(lowest.get<double>()) + " .. " + shown(highest.get<double>());
  }
  if (lowest.is_number()) return ">= " + shown(lowest.get<double>());
  if (highest.is_number()) return "<= " + shown(highest.get<double>());
  return "";
}

/// The value as `gains set` takes it. An infinite one is null: it is at the bound that is infinite.
std::string value_text(const Json& parameter) {
  const Json value = parameter.value("value", Json());
  if (value.is_number()) return shown(value.get<double>());
  return parameter.value("highest", Json()).is_null() ? "inf" : "-inf";
}

void print_gains(const Program& program, const std::string& name) {
  Connection connection(program);
  const Json all = connection.call("/describe_parameters").value("parameters", Json::array());
  Json chosen = Json::array();
  std::vector<Row> rows;
  std::vector<std::string> names;
  for (const Json& parameter : all) {
    names.push_back(parameter.value("name", ""));
    if (!name.empty() && !is_below(names.back(), name)) continue;
    chosen.push_back(parameter);
    rows.push_back(
        {names.back(), value_text(parameter), parameter.value("unit", ""), range_text(parameter)});
  }
  if (!name.empty() && chosen.empty()) {
    const std::vector<std::string_view> known(names.begin(), names.end());
    const std::string_view similar = articula::detail::similar_word(name, known);
    throw Refusal("there is no gain '" + name + "'" +
                  (similar.empty() ? "; list all by: articula gains get"
                                   : "; did you mean '" + std::string(similar) + "'?"));
  }
  program.print({{"parameters", chosen}}, rows.empty() ? "no gains" : table(rows));
}

}  // namespace

void add_gain_commands(CLI::App& app, Program& program) {
  CLI::App* gains = app.add_subcommand("gains", "Gains of the controllers.")->require_subcommand(1);
  gains->fallthrough();
  const auto name = std::make_shared<std::string>();
  CLI::App* get =
      add_command(*gains, program, "get", "Prints gains with their units and allowed ranges.",
                  [&program, name] { print_gains(program, *name); });
  get->add_option("name", *name, "a gain, or what is before a dot of several: a controller")
      ->type_name("GAIN");

  const auto values = std::make_shared<std::vector<std::string>>();
  CLI::App* set =
      add_command(*gains, program, "set", "Sets gains between two cycles: all of them, or none.",
                  [&program, values] {
                    const Json request = values_by_name(*values, "gain", {"inf", "-inf"});
                    Connection connection(program);
                    Json answer = connection.operate("/set_parameters", {{"values", request}});
                    const std::string message = answer.value("message", "");
                    program.print(answer, message.empty() ? "done" : message);
                  });
  set->add_option("values", *values, "as pid.elbow.p=300")->required()->type_name("GAIN=VALUE");
}

}  // namespace terminal

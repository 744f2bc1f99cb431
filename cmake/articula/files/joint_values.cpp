// SPDX-License-Identifier: Apache-2.0
#include "files/joint_values.hpp"

#include <articula/text/number_hint.hpp>
#include <articula/text/numbers.hpp>

namespace terminal {

Json values_by_name(const std::vector<std::string>& arguments, const std::string& kind) {
  Json values = Json::object();
  for (const std::string& argument : arguments) {
    const std::size_t equals = argument.rfind('=');
    if (equals == std::string::npos || equals == 0) {
      throw WrongUsage("'" + argument + "': write " + kind + "=value");
    }
    const std::string name = argument.substr(0, equals), text = argument.substr(equals + 1);
    const auto number = articula::detail::number_of(text);
    if (!number) {
      throw WrongUsage("'" + argument + "': '" + text + "' is not a finite number" +
                       articula::detail::number_hint(text));
    }
    if (values.contains(name)) throw WrongUsage(kind + " '" + name + "' is given twice");
    values[name] = *number;
  }
  return values;
}

}  // namespace terminal

// SPDX-License-Identifier: Apache-2.0
#include "files/joint_values.hpp"

#include <articula/text/number_hint.hpp>
#include <articula/text/numbers.hpp>

#include <algorithm>

namespace terminal {

Json values_by_name(const std::vector<std::string>& arguments, const std::string& kind,
                    const std::vector<std::string>& words) {
  Json values = Json::object();
  for (const std::string& argument : arguments) {
    const std::size_t equals = argument.rfind('=');
    if (equals == std::string::npos || equals == 0) {
      throw WrongUsage("'" + argument + "': write " + kind + "=value");
    }
    const std::string name = argument.substr(0, equals), text = argument.substr(equals + 1);
    const auto number = articula::detail::number_of(text);
    const bool is_word = std::find(words.begin(), words.end(), text) != words.end();
    if (!number && !is_word) {
      std::string expected = "a finite number";
      for (const std::string& word : words) expected += " or " + word;
      throw WrongUsage("'" + argument + "': '" + text + "' is not " + expected +
                       articula::detail::number_hint(text));
    }
    if (values.contains(name)) throw WrongUsage(kind + " '" + name + "' is given twice");
    values[name] = is_word ? Json(text) : Json(*number);
  }
  return values;
}

}  // namespace terminal

// SPDX-License-Identifier: Apache-2.0
/// @file The check of a number on the command line.
#pragma once

#include <articula/text/numbers.hpp>

#include <CLI/CLI.hpp>

#include <string>

namespace terminal {

/// Accepts numbers within a range. CLI::Range accepts NaN.
[[nodiscard]] inline CLI::Validator within(double lowest, double highest) {
  const std::string range =
      articula::detail::rounded_text(lowest) + " to " + articula::detail::rounded_text(highest);
  return CLI::Validator(
      [=](const std::string& text) {
        const auto number = articula::detail::number_of(text);
        return number && *number >= lowest && *number <= highest
                   ? std::string()
                   : "'" + text + "' is not a number from " + range;
      },
      range);
}

}  // namespace terminal

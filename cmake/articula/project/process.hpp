// SPDX-License-Identifier: Apache-2.0
/// @file Runs other programs.
#pragma once

#include <string>
#include <vector>

namespace terminal {

/// How a program has ended.
struct ProcessEnd {
  bool is_found = false;  ///< there is such a program
  bool is_done = false;   ///< it has ended with the status 0
  std::string output{};   ///< what it has written
};

/// Runs a program and waits for its end.
/// @param words        the program, found in PATH, and its arguments
/// @param with_errors  the output has its standard error, too; else that goes where ours goes
[[nodiscard]] ProcessEnd run_process(std::vector<std::string> words, bool with_errors = false);

}  // namespace terminal

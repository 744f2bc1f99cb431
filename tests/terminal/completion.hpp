// SPDX-License-Identifier: Apache-2.0
/// @file What bash completes by the script that articula prints.
#pragma once

#include "scratch_file.hpp"
#include "terminal.hpp"

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace support {

/// What bash offers for the last of these words. Bash takes '=' for a word of its own.
[[nodiscard]] inline std::vector<std::string> offered(const std::vector<std::string>& words) {
  const ScratchFile script("completion.bash");
  std::ofstream(script.path()) << run_articula({"completion", "bash"}).output;
  std::string list = ARTICULA_PROGRAM;
  for (const std::string& word : words) list += " '" + word + "'";
  const Result result = Process({"bash", "-c",
                                 "source " + script.path().string() + "; COMP_WORDS=(" + list +
                                     "); COMP_CWORD=" + std::to_string(words.size()) +
                                     "; _articula; printf '%s\\n' \"${COMPREPLY[@]}\""})
                            .end();
  if (result.exit_code != 0 || !result.errors.empty()) throw std::runtime_error(result.errors);
  std::istringstream lines(result.output);
  std::vector<std::string> all;
  for (std::string line; std::getline(lines, line);) all.push_back(line);
  return all;
}

}  // namespace support

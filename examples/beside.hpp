// SPDX-License-Identifier: Apache-2.0
/// @file Files beside the examples' sources.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

/// The path of a file beside this one, from whichever folder the program runs. CMake defines the
/// folder as ARTICULA_EXAMPLES; without it, the compiler's own name of this file tells.
inline std::string beside(std::string_view file) {
#ifdef ARTICULA_EXAMPLES
  const std::filesystem::path folder = ARTICULA_EXAMPLES;
#else
  const std::filesystem::path folder = std::filesystem::path(__FILE__).parent_path();
#endif
  return (folder / file).string();
}

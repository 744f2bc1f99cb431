// SPDX-License-Identifier: Apache-2.0
/// @file Files beside the examples' sources.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

/// The path of a file beside this one, for a program that runs in any folder. CMake defines the
/// folder as ARTICULA_EXAMPLES. Without it, the folder is that of __FILE__.
inline std::string beside(std::string_view file) {
#ifdef ARTICULA_EXAMPLES
  const std::filesystem::path folder = ARTICULA_EXAMPLES;
#else
  const std::filesystem::path folder = std::filesystem::path(__FILE__).parent_path();
#endif
  return (folder / file).string();
}

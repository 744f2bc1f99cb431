// SPDX-License-Identifier: Apache-2.0
/// @file Projects that are compiled once, and kept for the next time.
#pragma once

#include "program.hpp"
#include "project/project.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace terminal {

/// Compiles a project in the user's cache, unless it is there already. If other processes do the
/// same, one of them compiles, and the others wait.
/// @param product     file that the build makes
/// @param components  of the package, which the project needs
/// @return            the product
/// @throws Refusal if CMake, a compiler or the installed articula is not found, or the compiler
///         fails
[[nodiscard]] std::filesystem::path cached_build(const Project& project, const std::string& product,
                                                 const std::string& components);

/// Becomes a project's program.
/// @param arguments  of that program
/// @throws as cached_build
[[noreturn]] void run_compiled(const Project& project, std::vector<std::string> arguments);

}  // namespace terminal

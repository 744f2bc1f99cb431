// SPDX-License-Identifier: Apache-2.0
/// @file run --compile: the loop as a program of its own, which is kept for the next time.
#pragma once

#include "program.hpp"
#include "project/project.hpp"

#include <string>
#include <vector>

namespace terminal {

/// Compiles a project in the user's cache, unless it is there already, and becomes its program.
/// @param arguments  of that program
/// @throws Refusal if CMake, a compiler or the installed articula is not found, or the compiler fails
[[noreturn]] void run_compiled(const Project& project, std::vector<std::string> arguments);

}  // namespace terminal

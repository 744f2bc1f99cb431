// SPDX-License-Identifier: Apache-2.0
/// @file Arguments of the form name=value.
#pragma once

#include "program.hpp"

#include <string>
#include <vector>

namespace terminal {

/// The JSON object of arguments such as shoulder=0.5.
/// @param kind   of the names, for messages, as "joint"
/// @param words  that may stand in place of a finite number; they stay texts
/// @throws WrongUsage naming the argument that is not of this form or has neither a finite number
///         nor a word, or the name that is there twice
[[nodiscard]] Json values_by_name(const std::vector<std::string>& arguments,
                                  const std::string& kind,
                                  const std::vector<std::string>& words = {});

}  // namespace terminal

// SPDX-License-Identifier: Apache-2.0
/// @file Text in columns, for people.
#pragma once

#include <string>
#include <vector>

namespace terminal {

using Row = std::vector<std::string>;

/// Lines with aligned columns, two blanks between them, and no blanks at their ends.
[[nodiscard]] std::string table(const std::vector<Row>& rows);

/// A number with some digits, for people.
[[nodiscard]] std::string shown(double number);
/// A duration with its unit, as "12.5 us".
[[nodiscard]] std::string shown_duration(double seconds);

}  // namespace terminal

// SPDX-License-Identifier: Apache-2.0
/// @file Names that are given to the transport, which must be valid.
#pragma once

#include <string_view>

namespace articula::ros2::dds {

/// Checks the name of a node, topic or service: parts of letters, digits and _, each after a /.
/// @param what  names the value in the error, as "topic"
/// @throws std::invalid_argument with the rule
void check_full_name(std::string_view what, std::string_view name);

/// Checks the name of a type: package, kind and name, as std_msgs/msg/String.
/// @throws std::invalid_argument with the rule
void check_type_name(std::string_view name);

}  // namespace articula::ros2::dds

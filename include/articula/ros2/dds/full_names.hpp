// SPDX-License-Identifier: Apache-2.0
/// @file Names that are given to the transport: which are valid, and the namespace before them.
#pragma once

#include <string>
#include <string_view>

namespace articula::ros2::dds {

/// Checks the name of a node, topic or service: parts of letters, digits and _, each after a /.
/// @param what  names the value in the error, as "topic"
/// @throws std::invalid_argument with the rule
void check_full_name(std::string_view what, std::string_view name);

/// Checks the name of a type: package, kind and name, as std_msgs/msg/String.
/// @throws std::invalid_argument with the rule
void check_type_name(std::string_view name);

/// The name in a namespace, unless ROS has the name once in a domain.
/// @param name_space  empty or a full name
/// @param name        full name
std::string in_name_space(std::string_view name_space, std::string_view name);

}  // namespace articula::ros2::dds

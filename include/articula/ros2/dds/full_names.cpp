// SPDX-License-Identifier: Apache-2.0
#include "articula/ros2/dds/full_names.hpp"

#include "articula/core/refuse.hpp"

#include <algorithm>
#include <cstddef>

namespace articula::ros2::dds {

namespace {

// Fast DDS keeps names of 255 characters; those of DDS have up to 11 more than those of ROS.
constexpr std::size_t longest_name = 240;

constexpr bool is_word(std::string_view text) {
  if (text.empty() || (text.front() >= '0' && text.front() <= '9')) return false;
  return std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  });
}

// Whether the text is words, each after a slash.
constexpr bool is_path(std::string_view text) {
  if (text.empty()) return false;
  while (!text.empty()) {
    if (text.front() != '/') return false;
    text.remove_prefix(1);
    const std::string_view word = text.substr(0, text.find('/'));
    if (!is_word(word)) return false;
    text.remove_prefix(word.size());
  }
  return true;
}

}  // namespace

void check_full_name(std::string_view what, std::string_view name) {
  if (!is_path(name) || name.size() > longest_name) {
    articula::detail::refuse(
        {"ros2: the ", what, " '", name, "' is not a full name; expected parts of ",
         "letters, digits and _, each after a / and without a digit first, with at most ",
         longest_name, " characters, as \"/arm/states\""});
  }
}

void check_type_name(std::string_view name) {
  std::string path = "/";
  path += name;
  if (!is_path(path) || std::count(path.begin(), path.end(), '/') != 3 ||
      name.size() > longest_name) {
    articula::detail::refuse({"ros2: the type '", name,
                              "' is not a package, kind and name, as \"std_msgs/msg/String\""});
  }
}

}  // namespace articula::ros2::dds

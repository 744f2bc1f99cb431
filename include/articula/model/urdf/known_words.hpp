// SPDX-License-Identifier: Apache-2.0
/// @file The words that URDF knows where it tells of mechanics.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace articula::detail {

/// What may stand in an element.
struct KnownWords {
  std::string_view element{};
  std::vector<std::string_view> attributes{};
  std::vector<std::string_view> children{};
};

/// The words of the elements about mechanics, from URDF's specification and urdfdom; null for other
/// elements, into which nobody looks. <origin>'s quat_xyzw, which newer versions have, is not among
/// them: it is not read here, and whoever writes it should know.
/// Sources: https://wiki.ros.org/urdf/XML; xsd/urdf.xsd of https://github.com/ros/urdfdom
[[nodiscard]] inline const KnownWords* known_words(std::string_view element) {
  static const std::vector<KnownWords> all = {
      {"joint",
       {"name", "type"},
       {"origin", "parent", "child", "axis", "limit", "dynamics", "mimic", "safety_controller",
        "calibration",
        // other programs' own
        "gazebo", "ros2_control", "transmission", "sensor"}},
      {"link",
       {"name", "type"},
       {"inertial", "visual", "collision",
        // other programs' own
        "gazebo", "ros2_control", "transmission", "sensor", "material"}},
      {"parent", {"link"}, {}},
      {"child", {"link"}, {}},
      {"origin", {"xyz", "rpy"}, {}},
      {"axis", {"xyz"}, {}},
      {"limit",
       {"lower", "upper", "effort", "velocity",
        // of version 1.2
        "acceleration", "deceleration", "jerk"},
       {}},
      {"dynamics", {"damping", "friction"}, {}},
      {"mimic", {"joint", "multiplier", "offset"}, {}},
      {"inertial", {}, {"origin", "mass", "inertia"}},
      {"mass", {"value"}, {}},
      {"inertia", {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"}, {}},
  };
  const auto found = std::find_if(
      all.begin(), all.end(), [&](const KnownWords& words) { return words.element == element; });
  return found == all.end() ? nullptr : &*found;
}

/// How many letters have to be put in, left out, replaced or swapped with the next to make one word
/// of the other. Source: optimal string alignment, as in Boytsov, Indexing methods for approximate
/// dictionary searching, 2011.
[[nodiscard]] inline std::size_t edit_distance(std::string_view a, std::string_view b) {
  // From the first i letters of a to each beginning of b, and for i - 1 and i - 2.
  std::vector<std::size_t> row(b.size() + 1), last(row), last_but_one(row);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    last_but_one.swap(last);
    last.swap(row);
    row[0] = i;
    for (std::size_t k = 1; k <= b.size(); ++k) {
      const std::size_t replaced = last[k - 1] + (a[i - 1] == b[k - 1] ? 0 : 1);
      row[k] = std::min({replaced, last[k] + 1, row[k - 1] + 1});
      if (i > 1 && k > 1 && a[i - 1] == b[k - 2] && a[i - 2] == b[k - 1]) {
        row[k] = std::min(row[k], last_but_one[k - 2] + 1);
      }
    }
  }
  return row[b.size()];
}

/// The word that was meant by one that is not among them: at most two letters off, capital letters
/// not counted; empty if there is none, or if several are as close.
[[nodiscard]] inline std::string_view meant_word(std::string_view unknown,
                                                 std::span<const std::string_view> words) {
  constexpr std::size_t farthest = 2;
  std::string small(unknown);
  for (char& c : small) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  std::string_view meant;
  std::size_t nearest = farthest + 1;
  for (const std::string_view word : words) {
    if (small.size() > word.size() + farthest) continue;  // however long it is
    const std::size_t distance = edit_distance(small, word);
    const bool shares_letters = distance < std::max(small.size(), word.size());
    if (distance > nearest || distance > farthest || !shares_letters) continue;
    meant = distance < nearest ? word : std::string_view();
    nearest = distance;
  }
  return meant;
}

}  // namespace articula::detail

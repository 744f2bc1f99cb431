// SPDX-License-Identifier: Apache-2.0
/// @file Names of sections with namespaces and wildcards.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace articula::detail {

/// The name of a section in ROS 2, such as /left/arm. A part * matches one part of a controller's
/// name, and ** any number of parts [rcl_yaml_param_parser and rclcpp's parameter_map_from]. So
/// /**/arm matches each arm, /left/** everything in left, and /** everything.
class SectionName {
 public:
  SectionName() = default;
  explicit SectionName(std::string_view text) {
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('/'), text.size());
      if (end > 0) parts_.emplace_back(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
  }

  [[nodiscard]] bool operator==(const SectionName&) const = default;

  /// A name in this namespace.
  [[nodiscard]] SectionName operator/(const SectionName& inner) const {
    SectionName name = *this;
    name.parts_.insert(name.parts_.end(), inner.parts_.begin(), inner.parts_.end());
    return name;
  }

  /// The last part; empty if it is a wildcard, or if there is none.
  [[nodiscard]] std::string last() const {
    return parts_.empty() || is_wildcard(parts_.back()) ? "" : parts_.back();
  }
  /// All parts but the last one, without **, with slashes between them.
  [[nodiscard]] std::string group() const {
    std::string text;
    for (std::size_t k = 0; k + 1 < parts_.size(); ++k) {
      if (parts_[k] != "**") text += (text.empty() ? "" : "/") + parts_[k];
    }
    return text;
  }
  /// A name that this matches, in which * stands for an unknown part.
  [[nodiscard]] SectionName example() const {
    SectionName name = *this;
    std::erase(name.parts_, "**");
    if (!parts_.empty() && parts_.back() == "**") name.parts_.emplace_back("*");
    return name;
  }
  [[nodiscard]] std::size_t depth() const noexcept { return parts_.size(); }
  [[nodiscard]] bool has_wildcard() const {
    return std::any_of(parts_.begin(), parts_.end(), is_wildcard);
  }
  [[nodiscard]] bool has_double_wildcard() const {
    return std::find(parts_.begin(), parts_.end(), "**") != parts_.end();
  }

  /// True if this matches a name.
  [[nodiscard]] bool matches(const SectionName& name) const {
    // reached[k]: the parts so far match the first k parts of the name.
    std::vector<bool> reached(name.parts_.size() + 1, false);
    reached[0] = true;
    for (const std::string& part : parts_) {
      for (std::size_t k = 1; part == "**" && k < reached.size(); ++k) {
        reached[k] = reached[k] || reached[k - 1];
      }
      if (part == "**") continue;
      for (std::size_t k = reached.size() - 1; k > 0; --k) {
        reached[k] = reached[k - 1] && (part == "*" || part == name.parts_[k - 1]);
      }
      reached[0] = false;
    }
    return reached.back();
  }

 private:
  [[nodiscard]] static bool is_wildcard(const std::string& part) {
    return part == "*" || part == "**";
  }

  std::vector<std::string> parts_{};
};

}  // namespace articula::detail

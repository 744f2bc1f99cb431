// SPDX-License-Identifier: Apache-2.0
/// @file Words in a URDF that nobody reads, for they may be misspelt.
#pragma once

#include "articula/model/urdf/known_words.hpp"
#include "articula/model/urdf/xml.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace articula::detail {

/// Collects the attributes and child elements of a robot's links and joints that URDF does not know,
/// a line each: urdfdom passes them over in silence. Elements that tell nothing of mechanics are not
/// looked into.
class UnknownWords {
 public:
  explicit UnknownWords(const XmlElement& robot) {
    for (const char* kind : {"link", "joint"}) {
      for_each_child(robot, kind, [&](const XmlElement& element) {
        std::string name = attribute(element, "name");
        for (char& c : name) c = c == '\t' || c == '\r' || c == '\n' ? ' ' : c;
        owner_ = std::string(kind) + " '" + name + "': ";
        look_at(element);
      });
    }
  }

  [[nodiscard]] std::vector<std::string> take() { return std::move(lines_); }

 private:
  void look_at(const XmlElement& element) {
    const KnownWords* known = known_words(element.Value());
    if (!known) return;
    const auto is_known = [](const auto& words, std::string_view word) {
      return std::find(words.begin(), words.end(), word) != words.end();
    };
    for (auto each = element.FirstAttribute(); each; each = each->Next()) {
      const std::string name = each->Name();
      if (is_known(known->attributes, name)) continue;
      add(*known, name, "attribute '", meant_word(name, known->attributes), "'");
    }
    for_each_child(element, nullptr, [&](const XmlElement& child) {
      const std::string name = child.Value();
      if (is_known(known->children, name)) return look_at(child);
      add(*known, name, "element <", meant_word(name, known->children), ">");
    });
  }

  /// Words with a colon belong to others, and xmlns says to whom.
  void add(const KnownWords& place, const std::string& word, const std::string& open,
           std::string_view meant, const char* close) {
    if (word.find(':') != std::string::npos || word == "xmlns") return;
    std::string line = owner_ + "<" + std::string(place.element) + ">: the " + open + word + close +
                       " is not known there and does not count";
    if (!meant.empty()) {
      line += std::string("; did you mean ") + open.back() + std::string(meant) + close + "?";
    }
    if (seen_.insert(line).second) lines_.push_back(line);
  }

  std::vector<std::string> lines_{};
  std::set<std::string> seen_{};  ///< a link may have the same element often
  std::string owner_{};           ///< the link or joint, for the lines
};

}  // namespace articula::detail

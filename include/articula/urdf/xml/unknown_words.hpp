// SPDX-License-Identifier: Apache-2.0
/// @file Notices about attributes and elements that URDF does not define and that may be misspelt.
#pragma once

#include "articula/text/similar_word.hpp"
#include "articula/urdf/xml/known_words.hpp"
#include "articula/urdf/xml/xml.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace articula::detail {

/// Reports each attribute and child of an element that a table does not list. urdfdom and
/// ros2_control ignore them without a message. Words with a colon and xmlns belong to other
/// programs.
/// @param descend  whether to check the children as well
/// @param report   called with a text for each unknown word
template <class Report>
void report_unknown_words(const XmlElement& element, const std::vector<KnownWords>& table,
                          bool descend, Report report) {
  const KnownWords* known = find_words(table, element.Value());
  if (!known) return;
  const auto is_known = [&](const std::string& word, const std::vector<std::string_view>& words,
                            const std::string& shown_word) {
    if (std::ranges::find(words, word) != words.end()) return true;
    if (word.find(':') == std::string::npos && word != "xmlns") {
      report("<" + std::string(element.Value()) + ">: the " + shown_word +
             " is unknown and is ignored" + did_you_mean(word, words));
    }
    return false;
  };
  for (auto each = element.FirstAttribute(); each; each = each->Next()) {
    const std::string name = each->Name();
    is_known(name, known->attributes, "attribute '" + name + "'");
  }
  for_each_child(element, nullptr, [&](const XmlElement& child) {
    const std::string name = child.Value();
    const bool is_defined = is_known(name, known->children, "element <" + name + ">");
    if (is_defined && descend) report_unknown_words(child, table, descend, report);
  });
}

/// A possible cause of an error, as an addition to its message: the first unknown word in a link or
/// joint that the message names.
/// @param unknown_words  notices such as "link 'arm': <link>: the attribute ..."
[[nodiscard]] inline std::string possible_cause(const std::vector<std::string>& unknown_words,
                                                std::string_view message) {
  for (const std::string& line : unknown_words) {
    const std::size_t begin = line.find('\'') + 1;
    const std::string name = line.substr(begin, line.find('\'', begin) - begin);
    if (message.find("'" + name + "'") != std::string_view::npos ||
        message.find("[" + name + "]") != std::string_view::npos) {
      return "; a possible cause: " + line;
    }
  }
  return "";
}

}  // namespace articula::detail

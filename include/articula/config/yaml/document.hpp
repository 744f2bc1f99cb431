// SPDX-License-Identifier: Apache-2.0
/// @file Reads YAML. Needs the CMake target articula::config (yaml-cpp).
#pragma once

#include "articula/config/yaml/characters.hpp"
#include "articula/config/yaml/filled_text.hpp"
#include "articula/config/yaml/node.hpp"
#include "articula/config/yaml/parse_hint.hpp"
#include "articula/config/yaml/scalar.hpp"
#include "articula/config/yaml/source.hpp"
#include "articula/text/characters.hpp"
#include "articula/text/file_error.hpp"
#include "articula/text/placeholder.hpp"

#include <yaml-cpp/anchor.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace articula::detail {

/// Makes a tree of what yaml-cpp finds. yaml-cpp's own tree keeps one of two equal keys, says
/// nothing, and grows with every alias; this one refuses both.
class ConfigBuilder final : public YAML::EventHandler {
 public:
  static constexpr std::size_t deepest = 32;        ///< levels of lists and maps
  static constexpr std::size_t most_nodes = 20000;  ///< with those that aliases repeat

  /// @param text    what is parsed; it must live on
  /// @param values  of placeholders that were given
  ConfigBuilder(std::string file, const FilledText& text, const ConfigValues& values)
      : file_(std::move(file)), text_(&text) {
    for (const auto& [name, value] : values) {
      given_ += (given_.empty() ? "'" : ", '") + shown(name) + "'";
    }
  }

  /// The root of the document.
  [[nodiscard]] ConfigNode take() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (started_) refuse(at(mark), "a second document begins", "one document in a file");
    started_ = true;
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    add({.mark = at(mark)}, anchor);
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    check_tag(at(mark), tag, {"str", "int", "float", "bool", "null"});
    add({.kind = ConfigNode::Kind::scalar,
         .quoted = tag == "!" || tag.ends_with(":str"),
         .text = value,
         .mark = at(mark)},
        anchor);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto found = anchors_.find(anchor);
    if (found == anchors_.end()) {
      refuse(at(mark), "an alias inside of what it stands for", "an anchor that is complete");
    }
    count(node_count(found->second), at(mark));
    check_depth(stack_.size() + node_height(found->second), at(mark));
    add(found->second, 0);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    check_tag(at(mark), tag, {"seq"});
    open({.kind = ConfigNode::Kind::list, .mark = at(mark)}, anchor);
  }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    check_tag(at(mark), tag, {"map"});
    open({.kind = ConfigNode::Kind::map, .mark = at(mark)}, anchor);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapEnd() override {
    check_keys(stack_.back().node);
    close();
  }

 private:
  /// A list or map that is not complete yet.
  struct Open {
    ConfigNode node;
    YAML::anchor_t anchor = 0;
    bool has_key = false;
    std::string key{};  ///< of the value that comes next
    ConfigMark key_mark{};
  };

  [[nodiscard]] ConfigMark at(const YAML::Mark& mark) const {
    return text_->in_file({std::max(mark.line, 0) + 1, std::max(mark.column, 0) + 1});
  }
  [[noreturn]] void refuse(ConfigMark mark, const std::string& reason,
                           const std::string& expected) const {
    throw FileError({file_, mark.line, mark.column, path()}, reason, expected);
  }
  /// The keys from the top to here.
  [[nodiscard]] std::string path() const {
    std::string result;
    for (const Open& open : stack_) {
      if (open.has_key) result += (result.empty() ? "" : ".") + shown(open.key);
    }
    return result;
  }
  void check_tag(ConfigMark mark, std::string_view tag,
                 const std::vector<const char*>& good) const {
    constexpr std::string_view core = "tag:yaml.org,2002:";
    if (tag.empty() || tag == "?" || tag == "!") return;
    const bool known =
        tag.starts_with(core) && std::any_of(good.begin(), good.end(), [&](const char* name) {
          return tag.substr(core.size()) == name;
        });
    if (!known) refuse(mark, "the tag '" + shown(tag) + "'", "no tag here");
  }
  void check_depth(std::size_t depth, ConfigMark mark) const {
    if (depth > deepest) {
      refuse(mark, "it is nested too deeply",
             "at most " + std::to_string(deepest) + " lists and maps inside each other");
    }
  }
  /// Two values under one key are refused at the second.
  void check_keys(const ConfigNode& map) const {
    std::vector<const ConfigNode*> sorted;
    for (const ConfigNode& item : map.items) sorted.push_back(&item);
    const auto before = [](const ConfigNode* a, const ConfigNode* b) {
      if (a->key != b->key) return a->key < b->key;
      return std::pair(a->key_mark.line, a->key_mark.column) <
             std::pair(b->key_mark.line, b->key_mark.column);
    };
    std::sort(sorted.begin(), sorted.end(), before);
    for (std::size_t k = 1; k < sorted.size(); ++k) {
      if (sorted[k - 1]->key != sorted[k]->key) continue;
      refuse(sorted[k]->key_mark,
             "the key '" + shown(sorted[k]->key) + "' is also in line " +
                 std::to_string(sorted[k - 1]->key_mark.line),
             "every key once");
    }
  }
  void count(std::size_t more, ConfigMark mark) {
    nodes_ += more;
    if (nodes_ > most_nodes) {
      refuse(mark, "it is too large, aliases included",
             "at most " + std::to_string(most_nodes) + " values");
    }
  }
  void open(ConfigNode node, YAML::anchor_t anchor) {
    if (awaits_key()) {
      const std::string_view unfilled = placeholder_in(line_of(text_->text(), node.mark.line));
      if (unfilled.starts_with('{')) {
        refuse(node.mark, unfilled_text(unfilled), "its value" + value_example(unfilled));
      }
      refuse(node.mark, what_is(node) + " as a key", "a word");
    }
    check_depth(stack_.size() + 1, node.mark);
    stack_.push_back({.node = std::move(node), .anchor = anchor});
  }
  void close() {
    Open open = std::move(stack_.back());
    stack_.pop_back();
    add(std::move(open.node), open.anchor);
  }
  [[nodiscard]] bool awaits_key() const {
    return !stack_.empty() && stack_.back().node.is_map() && !stack_.back().has_key;
  }
  /// A node is complete: it is a key, or goes where it belongs.
  void add(ConfigNode node, YAML::anchor_t anchor) {
    count(1, node.mark);
    if (anchor != 0) {
      count(node_count(node), node.mark);
      anchors_[anchor] = node;
    }
    if (stack_.empty()) {
      root_ = std::move(node);
      return;
    }
    Open& parent = stack_.back();
    if (awaits_key()) {
      if (node.kind != ConfigNode::Kind::scalar || node.text.empty()) {
        refuse(node.mark, what_is(node) + " as a key", "a word");
      }
      if (node.text == "<<" && !node.quoted) {
        refuse(node.mark, "the merge key <<", "the values themselves");
      }
      if (!node.quoted && !odd_character_in(node.text).empty()) {
        refuse(node.mark, "the key " + quoted_text(node.text), "an ordinary blank, or none");
      }
      parent.has_key = true;
      parent.key = std::move(node.text);
      parent.key_mark = node.mark;
      return;
    }
    if (parent.node.is_map()) {
      node.key = std::move(parent.key);
      node.key_mark = parent.key_mark;
      // A value that is left out stands nowhere; yaml-cpp takes what comes next for its place.
      if (node.kind == ConfigNode::Kind::nothing) node.mark = node.key_mark;
      parent.has_key = false;
    }
    if (!given_.empty() && (has_placeholder(node.key) || has_placeholder(node.text))) {
      node.given = given_;
    }
    parent.node.items.push_back(std::move(node));
  }

  std::string file_;
  const FilledText* text_;
  std::string given_{};  ///< the names of values, listed
  bool started_ = false;
  std::size_t nodes_ = 0;
  std::vector<Open> stack_{};
  std::map<YAML::anchor_t, ConfigNode> anchors_{};
  ConfigNode root_{};
};

/// Reads the one document of a YAML file, values in place of placeholders. Equal keys, nesting without end and aliases that multiply
/// are refused.
/// @throws FileError with file, line and column
/// Real-time: no (reads a file, allocates, throws).
[[nodiscard]] inline ConfigNode read_document(const ConfigSource& source) {
  const FilledText filled(source.name(), with_line_feeds(source.contents()), source.values());
  const std::string& text = filled.text();
  check_characters(source.name(), text);
  std::istringstream stream(text);
  ConfigBuilder builder(source.name(), filled, source.values());
  try {
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) continue;
  } catch (const YAML::Exception& error) {
    const auto [line, column] =
        filled.in_file({std::max(error.mark.line, 0) + 1, std::max(error.mark.column, 0) + 1});
    throw FileError({source.name(), line, column, ""}, "it is not YAML: " + shown(error.msg),
                    parse_hint(text, line));
  }
  ConfigNode root = builder.take();
  if (root.kind == ConfigNode::Kind::nothing) {
    throw FileError({.file = source.name()}, "it is empty", "parameters");
  }
  if (!root.is_map()) {
    throw FileError({source.name(), root.mark.line, root.mark.column, ""},
                    what_is(root) + " at the top", "a map of parameters");
  }
  return root;
}

}  // namespace articula::detail

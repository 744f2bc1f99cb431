// SPDX-License-Identifier: Apache-2.0
/// @file The tree of a YAML document, built from the events of yaml-cpp.
#pragma once

#include "articula/config/yaml/filled_text.hpp"
#include "articula/config/yaml/node.hpp"
#include "articula/config/yaml/scalar.hpp"
#include "articula/text/characters.hpp"
#include "articula/text/file_error.hpp"
#include "articula/text/placeholder.hpp"

#include <yaml-cpp/anchor.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/mark.h>

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace articula::detail {

/// Builds the tree of a document from yaml-cpp's events. yaml-cpp's own tree silently drops one of
/// two equal keys, and grows without bound with aliases. This class refuses both. Only sections
/// with ros__parameters are combined, because ROS 2 takes those that a file repeats for one.
class ConfigBuilder final : public YAML::EventHandler {
 public:
  static constexpr std::size_t deepest = 32;        ///< levels of lists and maps
  static constexpr std::size_t most_nodes = 20000;  ///< including copies of aliases

  /// @param text    the text that is parsed; it must outlive this
  /// @param values  of placeholders
  ConfigBuilder(const FilledText& text, const ConfigValues& values) : text_(&text) {
    for (const auto& [name, value] : values) {
      value_names_ += (value_names_.empty() ? "'" : ", '") + shown(name) + "'";
    }
  }

  [[nodiscard]] ConfigNode take() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (started_) refuse(at(mark), "a second document begins", "one document in a file");
    started_ = true;
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    add({.place = at(mark)}, anchor);
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    check_tag(at(mark), tag, {"str", "int", "float", "bool", "null"});
    add({.kind = ConfigNode::Kind::scalar,
         .quoted = tag == "!" || tag.ends_with(":str"),
         .text = value,
         .place = at(mark)},
        anchor);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto found = anchors_.find(anchor);
    if (found == anchors_.end()) {
      refuse(at(mark), "an alias inside its own anchor", "an anchor that ends before it");
    }
    count(node_count(found->second), at(mark));
    check_depth(stack_.size() + node_height(found->second), at(mark));
    add(found->second, 0);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    check_tag(at(mark), tag, {"seq"});
    open({.kind = ConfigNode::Kind::list, .place = at(mark)}, anchor);
  }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    check_tag(at(mark), tag, {"map"});
    open({.kind = ConfigNode::Kind::map, .place = at(mark)}, anchor);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapEnd() override {
    ConfigNode& map = stack_.back().node;
    if (stack_.size() == 1) combine_sections(map);
    check_keys(map);
    close();
  }

 private:
  /// The number of levels of a tree.
  [[nodiscard]] static std::size_t node_height(const ConfigNode& node) noexcept {
    std::size_t height = 0;
    for (const ConfigNode& item : node.items) height = std::max(height, node_height(item));
    return height + 1;
  }

  /// A list or map that is not complete yet.
  struct Open {
    ConfigNode node;
    YAML::anchor_t anchor = 0;
    bool has_key = false;
    std::string key{};  ///< of the next value
    FilePlace key_place{};
  };

  [[nodiscard]] FilePlace at(const YAML::Mark& mark) const { return text_->in_file(mark); }
  [[noreturn]] void refuse(FilePlace place, const std::string& reason,
                           const std::string& expected) const {
    place.key = path();
    throw FileError(place, reason, expected);
  }
  /// The keys from the top to the current value.
  [[nodiscard]] std::string path() const {
    std::string result;
    for (const Open& open : stack_) {
      if (open.has_key) result += (result.empty() ? "" : ".") + shown(open.key);
    }
    return result;
  }
  void check_tag(const FilePlace& place, const std::string& tag,
                 std::initializer_list<const char*> allowed) const {
    const bool known = tag.empty() || tag == "?" || tag == "!" ||
                       std::any_of(allowed.begin(), allowed.end(), [&](const char* name) {
                         return tag == std::string("tag:yaml.org,2002:") + name;
                       });
    if (!known) refuse(place, "the tag '" + shown(tag) + "'", "no tag here");
  }
  void check_depth(std::size_t depth, const FilePlace& place) const {
    if (depth > deepest) {
      refuse(place, "it is nested too deeply",
             "at most " + std::to_string(deepest) + " nested lists and maps");
    }
  }
  [[nodiscard]] static bool is_section(const ConfigNode& node) {
    return node.key == "ros__parameters" ||
           (node.is_map() && std::ranges::any_of(node.items, is_section));
  }
  /// Makes one of the sections with the same key.
  /// @param in_repeated  whether the map itself was repeated: then all maps in it count as sections
  void combine_sections(ConfigNode& map, bool in_repeated = false) const {
    std::map<std::string, std::size_t> places;
    std::vector<ConfigNode> combined;
    std::set<std::size_t> repeated;
    const auto may_repeat = [&](const ConfigNode& node) {
      return is_section(node) || (in_repeated && node.is_map());
    };
    for (ConfigNode& item : map.items) {
      const auto [known, is_new] = places.try_emplace(item.key, combined.size());
      if (is_new || !may_repeat(item) || !may_repeat(combined[known->second])) {
        combined.push_back(std::move(item));
        continue;
      }
      ConfigNode& first = combined[known->second];
      if (item.kind == ConfigNode::Kind::nothing) continue;
      if (first.kind == ConfigNode::Kind::nothing) {
        first = std::move(item);
      } else if (first.is_map() && item.is_map()) {
        std::ranges::move(item.items, std::back_inserter(first.items));
        repeated.insert(known->second);
      } else {
        combined.push_back(std::move(item));
      }
    }
    for (const std::size_t place : repeated) {
      combine_sections(combined[place], true);
      check_keys(combined[place]);
    }
    map.items = std::move(combined);
  }
  /// Refuses two values of one key, at the second one.
  void check_keys(const ConfigNode& map) const {
    std::map<std::string_view, int> lines;
    for (const ConfigNode& item : map.items) {
      const auto [known, is_new] = lines.try_emplace(item.key, item.key_place.line);
      if (is_new) continue;
      refuse(item.key_place,
             "the key '" + shown(item.key) + "' is also in line " + std::to_string(known->second),
             "every key once");
    }
  }
  void count(std::size_t more, const FilePlace& place) {
    nodes_ += more;
    if (nodes_ > most_nodes) {
      refuse(place, "it is too large, copies of aliases included",
             "at most " + std::to_string(most_nodes) + " values");
    }
  }
  void open(ConfigNode node, YAML::anchor_t anchor) {
    if (awaits_key()) {
      const std::string_view placeholder = placeholder_in(line_of(text_->text(), node.place.line));
      if (placeholder.starts_with('{')) {  // to YAML, {{ kp }} is a map in a map
        refuse(node.place, placeholder_text(placeholder), "its value" + value_example(placeholder));
      }
      refuse(node.place, node.named() + " as a key", "a word");
    }
    check_depth(stack_.size() + 1, node.place);
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
  /// Takes a complete node: a key, or a value for the innermost open list or map.
  void add(ConfigNode node, YAML::anchor_t anchor) {
    count(1, node.place);
    if (anchor != 0) {
      count(node_count(node), node.place);
      anchors_[anchor] = node;
    }
    if (stack_.empty()) {
      root_ = std::move(node);
      return;
    }
    Open& parent = stack_.back();
    if (awaits_key()) {
      if (node.kind != ConfigNode::Kind::scalar || node.text.empty()) {
        refuse(node.place, node.named() + " as a key", "a word");
      }
      if (node.text == "<<" && !node.quoted) {
        refuse(node.place, "the merge key <<", "the values themselves");
      }
      if (!node.quoted && !odd_character_in(node.text).empty()) {
        refuse(node.place, "the key " + quoted_text(node.text), "an ordinary blank, or none");
      }
      parent.has_key = true;
      parent.key = std::move(node.text);
      parent.key_place = node.place;
      return;
    }
    if (parent.node.is_map()) {
      node.key = std::move(parent.key);
      node.key_place = parent.key_place;
      // yaml-cpp gives a missing value the place of the next token.
      if (node.kind == ConfigNode::Kind::nothing) node.place = node.key_place;
      parent.has_key = false;
    }
    if (has_placeholder(node.key) || has_placeholder(node.text)) node.value_names = value_names_;
    parent.node.items.push_back(std::move(node));
  }

  const FilledText* text_;
  std::string value_names_{};
  bool started_ = false;
  std::size_t nodes_ = 0;
  std::vector<Open> stack_{};
  std::map<YAML::anchor_t, ConfigNode> anchors_{};
  ConfigNode root_{};
};

}  // namespace articula::detail

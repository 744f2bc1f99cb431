// SPDX-License-Identifier: Apache-2.0
/// @file A map of a configuration whose keys the caller looks up; others are unknown keys.
#pragma once

#include "articula/config/yaml/node.hpp"
#include "articula/config/yaml/scalar.hpp"
#include "articula/text/file_error.hpp"
#include "articula/text/numbers.hpp"
#include "articula/text/similar_word.hpp"

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace articula::detail {

/// How to treat an unknown key that comes from a section with wildcards.
enum class Inherited : unsigned char {
  must_be_known,   ///< as any other: it is refused
  may_be_unknown,  ///< a note says that it is not used
};

/// A map of a configuration. Each look-up makes a key known. `finish()` refuses keys that are not
/// known by then.
class ConfigMap {
 public:
  /// @param notes      receives a line on each value that has no effect
  /// @param inherited  treatment of unknown keys from other sections
  /// @throws FileError if the value is no map
  ConfigMap(const ConfigNode& node, std::vector<std::string>& notes,
            Inherited inherited = Inherited::must_be_known)
      : node_(&node), notes_(&notes), tolerant_(inherited == Inherited::may_be_unknown) {
    if (node.is_map()) return;
    const std::string hint = key_hint(node.text, node.value_names);
    node.refuse("a map" + (hint.empty() ? hint : ", and " + hint));
  }

  [[nodiscard]] const ConfigNode& node() const noexcept { return *node_; }

  /// The value of a key; null if there is none.
  [[nodiscard]] const ConfigNode* find(std::string_view key) {
    if (!knows(key)) known_.emplace_back(key);
    const ConfigNode* item = node_->find(key);
    found_ += item == nullptr ? 0 : 1;
    return item;
  }
  /// The value of one of several keys with the same meaning; null if there is none.
  /// @throws FileError if there are several
  [[nodiscard]] const ConfigNode* find_one_of(std::initializer_list<std::string_view> keys) {
    const ConfigNode* found = nullptr;
    for (const std::string_view key : keys) {
      const ConfigNode* value = find(key);
      if (value && found) {
        value->refuse("'" + found->key + "' has the same meaning", "one of the two keys");
      }
      if (value) found = value;
    }
    return found;
  }
  /// The value of a key that must be there. If it is missing, `finish()` throws, since a misspelt
  /// key may be the reason.
  const ConfigNode* require(std::string_view key) {
    const ConfigNode* found = find(key);
    if (!found) missing_.emplace_back(key);
    return found;
  }
  [[nodiscard]] std::optional<ConfigMap> find_map(std::string_view key) {
    const ConfigNode* found = find(key);
    return found ? std::optional(ConfigMap(*found, *notes_)) : std::nullopt;
  }
  /// These read the value of a key into a variable, which keeps its value if there is no such key.
  void read_number(std::string_view key, double& number) {
    if (const auto value = find(key)) number = value->number();
  }
  void read_not_negative(std::string_view key, double& number) {
    if (const auto value = find(key)) number = value->not_negative();
  }
  void read_truth(std::string_view key, bool& truth) {
    if (const auto value = find(key)) truth = value->truth();
  }

  /// The number of look-ups that found a value.
  [[nodiscard]] std::size_t found() const noexcept { return found_; }
  [[nodiscard]] bool knows(std::string_view key) const {
    return std::find(known_.begin(), known_.end(), key) != known_.end();
  }
  /// True if a key is probably a misspelling of a known one.
  [[nodiscard]] bool nearly_knows(std::string_view key) const {
    return std::any_of(known_.begin(), known_.end(),
                       [&](const std::string& known) { return is_near(key, known); });
  }
  [[nodiscard]] bool has_unknown() const { return !unknown().empty(); }

  void note(const ConfigNode& value, std::string_view text) const {
    notes_->push_back(value.place.text() + std::string(text));
  }

  /// @throws FileError if the map has an unknown key, or lacks a required one
  void finish() const {
    constexpr std::size_t listed = 3, tried = 16;
    for (const ConfigNode& item : node_->items) {
      if (tolerant_ && item.inherited && !knows(item.key)) note(item, "not used here");
    }
    const auto others = unknown();
    refuse_malformed(others);
    const ConfigNode* wrong = others.empty() ? nullptr : others.front();
    if (!missing_.empty()) {
      // A misspelt key is the probable reason why another one is missing.
      const auto last =
          others.begin() + static_cast<std::ptrdiff_t>(std::min(others.size(), tried));
      const auto misspelt = std::find_if(
          others.begin(), last, [&](const ConfigNode* item) { return nearly_knows(item->key); });
      if (misspelt == last) {
        const std::string unknown =
            wrong == nullptr ? "" : "; its key '" + shown(wrong->key) + "' is unknown";
        node_->refuse("the key '" + missing_.front() + "' is missing", "it in this map" + unknown);
      }
      wrong = *misspelt;
    }
    if (wrong != nullptr) refuse_key(*wrong, one_of_words(wrong->key, known_, listed));
  }

  [[noreturn]] void refuse_key(const ConfigNode& item, const std::string& expected) const {
    throw FileError(item.key_place, "unknown key '" + shown(item.key) + "'", expected);
  }

 private:
  /// Refuses texts that YAML reads as keys and that were probably not meant as such.
  void refuse_malformed(const std::vector<const ConfigNode*>& others) const {
    for (const ConfigNode* item : others) {
      const std::string hint = key_hint(item->key, item->value_names);
      if (!hint.empty()) refuse_key(*item, hint);
      // YAML reads {p: 1,5} as p: 1 and a key 5 without a value.
      if (item->kind == ConfigNode::Kind::nothing && number_of(item->key)) {
        refuse_key(*item, "a decimal point, if the comma before it is a decimal one");
      }
    }
  }
  [[nodiscard]] std::vector<const ConfigNode*> unknown() const {
    std::vector<const ConfigNode*> items;
    for (const ConfigNode& item : node_->items) {
      if (!(tolerant_ && item.inherited) && !knows(item.key)) items.push_back(&item);
    }
    return items;
  }

  const ConfigNode* node_;
  std::vector<std::string>* notes_;
  bool tolerant_;
  std::vector<std::string> known_{}, missing_{};
  std::size_t found_ = 0;
};

}  // namespace articula::detail

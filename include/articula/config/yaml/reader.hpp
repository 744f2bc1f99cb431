// SPDX-License-Identifier: Apache-2.0
/// @file Takes values out of the maps of a configuration, and says what is wrong with them.
#pragma once

#include "articula/config/yaml/config_value.hpp"
#include "articula/config/yaml/node.hpp"
#include "articula/config/yaml/scalar.hpp"
#include "articula/text/file_error.hpp"
#include "articula/text/number_hint.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace articula::detail {

/// What becomes of a key that nobody asked for and that comes from another section, /** or so.
enum class Inherited : unsigned char {
  must_be_known,   ///< it is refused, as any other
  may_be_unknown,  ///< it is noted, since it may be for others
};

/// A map of a configuration. It remembers what was asked for: what is left over in the end is
/// unknown.
class ConfigMap {
 public:
  /// @param notes      receives what is known and not used
  /// @param inherited  what becomes of unknown keys from elsewhere
  /// @throws FileError if the value is no map
  ConfigMap(ConfigValue value, std::vector<std::string>& notes,
            Inherited inherited = Inherited::must_be_known)
      : value_(std::move(value)),
        notes_(&notes),
        tolerant_(inherited == Inherited::may_be_unknown) {
    const ConfigNode& node = value_.node();
    if (node.is_map()) return;
    const std::string hint =
        node.kind == ConfigNode::Kind::scalar ? key_hint(node.text, node.given) : "";
    value_.refuse("a map" + (hint.empty() ? hint : ", and " + hint));
  }

  [[nodiscard]] const ConfigValue& value() const noexcept { return value_; }

  /// The value under a key, if there is one.
  [[nodiscard]] std::optional<ConfigValue> find(std::string_view key) {
    if (!knows(key)) known_.emplace_back(key);
    const ConfigNode* item = value_.node().find(key);
    if (item == nullptr) return {};
    ++found_;
    return value_.at(*item);
  }
  /// The value under a key that must be there; if it is not, finish() throws. That may wait: what
  /// seems to be missing may be misspelt.
  [[nodiscard]] std::optional<ConfigValue> expect(std::string_view key) {
    auto found = find(key);
    if (!found) missing_.emplace_back(key);
    return found;
  }
  /// The map under a key, if there is one.
  [[nodiscard]] std::optional<ConfigMap> find_map(std::string_view key) {
    const auto found = find(key);
    if (!found) return {};
    return ConfigMap(*found, *notes_);
  }

  /// How many keys were asked for and there.
  [[nodiscard]] std::size_t found() const noexcept { return found_; }
  /// True if a key was asked for.
  [[nodiscard]] bool knows(std::string_view key) const {
    return std::find(known_.begin(), known_.end(), key) != known_.end();
  }
  /// True if a key is near to one that was asked for.
  [[nodiscard]] bool nearly_knows(std::string_view key) const {
    return std::any_of(known_.begin(), known_.end(),
                       [&](const std::string& known) { return is_near(key, known); });
  }
  /// True if there are keys that nobody asked for, what is inherited aside.
  [[nodiscard]] bool has_unknown() const { return !unknown().empty(); }

  /// Says something about a value.
  void note(const ConfigValue& at, std::string_view text) const {
    const FilePlace place = at.place();
    notes_->push_back(place.file + ":" + std::to_string(place.line) + ": " + place.key + ": " +
                      std::string(text));
  }

  /// @throws FileError if the map has a key that nobody asked for, or lacks one that it must have
  void finish() const {
    constexpr std::size_t listed = 3, tried = 16;
    for (const ConfigNode& item : value_.node().items) {
      if (tolerant_ && item.inherited && !knows(item.key)) note(value_.at(item), "not used here");
    }
    const auto others = unknown();
    refuse_slips(others);
    const ConfigNode* wrong = others.empty() ? nullptr : others.front();
    if (!missing_.empty()) {
      // What is almost a key is a slip, and the likely reason why another one is missing.
      const auto last =
          others.begin() + static_cast<std::ptrdiff_t>(std::min(others.size(), tried));
      const auto slip = std::find_if(
          others.begin(), last, [&](const ConfigNode* item) { return nearly_knows(item->key); });
      if (slip == last) {
        const std::string unknown =
            wrong == nullptr ? "" : ", where '" + shown(wrong->key) + "' is unknown";
        value_.refuse("the key '" + missing_.front() + "' is missing", "it here" + unknown);
      }
      wrong = *slip;
    }
    if (wrong != nullptr) refuse_key(*wrong, one_of_words(wrong->key, known_, listed));
  }

  /// @param keys      that may stand here, besides those that were asked for
  /// @param expected  what to say if there is another one
  /// @throws FileError if there is
  void allow_only(const std::vector<std::string>& keys, const std::string& expected) const {
    auto others = unknown();
    std::erase_if(others, [&](const ConfigNode* item) {
      return std::find(keys.begin(), keys.end(), item->key) != keys.end();
    });
    refuse_slips(others);
    if (others.empty()) return;
    refuse_key(*others.front(), expected + did_you_mean(others.front()->key, keys));
  }

 private:
  [[noreturn]] void refuse_key(const ConfigNode& item, const std::string& expected) const {
    FilePlace place = value_.at(item).place();
    place.line = item.key_mark.line;
    place.column = item.key_mark.column;
    throw FileError(place, "unknown key '" + shown(item.key) + "'", expected);
  }
  /// What YAML takes for a key though nobody has meant one.
  void refuse_slips(const std::vector<const ConfigNode*>& others) const {
    for (const ConfigNode* item : others) {
      const std::string hint = key_hint(item->key, item->given);
      if (!hint.empty()) refuse_key(*item, hint);
      // {p: 1,5} is p: 1 and 5: nothing.
      const bool is_bare = item->kind == ConfigNode::Kind::nothing && number_of(item->key);
      if (is_bare) refuse_key(*item, "a decimal point, if the comma before it is a decimal one");
    }
  }
  [[nodiscard]] std::vector<const ConfigNode*> unknown() const {
    std::vector<const ConfigNode*> items;
    for (const ConfigNode& item : value_.node().items) {
      if (!(tolerant_ && item.inherited) && !knows(item.key)) items.push_back(&item);
    }
    return items;
  }

  ConfigValue value_;
  std::vector<std::string>* notes_;
  bool tolerant_;
  std::vector<std::string> known_{}, missing_{};
  std::size_t found_ = 0;
};

}  // namespace articula::detail

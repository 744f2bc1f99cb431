// SPDX-License-Identifier: Apache-2.0
#include "articula/view/protocol/json/members.hpp"

#include "articula/recording/change_json.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace articula::view {

namespace {

constexpr std::size_t longest_text = 256;  // bytes; names of joints have at most 63

bool is_number(const Json& x) { return x.is_number(); }

bool is_gain(const Json& x) { return gain_of_json(x).has_value(); }

bool is_integer(const Json& x) {
  if (x.is_number_unsigned()) {
    return x.get<std::uint64_t>() <= std::uint64_t{std::numeric_limits<std::int32_t>::max()};
  }
  return x.is_number_integer() && x.get<std::int64_t>() >= std::numeric_limits<std::int32_t>::min();
}

bool is_text(const Json& x) {
  return x.is_string() && x.get_ref<const std::string&>().size() <= longest_text;
}

bool all_are(const Json& container, bool (*is)(const Json&)) {
  return std::all_of(container.begin(), container.end(), is);
}

bool has_short_names(const Json& object) {
  const auto items = object.items();
  return std::all_of(items.begin(), items.end(),
                     [](const auto& item) { return item.key().size() <= longest_text; });
}

bool is_duration(const Json& x) {
  if (x.is_number()) return true;
  if (!x.is_object()) return false;
  for (const auto& [name, value] : x.items()) {
    if ((name != "sec" && name != "nanosec" && name != "nsec") || !value.is_number()) return false;
  }
  return true;
}

bool is_of(Kind kind, const Json& x) {
  switch (kind) {
    case Kind::number:
      return is_number(x);
    case Kind::integer:
      return is_integer(x);
    case Kind::boolean:
      return x.is_boolean();
    case Kind::text:
      return is_text(x);
    case Kind::number_by_name:
      return x.is_object() && has_short_names(x) && all_are(x, is_number);
    case Kind::gain_by_name:
      return x.is_object() && has_short_names(x) && all_are(x, is_gain);
    case Kind::numbers:
      return x.is_array() && all_are(x, is_number);
    case Kind::number_lists:
      return x.is_array() &&
             all_are(x, [](const Json& y) { return y.is_array() && all_are(y, is_number); });
    case Kind::three_numbers:
      return x.is_array() && x.size() == 3 && all_are(x, is_number);
    case Kind::texts:
      return x.is_array() && all_are(x, is_text);
    case Kind::object:
      return x.is_object();
    case Kind::objects:
      return x.is_array() && all_are(x, [](const Json& y) { return y.is_object(); });
    case Kind::duration:
      return is_duration(x);
    case Kind::anything:
      return true;
  }
  return false;
}

std::string_view words_for(Kind kind) {
  switch (kind) {
    case Kind::number:
      return "a number";
    case Kind::integer:
      return "an integer of 32 bits";
    case Kind::boolean:
      return "true or false";
    case Kind::text:
      return "a text of at most 256 bytes";
    case Kind::number_by_name:
      return "an object of numbers, as {\"shoulder\": 0.5}";
    case Kind::gain_by_name:
      return "an object of numbers, \"inf\" or \"-inf\", as {\"pid.elbow.p\": 300}";
    case Kind::numbers:
      return "an array of numbers";
    case Kind::number_lists:
      return "an array of arrays of numbers";
    case Kind::three_numbers:
      return "an array of three numbers";
    case Kind::texts:
      return "an array of texts of at most 256 bytes";
    case Kind::object:
      return "an object";
    case Kind::objects:
      return "an array of objects";
    case Kind::duration:
      return "a number of seconds, or {\"sec\": 1, \"nanosec\": 0}";
    case Kind::anything:
      break;
  }
  return "a value";
}

std::string names_of(std::span<const Member> members) {
  std::string names;
  for (const Member& member : members) {
    if (member.kind == Kind::anything) continue;
    names += names.empty() ? "" : ", ";
    names += member.name;
  }
  return names.empty() ? "no members" : names;
}

Json schema_of_kind(Kind kind) {
  const Json number = {{"type", "number"}};
  switch (kind) {
    case Kind::number:
    case Kind::duration:
      return number;
    case Kind::integer:
      return {{"type", "integer"}};
    case Kind::boolean:
      return {{"type", "boolean"}};
    case Kind::text:
      return {{"type", "string"}};
    case Kind::number_by_name:
      return {{"type", "object"}, {"additionalProperties", number}};
    case Kind::gain_by_name:
      return {{"type", "object"},
              {"additionalProperties",
               {{"anyOf", Json::array({number, {{"enum", Json::array({"inf", "-inf"})}}})}}}};
    case Kind::numbers:
      return {{"type", "array"}, {"items", number}};
    case Kind::number_lists:
      return {{"type", "array"}, {"items", schema_of_kind(Kind::numbers)}};
    case Kind::three_numbers:
      return {{"type", "array"}, {"items", number}, {"minItems", 3}, {"maxItems", 3}};
    case Kind::texts:
      return {{"type", "array"}, {"items", {{"type", "string"}}}};
    case Kind::object:
      return {{"type", "object"}};
    case Kind::objects:
      return {{"type", "array"}, {"items", {{"type", "object"}}}};
    case Kind::anything:
      break;
  }
  return Json::object();
}

}  // namespace

std::string fault_of(const Json& object, std::span<const Member> members,
                     const std::string& place) {
  for (const auto& item : object.items()) {
    const std::string& name = item.key();
    const auto member = std::find_if(members.begin(), members.end(),
                                     [&](const Member& m) { return m.name == name; });
    if (member == members.end()) {
      return place + name.substr(0, longest_text) + ": unknown; expected " + names_of(members);
    }
    if (!is_of(member->kind, item.value())) {
      return place + name + ": expected " + std::string(words_for(member->kind));
    }
  }
  for (const Member& member : members) {
    if (member.required && !object.contains(member.name)) {
      return place + std::string(member.name) + ": missing; expected " +
             std::string(words_for(member.kind));
    }
  }
  return {};
}

Json schema_of(std::span<const Member> members) {
  Json schema = {{"type", "object"}};
  if (!members.empty()) schema["properties"] = Json::object();
  for (const Member& member : members) {
    schema["properties"][std::string(member.name)] = schema_of_kind(member.kind);
    if (member.required) schema["required"].push_back(member.name);
  }
  return schema;
}

}  // namespace articula::view

// SPDX-License-Identifier: Apache-2.0
#include "articula/view/protocol/read_stateless.hpp"

#include "articula/recording/change_json.hpp"

#include <limits>
#include <utility>

namespace articula::view {

namespace {

std::optional<std::vector<std::string>> names_of(const Json& message) {
  const Json* list = list_of(message, "parameterNames");
  if (list == nullptr) return std::nullopt;
  std::vector<std::string> names;
  for (const Json& name : *list) {
    if (!name.is_string() || name.get_ref<const std::string&>().size() > longest_name) {
      return std::nullopt;
    }
    names.push_back(name.get<std::string>());
  }
  return names;
}

const std::string names_expected =
    "\"parameterNames\", an array of at most " + std::to_string(longest_list) + " texts";

MalformedParameters malformed(const std::string& op, const Json& message, const std::string& what) {
  return {expected(op, what).text, text_of(message, "id")};
}

Action read_get_parameters(const Json& message) {
  auto names = names_of(message);
  if (!names) return malformed("getParameters", message, names_expected);
  return ParameterQuestion{std::move(*names), text_of(message, "id")};
}

Action read_set_parameters(const Json& message) {
  const auto fail = [&](const std::string& what) {
    return malformed("setParameters", message, what);
  };
  const Json* list = list_of(message, "parameters");
  if (list == nullptr) {
    return fail("\"parameters\", an array of at most " + std::to_string(longest_list));
  }
  ParameterSetting setting{{}, text_of(message, "id")};
  for (const Json& parameter : *list) {
    const auto name = text_of(parameter, "name");
    if (!name) return fail("a \"name\" in each parameter");
    const auto value = gain_of_json(parameter.value("value", Json()));
    if (!value) {
      return fail("a number, \"inf\" or \"-inf\" as \"value\" of '" + name->substr(0, 256) + "'");
    }
    setting.values.push_back({*name, *value});
  }
  return setting;
}

Action read_watch(const Json& message, bool watch) {
  auto names = names_of(message);
  if (!names) {
    return expected(watch ? "subscribeParameterUpdates" : "unsubscribeParameterUpdates",
                    names_expected);
  }
  return ParameterWatch{std::move(*names), watch};
}

Action read_fetch_asset(const Json& message) {
  auto uri = text_of(message, "uri");
  const auto request = number_of(message, "requestId");
  if (!uri || !request) return expected("fetchAsset", "a \"uri\" and a \"requestId\"");
  return AssetQuestion{std::move(*uri), *request};
}

}  // namespace

std::optional<std::uint32_t> number_of(const Json& object, const char* member) {
  const auto found = object.find(member);
  if (found == object.end() || !found->is_number_unsigned()) return std::nullopt;
  const auto number = found->get<std::uint64_t>();
  if (number > std::numeric_limits<std::uint32_t>::max()) return std::nullopt;
  return static_cast<std::uint32_t>(number);
}

std::optional<std::string> text_of(const Json& object, const char* member) {
  const auto found = object.find(member);
  if (found == object.end() || !found->is_string()) return std::nullopt;
  const auto& text = found->get_ref<const std::string&>();
  if (text.size() > longest_name) return std::nullopt;
  return text;
}

const Json* list_of(const Json& message, const char* member) {
  const auto found = message.find(member);
  const bool usable = found != message.end() && found->is_array() && found->size() <= longest_list;
  return usable ? &*found : nullptr;
}

Complaint expected(const std::string& op, const std::string& what) {
  return {op + ": expected " + what};
}

std::optional<std::uint32_t> take_number(std::string_view& bytes) {
  if (bytes.size() < 4) return std::nullopt;
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    number |= std::uint32_t{static_cast<unsigned char>(bytes[i])} << (8 * i);
  }
  bytes.remove_prefix(4);
  return number;
}

Action read_stateless(const std::string& op, const Json& message) {
  if (op == "getParameters") return read_get_parameters(message);
  if (op == "setParameters") return read_set_parameters(message);
  if (op == "subscribeParameterUpdates") return read_watch(message, true);
  if (op == "unsubscribeParameterUpdates") return read_watch(message, false);
  if (op == "fetchAsset") return read_fetch_asset(message);
  return Complaint{"there is no operation '" + op.substr(0, 64) + "'"};
}

Action read_service_call(std::string_view bytes) {
  const auto service = take_number(bytes), call = take_number(bytes), length = take_number(bytes);
  if (!length || *length > bytes.size()) return Complaint{"a service call is too short"};
  const std::string_view encoding = bytes.substr(0, *length), text = bytes.substr(*length);
  const auto fail = [&](const char* why) { return MalformedCall{*service, *call, why}; };
  if (*service == 0 || *service > services().size()) return fail("there is no such service");
  if (encoding != "json") return fail("the encoding of a call must be \"json\"");
  const auto json = parse_json(text.empty() ? "{}" : text);  // "no members" may be no text, too
  if (!json || !json->is_object()) return fail("the text of a call must be a JSON object");
  return ServiceCall{*service, *call, read_call(services()[*service - 1], *json)};
}

}  // namespace articula::view

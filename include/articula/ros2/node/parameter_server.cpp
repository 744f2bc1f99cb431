// SPDX-License-Identifier: Apache-2.0
#include "articula/ros2/node/parameter_server.hpp"

#include "articula/ros2/messages/type_description_interfaces.hpp"
#include "articula/ros2/node/ros_time.hpp"
#include "articula/ros2/node/service.hpp"
#include "articula/text/numbers.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

namespace articula::ros2 {

namespace {

namespace messages = rcl_interfaces::msg;
namespace services = rcl_interfaces::srv;
using Type = messages::ParameterType;
using Value = messages::ParameterValue<Jazzy>;

bool same(const Value& a, const Value& b) {
  return a.type == b.type && a.bool_value == b.bool_value && a.integer_value == b.integer_value &&
         a.double_value == b.double_value && a.string_value == b.string_value &&
         a.byte_array_value == b.byte_array_value && a.bool_array_value == b.bool_array_value &&
         a.integer_array_value == b.integer_array_value &&
         a.double_array_value == b.double_array_value &&
         a.string_array_value == b.string_array_value;
}

std::string_view type_name(std::uint8_t type) {
  constexpr std::array<std::string_view, 10> names{
      "not set",    "bool",       "integer",       "double",       "string",
      "byte array", "bool array", "integer array", "double array", "string array"};
  return type < names.size() ? names[type] : "unknown";
}

const NodeParameter* find(const std::vector<NodeParameter>& all, std::string_view name) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const NodeParameter& own) {
    return own.descriptor.name == name;
  });
  return found == all.end() ? nullptr : &*found;
}

std::uint64_t depth_of(std::string_view name) {
  return static_cast<std::uint64_t>(std::count(name.begin(), name.end(), '.'));
}

const std::string too_many_text =
    "a request has at most " + std::to_string(ParameterServer::most_names) + " parameters";

/// Whether a name is listed: it is one of the prefixes or below it, at most so deep.
bool is_listed(std::string_view name, const services::ListParameters<Jazzy>::Request& request) {
  const bool unlimited = request.depth == 0;
  if (request.prefixes.empty()) return unlimited || depth_of(name) < request.depth;
  return std::any_of(request.prefixes.begin(), request.prefixes.end(),
                     [&](const std::string& prefix) {
                       if (name == prefix) return true;
                       if (!name.starts_with(prefix + ".")) return false;
                       return unlimited || depth_of(name.substr(prefix.size() + 1)) < request.depth;
                     });
}

/// The number that is all of a text, also an infinite one as Python writes it.
std::optional<double> number_in(std::string_view text) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (text == "inf" || text == ".inf") return infinity;
  if (text == "-inf" || text == "-.inf") return -infinity;
  return articula::detail::number_of(text);
}

}  // namespace

Value to_value(bool value) { return {.type = Type::boolean, .bool_value = value}; }
Value to_value(std::int64_t value) { return {.type = Type::integer, .integer_value = value}; }
Value to_value(double value) { return {.type = Type::floating_point, .double_value = value}; }
Value to_value(std::string value) {
  return {.type = Type::string, .string_value = std::move(value)};
}
Value to_value(std::vector<std::string> values) {
  return {.type = Type::string_array, .string_array_value = std::move(values)};
}

NodeParameter read_only(std::string name, Value value, std::string description) {
  NodeParameter parameter{.value = std::move(value)};
  parameter.descriptor.name = std::move(name);
  parameter.descriptor.type = parameter.value.type;
  parameter.descriptor.description = std::move(description);
  parameter.descriptor.read_only = true;
  return parameter;
}

ParameterServer::ParameterServer(const Node& node, ParameterStore& store)
    : node_(node),
      store_(store),
      events_(node, "/parameter_events", quality_of_service::parameter_events) {
  for (const NodeParameter& own : store_.list()) known_[own.descriptor.name] = own.value;
  serve_reading();
  serve_setting();
}

void ParameterServer::update() {
  if (look_due_.due(node_.context().wall)) publish_changes();
}

bool ParameterServer::too_many(const auto& names) {
  if (names.size() <= most_names) return false;
  ++node_.context().dropped.refused;
  return true;
}

std::vector<NodeParameter> ParameterServer::named(const std::vector<std::string>& names) {
  const auto all = store_.list();
  std::vector<NodeParameter> found;
  for (const std::string& name : names) {
    if (const NodeParameter* const own = find(all, name)) found.push_back(*own);
  }
  return found;
}

void ParameterServer::serve_reading() {
  const auto quality = quality_of_service::parameters;
  serve<services::ListParameters<Jazzy>>(
      node_, "~/list_parameters",
      [this](const auto& request, const auto& reply) {
        services::ListParameters<Jazzy>::Response response;
        auto& [names, prefixes] = response.result;
        for (const NodeParameter& own : store_.list()) {
          const std::string& name = own.descriptor.name;
          if (!is_listed(name, request)) continue;
          names.push_back(name);
          const std::size_t end = name.rfind('.');
          if (end == std::string::npos) continue;
          const std::string prefix = name.substr(0, end);
          if (std::find(prefixes.begin(), prefixes.end(), prefix) == prefixes.end()) {
            prefixes.push_back(prefix);
          }
        }
        reply.send(response);
      },
      quality);
  serve<services::GetParameters<Jazzy>>(
      node_, "~/get_parameters",
      [this](const auto& request, const auto& reply) {
        if (too_many(request.names)) return reply.send({});
        const auto all = store_.list();
        services::GetParameters<Jazzy>::Response response;
        for (const std::string& name : request.names) {
          const NodeParameter* const own = find(all, name);
          response.values.push_back(own == nullptr ? Value{} : own->value);
        }
        reply.send(response);
      },
      quality);
  // The answers to the next two are empty if a name is unknown, as in rclcpp.
  serve<services::GetParameterTypes<Jazzy>>(
      node_, "~/get_parameter_types",
      [this](const auto& request, const auto& reply) {
        if (too_many(request.names)) return reply.send({});
        services::GetParameterTypes<Jazzy>::Response response;
        for (const NodeParameter& own : named(request.names)) {
          response.types.push_back(own.value.type);
        }
        if (response.types.size() != request.names.size()) response.types.clear();
        reply.send(response);
      },
      quality);
  serve<services::DescribeParameters<Jazzy>>(
      node_, "~/describe_parameters",
      [this](const auto& request, const auto& reply) {
        if (too_many(request.names)) return reply.send({});
        services::DescribeParameters<Jazzy>::Response response;
        for (NodeParameter& own : named(request.names)) {
          response.descriptors.push_back(std::move(own.descriptor));
        }
        if (response.descriptors.size() != request.names.size()) response.descriptors.clear();
        reply.send(response);
      },
      quality);
  if (!node_.context().has_hashes()) return;  // Humble has no such service
  using Describe = type_description_interfaces::srv::GetTypeDescription<Jazzy>;
  serve<Describe>(node_, "~/get_type_description", [](const auto&, const auto& reply) {
    typename Describe::Response response;
    response.failure_reason = "Type not currently in use by this node";
    reply.send(response);
  });
}

void ParameterServer::serve_setting() {
  const auto quality = quality_of_service::parameters;
  serve<services::SetParameters<Jazzy>>(
      node_, "~/set_parameters",
      [this](const auto& request, const auto& reply) {
        const std::size_t count = request.parameters.size();
        if (count == 0) return reply.send({});
        if (too_many(request.parameters)) {
          const messages::SetParametersResult<Jazzy> refusal{false, too_many_text};
          return reply.send({.results = std::vector(count, refusal)});
        }
        const auto open = std::make_shared<OpenSetting>();
        open->answer = [this, reply](const auto& results) {
          publish_changes();
          reply.send({.results = results});
        };
        open->results.resize(count);
        const auto all = store_.list();
        for (std::size_t i = 0; i < count; ++i) {
          messages::Parameter<Jazzy> own = request.parameters[i];
          const std::string reason = check(all, own);
          open->results[i] = {reason.empty(), reason};
          if (!reason.empty()) continue;
          const bool again = std::any_of(open->wanted.begin(), open->wanted.end(),
                                         [&](const auto& other) { return other.name == own.name; });
          if (!again && unchanged(*find(all, own.name), own.value)) continue;
          open->wanted.push_back(std::move(own));
          open->places.push_back(i);
        }
        if (open->wanted.empty()) return open->answer(open->results);
        set(open->wanted, [this, open](const std::string& reason) {
          if (reason.empty()) return open->answer(open->results);
          set_next(open);
        });
      },
      quality);
  serve<services::SetParametersAtomically<Jazzy>>(
      node_, "~/set_parameters_atomically",
      [this](const auto& request, const auto& reply) {
        if (too_many(request.parameters)) {
          return reply.send({.result = {false, too_many_text}});
        }
        const auto answer = [this, reply](const std::string& reason) {
          publish_changes();
          reply.send({.result = {reason.empty(), reason}});
        };
        const auto all = store_.list();
        NamedValues wanted;
        for (messages::Parameter<Jazzy> own : request.parameters) {
          if (const std::string reason = check(all, own); !reason.empty()) return answer(reason);
          std::erase_if(wanted, [&](const auto& other) { return other.name == own.name; });
          if (!unchanged(*find(all, own.name), own.value)) wanted.push_back(std::move(own));
        }
        wanted.empty() ? answer({}) : set(wanted, answer);
      },
      quality);
}

bool ParameterServer::unchanged(const NodeParameter& present, const Value& wanted) const {
  if (present.descriptor.read_only) return true;
  return on_their_way_ == 0 && same(present.value, wanted);
}

void ParameterServer::set(const NamedValues& values, const ParameterStore::OnSet& on_set) {
  ++on_their_way_;
  store_.set(values, [this, on_set](const std::string& reason) {
    --on_their_way_;
    on_set(reason);
  });
}

std::string ParameterServer::check(const std::vector<NodeParameter>& all,
                                   messages::Parameter<Jazzy>& wanted) const {
  const NodeParameter* const own = find(all, wanted.name);
  if (own == nullptr) {
    return "parameter '" + wanted.name + "' cannot be set because it was not declared";
  }
  if (own->value.type == Type::floating_point && wanted.value.type == Type::integer) {
    wanted.value = to_value(static_cast<double>(wanted.value.integer_value));
  }
  if (own->value.type == Type::floating_point && wanted.value.type == Type::string) {
    // `ros2 param load` sends .inf and 1.0e-05 as the texts "inf" and "1e-05".
    const auto number = number_in(wanted.value.string_value);
    if (number) wanted.value = to_value(*number);
  }
  if (wanted.value.type != own->value.type) {
    return "Wrong parameter type, parameter {" + wanted.name + "} is of type {" +
           std::string(type_name(own->value.type)) + "}, setting it to {" +
           std::string(type_name(wanted.value.type)) + "} is not allowed.";
  }
  if (own->descriptor.read_only && !same(own->value, wanted.value)) {
    return "parameter '" + wanted.name + "' cannot be set because it is read-only";
  }
  return {};
}

void ParameterServer::set_next(const std::shared_ptr<OpenSetting>& open) {
  if (open->next == open->wanted.size()) return open->answer(open->results);
  const std::size_t own = open->next++;
  set({open->wanted[own]}, [this, open, own](const std::string& reason) {
    open->results[open->places[own]] = {reason.empty(), reason};
    set_next(open);
  });
}

void ParameterServer::publish_changes() {
  messages::ParameterEvent<Jazzy> event;
  for (NodeParameter& own : store_.list()) {
    Value& known = known_[own.descriptor.name];
    if (same(known, own.value)) continue;
    known = own.value;
    event.changed_parameters.push_back({own.descriptor.name, std::move(own.value)});
  }
  if (event.changed_parameters.empty()) return;
  event.stamp = to_message<builtin_interfaces::msg::Time>(node_.context().now);
  event.node = node_.name();
  events_.publish(event);
}

}  // namespace articula::ros2

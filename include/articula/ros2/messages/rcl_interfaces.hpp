// SPDX-License-Identifier: Apache-2.0
/// @file The parameters and log messages of nodes.
#pragma once

#include "articula/ros2/fields.hpp"
#include "articula/ros2/messages/builtin_interfaces.hpp"

#include <cstddef>
#include <cstdint>

namespace articula::ros2::rcl_interfaces {

namespace msg {

/// The values that a parameter may have.
struct FloatingPointRange {
  double from_value = 0;
  double to_value = 0;
  double step = 0;  ///< 0: any value in the range

  static constexpr TypeName ros_type = "rcl_interfaces/msg/FloatingPointRange";
  static constexpr FieldNames<3> ros_fields{"from_value", "to_value", "step"};
};

/// The values that a parameter may have.
struct IntegerRange {
  std::int64_t from_value = 0;
  std::int64_t to_value = 0;
  std::uint64_t step = 0;  ///< 0: any value in the range

  static constexpr TypeName ros_type = "rcl_interfaces/msg/IntegerRange";
  static constexpr FieldNames<3> ros_fields{"from_value", "to_value", "step"};
};

/// Names of parameters.
template <class Layout>
struct ListParametersResult {
  Sequence<Layout, Text<Layout>> names{};
  Sequence<Layout, Text<Layout>> prefixes{};

  static constexpr TypeName ros_type = "rcl_interfaces/msg/ListParametersResult";
  static constexpr FieldNames<2> ros_fields{"names", "prefixes"};
};

/// One line of a log.
template <class Layout>
struct Log {
  builtin_interfaces::msg::Time stamp{};
  std::uint8_t level = 0;
  Text<Layout> name{};
  Text<Layout> msg{};
  Text<Layout> file{};
  Text<Layout> function{};
  std::uint32_t line = 0;

  static constexpr std::uint8_t debug = 10;
  static constexpr std::uint8_t info = 20;
  static constexpr std::uint8_t warn = 30;
  static constexpr std::uint8_t error = 40;
  static constexpr std::uint8_t fatal = 50;
  static constexpr TypeName ros_type = "rcl_interfaces/msg/Log";
  static constexpr FieldNames<7> ros_fields{"stamp", "level",    "name", "msg",
                                            "file",  "function", "line"};
};

/// The least level of messages that are logged.
template <class Layout>
struct LoggerLevel {
  Text<Layout> name{};
  std::uint32_t level = 0;

  static constexpr TypeName ros_type = "rcl_interfaces/msg/LoggerLevel";
  static constexpr FieldNames<2> ros_fields{"name", "level"};
};

/// The kinds of parameters.
struct ParameterType {
  static constexpr std::uint8_t not_set = 0;
  static constexpr std::uint8_t boolean = 1;
  static constexpr std::uint8_t integer = 2;
  static constexpr std::uint8_t floating_point = 3;
  static constexpr std::uint8_t string = 4;
  static constexpr std::uint8_t byte_array = 5;
  static constexpr std::uint8_t bool_array = 6;
  static constexpr std::uint8_t integer_array = 7;
  static constexpr std::uint8_t double_array = 8;
  static constexpr std::uint8_t string_array = 9;

  static constexpr TypeName ros_type = "rcl_interfaces/msg/ParameterType";
  static constexpr FieldNames<0> ros_fields{};
};

/// A value, which is in the member of its type.
template <class Layout>
struct ParameterValue {
  std::uint8_t type = 0;  ///< see ParameterType
  bool bool_value = false;
  std::int64_t integer_value = 0;
  double double_value = 0;
  Text<Layout> string_value{};
  Sequence<Layout, std::byte> byte_array_value{};
  Sequence<Layout, bool> bool_array_value{};
  Sequence<Layout, std::int64_t> integer_array_value{};
  Sequence<Layout, double> double_array_value{};
  Sequence<Layout, Text<Layout>> string_array_value{};

  static constexpr TypeName ros_type = "rcl_interfaces/msg/ParameterValue";
  static constexpr FieldNames<10> ros_fields{"type",
                                             "bool_value",
                                             "integer_value",
                                             "double_value",
                                             "string_value",
                                             "byte_array_value",
                                             "bool_array_value",
                                             "integer_array_value",
                                             "double_array_value",
                                             "string_array_value"};
};

/// A parameter with its value.
template <class Layout>
struct Parameter {
  Text<Layout> name{};
  msg::ParameterValue<Layout> value{};

  static constexpr TypeName ros_type = "rcl_interfaces/msg/Parameter";
  static constexpr FieldNames<2> ros_fields{"name", "value"};
};

/// What a parameter is, and which values it may have.
template <class Layout>
struct ParameterDescriptor {
  Text<Layout> name{};
  std::uint8_t type = 0;  ///< see ParameterType
  Text<Layout> description{};
  Text<Layout> additional_constraints{};
  bool read_only = false;
  bool dynamic_typing = false;
  BoundedSequence<msg::FloatingPointRange, 1> floating_point_range{};
  BoundedSequence<msg::IntegerRange, 1> integer_range{};

  static constexpr TypeName ros_type = "rcl_interfaces/msg/ParameterDescriptor";
  static constexpr FieldNames<8> ros_fields{
      "name",      "type",           "description",          "additional_constraints",
      "read_only", "dynamic_typing", "floating_point_range", "integer_range"};
};

/// Parameters of a node that have changed.
template <class Layout>
struct ParameterEvent {
  builtin_interfaces::msg::Time stamp{};
  Text<Layout> node{};
  Sequence<Layout, msg::Parameter<Layout>> new_parameters{};
  Sequence<Layout, msg::Parameter<Layout>> changed_parameters{};
  Sequence<Layout, msg::Parameter<Layout>> deleted_parameters{};

  static constexpr TypeName ros_type = "rcl_interfaces/msg/ParameterEvent";
  static constexpr FieldNames<5> ros_fields{"stamp", "node", "new_parameters", "changed_parameters",
                                            "deleted_parameters"};
};

/// Descriptions of parameters that have changed.
template <class Layout>
struct ParameterEventDescriptors {
  Sequence<Layout, msg::ParameterDescriptor<Layout>> new_parameters{};
  Sequence<Layout, msg::ParameterDescriptor<Layout>> changed_parameters{};
  Sequence<Layout, msg::ParameterDescriptor<Layout>> deleted_parameters{};

  static constexpr TypeName ros_type = "rcl_interfaces/msg/ParameterEventDescriptors";
  static constexpr FieldNames<3> ros_fields{"new_parameters", "changed_parameters",
                                            "deleted_parameters"};
};

/// Whether a level was set.
template <class Layout>
struct SetLoggerLevelsResult {
  bool successful = false;
  Text<Layout> reason{};

  static constexpr TypeName ros_type = "rcl_interfaces/msg/SetLoggerLevelsResult";
  static constexpr FieldNames<2> ros_fields{"successful", "reason"};
};

/// Whether parameters were set.
template <class Layout>
struct SetParametersResult {
  bool successful = false;
  Text<Layout> reason{};

  static constexpr TypeName ros_type = "rcl_interfaces/msg/SetParametersResult";
  static constexpr FieldNames<2> ros_fields{"successful", "reason"};
};
}  // namespace msg

namespace srv {

/// Asks what parameters are.
template <class Layout>
struct DescribeParameters {
  static constexpr TypeName ros_type = "rcl_interfaces/srv/DescribeParameters";

  struct Request {
    Sequence<Layout, Text<Layout>> names{};

    static constexpr TypeName ros_type = "rcl_interfaces/srv/DescribeParameters_Request";
    static constexpr FieldNames<1> ros_fields{"names"};
  };
  struct Response {
    Sequence<Layout, msg::ParameterDescriptor<Layout>> descriptors{};

    static constexpr TypeName ros_type = "rcl_interfaces/srv/DescribeParameters_Response";
    static constexpr FieldNames<1> ros_fields{"descriptors"};
  };
};

/// Asks for levels of loggers.
template <class Layout>
struct GetLoggerLevels {
  static constexpr TypeName ros_type = "rcl_interfaces/srv/GetLoggerLevels";

  struct Request {
    Sequence<Layout, Text<Layout>> names{};

    static constexpr TypeName ros_type = "rcl_interfaces/srv/GetLoggerLevels_Request";
    static constexpr FieldNames<1> ros_fields{"names"};
  };
  struct Response {
    Sequence<Layout, msg::LoggerLevel<Layout>> levels{};

    static constexpr TypeName ros_type = "rcl_interfaces/srv/GetLoggerLevels_Response";
    static constexpr FieldNames<1> ros_fields{"levels"};
  };
};

/// Asks for types of parameters.
template <class Layout>
struct GetParameterTypes {
  static constexpr TypeName ros_type = "rcl_interfaces/srv/GetParameterTypes";

  struct Request {
    Sequence<Layout, Text<Layout>> names{};

    static constexpr TypeName ros_type = "rcl_interfaces/srv/GetParameterTypes_Request";
    static constexpr FieldNames<1> ros_fields{"names"};
  };
  struct Response {
    Sequence<Layout, std::uint8_t> types{};

    static constexpr TypeName ros_type = "rcl_interfaces/srv/GetParameterTypes_Response";
    static constexpr FieldNames<1> ros_fields{"types"};
  };
};

/// Asks for values of parameters.
template <class Layout>
struct GetParameters {
  static constexpr TypeName ros_type = "rcl_interfaces/srv/GetParameters";

  struct Request {
    Sequence<Layout, Text<Layout>> names{};

    static constexpr TypeName ros_type = "rcl_interfaces/srv/GetParameters_Request";
    static constexpr FieldNames<1> ros_fields{"names"};
  };
  struct Response {
    Sequence<Layout, msg::ParameterValue<Layout>> values{};

    static constexpr TypeName ros_type = "rcl_interfaces/srv/GetParameters_Response";
    static constexpr FieldNames<1> ros_fields{"values"};
  };
};

/// Asks for names of parameters.
template <class Layout>
struct ListParameters {
  static constexpr TypeName ros_type = "rcl_interfaces/srv/ListParameters";

  struct Request {
    Sequence<Layout, Text<Layout>> prefixes{};
    std::uint64_t depth = 0;  ///< 0: no limit

    static constexpr TypeName ros_type = "rcl_interfaces/srv/ListParameters_Request";
    static constexpr FieldNames<2> ros_fields{"prefixes", "depth"};
  };
  struct Response {
    msg::ListParametersResult<Layout> result{};

    static constexpr TypeName ros_type = "rcl_interfaces/srv/ListParameters_Response";
    static constexpr FieldNames<1> ros_fields{"result"};
  };
};

/// Sets levels of loggers.
template <class Layout>
struct SetLoggerLevels {
  static constexpr TypeName ros_type = "rcl_interfaces/srv/SetLoggerLevels";

  struct Request {
    Sequence<Layout, msg::LoggerLevel<Layout>> levels{};

    static constexpr TypeName ros_type = "rcl_interfaces/srv/SetLoggerLevels_Request";
    static constexpr FieldNames<1> ros_fields{"levels"};
  };
  struct Response {
    Sequence<Layout, msg::SetLoggerLevelsResult<Layout>> results{};

    static constexpr TypeName ros_type = "rcl_interfaces/srv/SetLoggerLevels_Response";
    static constexpr FieldNames<1> ros_fields{"results"};
  };
};

/// Sets parameters one by one.
template <class Layout>
struct SetParameters {
  static constexpr TypeName ros_type = "rcl_interfaces/srv/SetParameters";

  struct Request {
    Sequence<Layout, msg::Parameter<Layout>> parameters{};

    static constexpr TypeName ros_type = "rcl_interfaces/srv/SetParameters_Request";
    static constexpr FieldNames<1> ros_fields{"parameters"};
  };
  struct Response {
    Sequence<Layout, msg::SetParametersResult<Layout>> results{};

    static constexpr TypeName ros_type = "rcl_interfaces/srv/SetParameters_Response";
    static constexpr FieldNames<1> ros_fields{"results"};
  };
};

/// Sets all of the parameters, or none.
template <class Layout>
struct SetParametersAtomically {
  static constexpr TypeName ros_type = "rcl_interfaces/srv/SetParametersAtomically";

  struct Request {
    Sequence<Layout, msg::Parameter<Layout>> parameters{};

    static constexpr TypeName ros_type = "rcl_interfaces/srv/SetParametersAtomically_Request";
    static constexpr FieldNames<1> ros_fields{"parameters"};
  };
  struct Response {
    msg::SetParametersResult<Layout> result{};

    static constexpr TypeName ros_type = "rcl_interfaces/srv/SetParametersAtomically_Response";
    static constexpr FieldNames<1> ros_fields{"result"};
  };
};

}  // namespace srv

}  // namespace articula::ros2::rcl_interfaces

// SPDX-License-Identifier: Apache-2.0
/// @file Descriptions of types at run time.
#pragma once

#include "articula/ros2/fields.hpp"

#include <cstdint>

namespace articula::ros2::type_description_interfaces {

namespace msg {

/// The type of a field.
struct FieldType {
  std::uint8_t type_id = 0;
  std::uint64_t capacity = 0;
  std::uint64_t string_capacity = 0;
  BoundedText<255> nested_type_name{};

  static constexpr TypeName ros_type = "type_description_interfaces/msg/FieldType";
  static constexpr FieldNames<4> ros_fields{"type_id", "capacity", "string_capacity",
                                            "nested_type_name"};
};

/// A field of a type.
template <class Layout>
struct Field {
  Text<Layout> name{};
  msg::FieldType type{};
  Text<Layout> default_value{};

  static constexpr TypeName ros_type = "type_description_interfaces/msg/Field";
  static constexpr FieldNames<3> ros_fields{"name", "type", "default_value"};
};

/// A type without those that it refers to.
template <class Layout>
struct IndividualTypeDescription {
  BoundedText<255> type_name{};
  Sequence<Layout, msg::Field<Layout>> fields{};

  static constexpr TypeName ros_type = "type_description_interfaces/msg/IndividualTypeDescription";
  static constexpr FieldNames<2> ros_fields{"type_name", "fields"};
};

/// A type with all those that it refers to.
template <class Layout>
struct TypeDescription {
  msg::IndividualTypeDescription<Layout> type_description{};
  Sequence<Layout, msg::IndividualTypeDescription<Layout>> referenced_type_descriptions{};

  static constexpr TypeName ros_type = "type_description_interfaces/msg/TypeDescription";
  static constexpr FieldNames<2> ros_fields{"type_description", "referenced_type_descriptions"};
};

/// The text from which a type was made.
template <class Layout>
struct TypeSource {
  Text<Layout> type_name{};
  Text<Layout> encoding{};
  Text<Layout> raw_file_contents{};

  static constexpr TypeName ros_type = "type_description_interfaces/msg/TypeSource";
  static constexpr FieldNames<3> ros_fields{"type_name", "encoding", "raw_file_contents"};
};

/// Further information.
template <class Layout>
struct KeyValue {
  Text<Layout> key{};
  Text<Layout> value{};

  static constexpr TypeName ros_type = "type_description_interfaces/msg/KeyValue";
  static constexpr FieldNames<2> ros_fields{"key", "value"};
};
}  // namespace msg

namespace srv {

/// Asks for the description of a type.
template <class Layout>
struct GetTypeDescription {
  static constexpr TypeName ros_type = "type_description_interfaces/srv/GetTypeDescription";

  struct Request {
    Text<Layout> type_name{};
    Text<Layout> type_hash{};
    bool include_type_sources = false;

    static constexpr TypeName ros_type =
        "type_description_interfaces/srv/GetTypeDescription_Request";
    static constexpr FieldNames<3> ros_fields{"type_name", "type_hash", "include_type_sources"};
  };
  struct Response {
    bool successful = false;
    Text<Layout> failure_reason{};
    msg::TypeDescription<Layout> type_description{};
    Sequence<Layout, msg::TypeSource<Layout>> type_sources{};
    Sequence<Layout, msg::KeyValue<Layout>> extra_information{};

    static constexpr TypeName ros_type =
        "type_description_interfaces/srv/GetTypeDescription_Response";
    static constexpr FieldNames<5> ros_fields{"successful", "failure_reason", "type_description",
                                              "type_sources", "extra_information"};
  };
};

}  // namespace srv

}  // namespace articula::ros2::type_description_interfaces

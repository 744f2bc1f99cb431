// SPDX-License-Identifier: Apache-2.0
/// @file The definition of a message type as ROS writes it in .msg files.
#pragma once

#include "articula/ros2/type_description.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>

namespace articula::ros2 {

namespace detail {

/// A text that grows.
struct TextSink {
  std::string text{};

  void add(std::string_view part) { text += part; }
};

/// The type's name without its kind, as "std_msgs/Header".
inline std::string short_name(std::string_view type) {
  return std::string(type.substr(0, type.find('/'))) + std::string(type.substr(type.rfind('/')));
}

template <class T>
std::string field_type_text() {
  using Shape = FieldShape<T>;
  using Element = typename Shape::Element;
  std::string text;
  if constexpr (Message<Element>) {
    text = short_name(Element::ros_type);
  } else {
    text = element_name<Element>().text;
    if constexpr (text_bound<Element> > 0) text += "<=" + std::to_string(text_bound<Element>);
  }
  switch (Shape::multiplicity) {
    case Multiplicity::one:
      return text;
    case Multiplicity::array:
      return text + "[" + std::to_string(Shape::capacity) + "]";
    case Multiplicity::bounded_sequence:
      return text + "[<=" + std::to_string(Shape::capacity) + "]";
    case Multiplicity::sequence:
      break;
  }
  return text + "[]";
}

template <class M>
void add_lines(TextSink& sink) {
  for_each_field_type<M>([&]<class T>(std::string_view name, TypeOf<T>) {
    sink.add(field_type_text<T>() + " " + std::string(name) + "\n");
  });
}

template <class M>
void add_section(TextSink& sink) {
  sink.add(std::string(80, '=') + "\nMSG: " + short_name(M::ros_type) + "\n");
  add_lines<M>(sink);
}

template <class M>
void collect_sections(ReferencedTypes<TextSink>& types) {
  for_each_field_type<M>([&]<class T>(std::string_view, TypeOf<T>) {
    using Element = typename FieldShape<T>::Element;
    if constexpr (Message<Element>) {
      if (types.add({Element::ros_type, &add_section<Element>})) collect_sections<Element>(types);
    }
  });
}

}  // namespace detail

/// The definition of a message type with all types that it refers to, in the form that MCAP files
/// name "ros2msg". It holds the fields, and a section for each other type. It has no constants or
/// defaults.
/// @tparam M  a message struct
/// Real-time: no (allocates).
template <Message M>
std::string message_text() {
  detail::ReferencedTypes<detail::TextSink> types;
  detail::collect_sections<M>(types);
  detail::TextSink sink;
  detail::add_lines<M>(sink);
  for (std::size_t i = 0; i < types.size; ++i) types.entries[i].describe(sink);
  return sink.text;
}

}  // namespace articula::ros2

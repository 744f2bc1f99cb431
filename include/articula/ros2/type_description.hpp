// SPDX-License-Identifier: Apache-2.0
/// @file The description of a message type from which ROS computes its hash.
#pragma once

#include "articula/ros2/field_type.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string_view>

namespace articula::ros2 {

namespace detail {

/// The types that a message refers to, sorted by name, each once.
/// @tparam Sink  takes the text of their descriptions by add(std::string_view)
template <class Sink>
struct ReferencedTypes {
  struct Entry {
    TypeName name{};
    void (*describe)(Sink&) = nullptr;
  };

  /// @return whether the type is new
  constexpr bool add(const Entry& entry) {
    std::size_t place = 0;
    while (place < size && entries[place].name.view() < entry.name.view()) ++place;
    if (place < size && entries[place].name.view() == entry.name.view()) return false;
    if (size == entries.size()) throw std::length_error("a message refers to more than 63 types");
    for (std::size_t i = size++; i > place; --i) entries[i] = entries[i - 1];
    entries[place] = entry;
    return true;
  }

  std::array<Entry, 63> entries{};
  std::size_t size = 0;
};

/// Adds a number in decimal digits.
template <class Sink>
constexpr void add_number(Sink& sink, std::size_t number) {
  std::array<char, 20> digits{};
  std::size_t first = digits.size();
  do {
    digits[--first] = static_cast<char>('0' + number % 10);
    number /= 10;
  } while (number != 0);
  sink.add(std::string_view(digits.data() + first, digits.size() - first));
}

template <class Sink, class T>
constexpr void describe_field(Sink& sink, std::string_view name) {
  using Shape = FieldShape<T>;
  using Element = typename Shape::Element;
  constexpr std::size_t step = 48;  // between the identifiers of one value, an array, and so on
  std::size_t identifier = step * static_cast<std::size_t>(Shape::multiplicity);
  TypeName nested;
  if constexpr (Message<Element>) {
    identifier += 1;
    nested = Element::ros_type;
  } else {
    identifier += element_name<Element>().identifier;
  }
  sink.add(R"({"name": ")");
  sink.add(name);
  sink.add(R"(", "type": {"type_id": )");
  add_number(sink, identifier);
  sink.add(R"(, "capacity": )");
  add_number(sink, Shape::capacity);
  sink.add(R"(, "string_capacity": )");
  add_number(sink, text_bound<Element>);
  sink.add(R"(, "nested_type_name": ")");
  sink.add(nested.view());
  sink.add(R"("}})");
}

/// Adds the description of one type, without those that it refers to.
template <class Sink, class M>
constexpr void describe_type(Sink& sink) {
  sink.add(R"({"type_name": ")");
  sink.add(M::ros_type.view());
  sink.add(R"(", "fields": [)");
  if constexpr (field_count<M>() == 0) {
    describe_field<Sink, std::uint8_t>(sink, "structure_needs_at_least_one_member");
  }
  bool first = true;
  for_each_field_type<M>([&]<class T>(std::string_view name, TypeOf<T>) {
    if (!first) sink.add(", ");
    first = false;
    describe_field<Sink, T>(sink, name);
  });
  sink.add("]}");
}

/// Adds the types that a message refers to, directly or not.
template <class Sink, class M>
constexpr void collect_types(ReferencedTypes<Sink>& types) {
  for_each_field_type<M>([&]<class T>(std::string_view, TypeOf<T>) {
    using Element = typename FieldShape<T>::Element;
    if constexpr (Message<Element>) {
      if (types.add({Element::ros_type, &describe_type<Sink, Element>})) {
        collect_types<Sink, Element>(types);
      }
    }
  });
}

}  // namespace detail

/// Writes the description of a message type, with all types that it refers to, as the JSON text
/// from which ROS computes type hashes. Source: [REP 2011].
/// @tparam M   a message struct
/// @param sink  takes the text in parts by add(std::string_view)
/// @throws std::length_error if the type refers to more than 63 others (in a constant: does not
///         compile)
/// Real-time: yes, if the sink is.
template <Message M, class Sink>
constexpr void describe(Sink& sink) {
  detail::ReferencedTypes<Sink> types;
  detail::collect_types<Sink, M>(types);
  sink.add(R"({"type_description": )");
  detail::describe_type<Sink, M>(sink);
  sink.add(R"(, "referenced_type_descriptions": [)");
  for (std::size_t i = 0; i < types.size; ++i) {
    if (i > 0) sink.add(", ");
    types.entries[i].describe(sink);
  }
  sink.add("]}");
}

}  // namespace articula::ros2

// SPDX-License-Identifier: Apache-2.0
/// @file The layout of a message: the distribution of ROS, and its memory.
#pragma once

#include "articula/ros2/inline_sequence.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace articula::ros2 {

/// A distribution of ROS 2, in the order of their releases.
enum class Distribution : std::uint8_t { humble, jazzy, rolling };

/// Messages of a distribution, with sequences and texts on the heap.
template <Distribution chosen>
struct HeapLayout {
  static constexpr Distribution distribution = chosen;
  using Text = std::string;
  template <class T>
  using Sequence = std::vector<T>;
};

using Humble = HeapLayout<Distribution::humble>;
using Jazzy = HeapLayout<Distribution::jazzy>;
using Rolling = HeapLayout<Distribution::rolling>;

/// The same messages without heap memory, for threads that must not allocate.
/// @tparam Layout      Humble, Jazzy or Rolling
/// @tparam items       of a sequence, at most
/// @tparam characters  of a text, at most
template <class Layout, std::size_t items, std::size_t characters = 63>
struct InlineLayout {
  static constexpr Distribution distribution = Layout::distribution;
  using Text = InlineText<characters>;
  template <class T>
  using Sequence = InlineSequence<T, items>;
};

/// A string of a message.
template <class Layout>
using Text = typename Layout::Text;

/// An unbounded sequence of a message.
template <class Layout, class T>
using Sequence = typename Layout::template Sequence<T>;

/// The type of a field that the distribution does not have. It has no bytes and no name in the
/// message.
struct Absent {};

/// A field of the distributions from `first` on.
template <class Layout, Distribution first, class T>
using Since = std::conditional_t<(Layout::distribution >= first), T, Absent>;

/// A field of the distributions up to `last`.
template <class Layout, Distribution last, class T>
using Until = std::conditional_t<(Layout::distribution <= last), T, Absent>;

}  // namespace articula::ros2

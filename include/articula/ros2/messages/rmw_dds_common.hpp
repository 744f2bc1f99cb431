// SPDX-License-Identifier: Apache-2.0
/// @file The readers and writers of each node, as a message.
#pragma once

#include "articula/ros2/fields.hpp"

#include <array>
#include <cstdint>

namespace articula::ros2::rmw_dds_common {

namespace msg {

/// The identifier of a participant, reader or writer.
template <class Layout>
struct Gid {
  std::array<std::uint8_t, Layout::distribution == Distribution::humble ? 24 : 16> data{};

  static constexpr TypeName ros_type = "rmw_dds_common/msg/Gid";
  static constexpr FieldNames<1> ros_fields{"data"};
};

/// The readers and writers of a node.
template <class Layout>
struct NodeEntitiesInfo {
  BoundedText<256> node_namespace{};
  BoundedText<256> node_name{};
  Sequence<Layout, msg::Gid<Layout>> reader_gid_seq{};
  Sequence<Layout, msg::Gid<Layout>> writer_gid_seq{};

  static constexpr TypeName ros_type = "rmw_dds_common/msg/NodeEntitiesInfo";
  static constexpr FieldNames<4> ros_fields{"node_namespace", "node_name", "reader_gid_seq",
                                            "writer_gid_seq"};
};

/// The nodes of a participant.
template <class Layout>
struct ParticipantEntitiesInfo {
  msg::Gid<Layout> gid{};
  Sequence<Layout, msg::NodeEntitiesInfo<Layout>> node_entities_info_seq{};

  static constexpr TypeName ros_type = "rmw_dds_common/msg/ParticipantEntitiesInfo";
  static constexpr FieldNames<2> ros_fields{"gid", "node_entities_info_seq"};
};

}  // namespace msg

}  // namespace articula::ros2::rmw_dds_common

// SPDX-License-Identifier: Apache-2.0
#include "articula/ros2/dds/graph.hpp"

#include "articula/ros2/cdr_encoder.hpp"
#include "articula/ros2/dds/endpoints/endpoint.hpp"
#include "articula/ros2/messages/rmw_dds_common.hpp"
#include "articula/ros2/type_hash.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>

namespace articula::ros2::dds {

namespace {

namespace msg = rmw_dds_common::msg;
namespace rtps = eprosima::fastrtps::rtps;

template <class Layout>
msg::Gid<Layout> gid_of(const rtps::GUID_t& guid) {
  msg::Gid<Layout> gid;
  auto* const entity = std::copy(std::begin(guid.guidPrefix.value), std::end(guid.guidPrefix.value),
                                 gid.data.begin());
  std::copy(std::begin(guid.entityId.value), std::end(guid.entityId.value), entity);
  return gid;
}

}  // namespace

void Graph::add(const std::string& node, const Guid& endpoint) {
  Node& entry = nodes_[node];
  (is_reader(endpoint) ? entry.readers : entry.writers).push_back(endpoint);
}

void Graph::remove(const Guid& endpoint) {
  for (auto& [name, node] : nodes_) {
    std::erase(node.readers, endpoint);
    std::erase(node.writers, endpoint);
  }
}

namespace {

template <class Layout, class Nodes>
std::vector<std::byte> encoded_graph(const rtps::GUID_t& participant, const Nodes& nodes) {
  msg::ParticipantEntitiesInfo<Layout> info{.gid = gid_of<Layout>(participant)};
  std::size_t room = 64;
  for (const auto& [name, node] : nodes) {
    const std::size_t slash = name.rfind('/');
    msg::NodeEntitiesInfo<Layout> entry;
    entry.node_namespace = std::string_view(name).substr(0, slash == 0 ? 1 : slash);
    entry.node_name = std::string_view(name).substr(slash + 1);
    for (const rtps::GUID_t& guid : node.readers) {
      entry.reader_gid_seq.push_back(gid_of<Layout>(guid));
    }
    for (const rtps::GUID_t& guid : node.writers) {
      entry.writer_gid_seq.push_back(gid_of<Layout>(guid));
    }
    room += 64 + name.size() + 24 * (node.readers.size() + node.writers.size());
    info.node_entities_info_seq.push_back(std::move(entry));
  }
  std::vector<std::byte> bytes(room);
  bytes.resize(encode(info, bytes).size);
  return bytes;
}

}  // namespace

std::vector<std::byte> Graph::message(Distribution distribution, const Guid& participant) const {
  // The identifiers have 24 bytes in Humble, and 16 in all later distributions.
  return distribution == Distribution::humble ? encoded_graph<Humble>(participant, nodes_)
                                              : encoded_graph<Jazzy>(participant, nodes_);
}

std::string discovery_info_hash(Distribution distribution) {
  if (distribution == Distribution::humble) return {};
  return std::string(type_hash<msg::ParticipantEntitiesInfo<Jazzy>>.view());
}

}  // namespace articula::ros2::dds

// SPDX-License-Identifier: Apache-2.0
/// @file Check that the links of a URDF form a tree that urdfdom can read.
#pragma once

#include "articula/text/similar_word.hpp"
#include "articula/urdf/xml/xml.hpp"

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace articula::detail {

inline constexpr std::size_t max_links = 4096;
inline constexpr std::size_t max_chain = 512;  ///< links from the root to a leaf: urdfdom recurses

/// The name of a joint's parent or child link; empty if it has none.
[[nodiscard]] inline std::string link_name(const XmlElement& joint, const char* which) {
  const XmlElement* element = joint.FirstChildElement(which);
  return element ? attribute(*element, "link") : std::string();
}

/// Checks that there are not too many links and that joints name links of the file. Where links
/// have no name or a common one, urdfdom reports that.
inline void check_links(const std::string& file, const XmlElement& robot) {
  std::set<std::string> links;
  std::size_t count = 0;
  for_each_child(robot, "link", [&](const XmlElement& link) {
    links.insert(attribute(link, "name"));
    ++count;
  });
  if (count > max_links) {
    throw FileError(file, "the robot has " + std::to_string(count) + " links; at most " +
                              std::to_string(max_links) + " are supported");
  }
  if (links.size() < count || links.contains("")) return;
  for_each_child(robot, "joint", [&](const XmlElement& joint) {
    for (const char* which : {"parent", "child"}) {
      const std::string link = link_name(joint, which);
      if (link.empty() || links.contains(link)) continue;
      const std::vector<std::string_view> names(links.begin(), links.end());
      throw FileError(file, "joint '" + attribute(joint, "name") + "': its " + which + " link '" +
                                link + "' is not a <link> of the file" +
                                choice_of(link, "links", names));
    }
  });
}

/// Checks that no link has two parents or is its own ancestor, and that no chain is too long.
inline void check_tree(const std::string& file, const XmlElement& robot) {
  std::map<std::string, std::string> parents, carriers;
  for_each_child(robot, "joint", [&](const XmlElement& joint) {
    const std::string child = link_name(joint, "child"), name = attribute(joint, "name");
    if (child.empty()) throw FileError(file, "joint '" + name + "': it has no child link");
    const auto [carrier, is_new] = carriers.try_emplace(child, name);
    if (!is_new) {
      throw FileError(file, "link '" + child + "': it is the child of two joints, '" +
                                carrier->second + "' and '" + name + "'");
    }
    parents[child] = link_name(joint, "parent");
  });
  std::map<std::string, std::size_t> lengths;  // of the chain from the root, in links
  for (const auto& [start, parent] : parents) {
    std::vector<std::string> way;  // from `start` to a link whose length is known, or to a root
    std::set<std::string> seen;
    std::string link = start;
    for (; parents.contains(link) && !lengths.contains(link); link = parents.at(link)) {
      if (!seen.insert(link).second) {
        throw FileError(file, "link '" + link + "': it is part of a loop");
      }
      way.push_back(link);
    }
    std::size_t length = lengths.contains(link) ? lengths.at(link) : 1;
    for (; !way.empty(); way.pop_back()) lengths[way.back()] = ++length;
    if (length > max_chain) {
      throw FileError(file, "link '" + start + "': at most " + std::to_string(max_chain) +
                                " links in one chain are supported");
    }
  }
}

}  // namespace articula::detail

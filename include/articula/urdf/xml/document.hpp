// SPDX-License-Identifier: Apache-2.0
/// @file A URDF as it is written: all of its links and joints, not yet a robot.
#pragma once

#include "articula/text/meant_word.hpp"
#include "articula/urdf/xml/control.hpp"
#include "articula/urdf/xml/control_check.hpp"
#include "articula/urdf/xml/messages.hpp"
#include "articula/urdf/xml/number_check.hpp"
#include "articula/urdf/xml/repeated_elements.hpp"
#include "articula/urdf/xml/safety.hpp"
#include "articula/urdf/xml/source.hpp"
#include "articula/urdf/xml/transmission.hpp"
#include "articula/urdf/xml/unknown_words.hpp"
#include "articula/urdf/xml/xml.hpp"

#include <urdf_parser/urdf_parser.h>

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace articula {

/// A URDF as it is written. The links form a tree; whether they can exist is not checked yet.
struct UrdfDocument {
  static constexpr std::size_t most_links = 4096;
  static constexpr std::size_t most_in_chain = 512;  ///< links from the root to a leaf

  std::string file{};                     ///< where it comes from, for messages
  urdf::ModelInterfaceSharedPtr robot{};  ///< links and joints, from urdfdom
  std::map<std::string, Vector3<double>>
      joint_orientations{};  ///< roll, pitch, yaw [rad] by joint; urdfdom keeps quaternions only
  std::map<std::string, Vector3<double>> inertia_orientations{};  ///< likewise by link
  std::map<std::string, JointLimits> command_limits{};            ///< from <ros2_control>, by joint
  std::multimap<std::string, LimitContradiction> contradictions{};  ///< between them, by joint
  std::map<std::string, UrdfSoftLimits> soft_limits{};        ///< of <safety_controller>, by joint
  std::map<std::string, UrdfInitialValues> initial_values{};  ///< likewise, by joint
  std::map<std::string, std::string>
      command_mimics{};  ///< likewise, whom a joint is to mimic; empty: nobody
  std::vector<UrdfTransmission> transmissions{};
  std::vector<std::string> unknown_words{};      ///< of links and joints, a line each, see notices
  std::vector<std::string> repeated_elements{};  ///< likewise
  std::vector<std::string> drive_notices{};      ///< what is odd in <ros2_control> and
                                                 ///< <safety_controller>, likewise
};

namespace detail {

/// The name of a joint's parent or child link, empty if it has none.
[[nodiscard]] inline std::string link_name(const XmlElement& joint, const char* which) {
  const XmlElement* element = joint.FirstChildElement(which);
  return element ? attribute(*element, "link") : std::string();
}

/// Makes sure that joints are between links that exist. Where links have no name, or one together,
/// that comes first, and urdfdom tells it.
inline void check_links(const std::string& file, const XmlElement& robot) {
  std::set<std::string> links;
  bool all_have_names = true;
  for_each_child(robot, "link", [&](const XmlElement& link) {
    const std::string name = attribute(link, "name");
    all_have_names = !name.empty() && links.insert(name).second && all_have_names;
  });
  if (!all_have_names) return;
  for_each_child(robot, "joint", [&](const XmlElement& joint) {
    for (const char* which : {"parent", "child"}) {
      const std::string link = link_name(joint, which);
      if (link.empty() || links.contains(link)) continue;
      const std::vector<std::string_view> names(links.begin(), links.end());
      throw UrdfError(file, "joint '" + attribute(joint, "name") + "': its " + which + " link '" +
                                link + "' is no <link> of the file" +
                                choice_of(link, "links", names));
    }
  });
}

/// Makes sure that no link has two parents or is its own ancestor.
inline void check_tree(const std::string& file, const XmlElement& robot) {
  std::map<std::string, std::string> parents, carriers;
  for_each_child(robot, "joint", [&](const XmlElement& joint) {
    const std::string child = link_name(joint, "child"), name = attribute(joint, "name");
    if (child.empty()) throw UrdfError(file, "joint '" + name + "': it has no child link");
    const auto [carrier, first] = carriers.try_emplace(child, name);
    if (!first) {
      throw UrdfError(file, "link '" + child + "': it is the child of two joints, '" +
                                carrier->second + "' and '" + name + "'");
    }
    parents[child] = link_name(joint, "parent");
  });
  std::set<std::string> safe;  // known to lead to a root
  for (const auto& [start, parent] : parents) {
    std::set<std::string> way;
    for (auto at = parents.find(start); at != parents.end() && !safe.contains(at->first);
         at = parents.find(at->second)) {
      if (!way.insert(at->first).second) {
        throw UrdfError(file, "link '" + at->first + "': it is part of a loop");
      }
    }
    safe.merge(way);
  }
  for (const auto& [start, parent] : parents) {
    std::size_t length = 1;
    for (auto at = parents.find(start); at != parents.end(); at = parents.find(at->second)) {
      if (++length <= UrdfDocument::most_in_chain) continue;
      throw UrdfError(file, "link '" + start + "': more than " +
                                std::to_string(UrdfDocument::most_in_chain) +
                                " links lie in one chain");
    }
  }
}

/// XML takes any white space in an attribute for blanks, urdfdom only blanks. TinyXML may have
/// written it as a character's number.
inline void blank_white_space(std::string& text) {
  for (const std::string_view space : {"\t", "\r", "\n", "&#x09;", "&#x0D;", "&#x0A;"}) {
    for (std::size_t at = text.find(space); at != std::string::npos; at = text.find(space, at)) {
      text.replace(at, space.size(), space.size(), ' ');
    }
  }
}

/// Roll, pitch, yaw of an element's <origin>; urdfdom has accepted it.
[[nodiscard]] inline Vector3<double> orientation_of(const XmlElement* element) {
  const XmlElement* origin = element ? element->FirstChildElement("origin") : nullptr;
  if (!origin || !origin->Attribute("rpy")) return {};
  urdf::Vector3 rpy;
  rpy.init(origin->Attribute("rpy"));
  return {rpy.x, rpy.y, rpy.z};
}

/// Has urdfdom parse the mechanics of a robot.
[[nodiscard]] inline urdf::ModelInterfaceSharedPtr parse_mechanics(const std::string& file,
                                                                   const std::string& text) {
  const MessageCatcher catcher;
  try {
    const urdf::ModelInterfaceSharedPtr robot = urdf::parseURDF(text);
    // urdfdom goes on after some errors, with a link's inertia left out for instance.
    if (robot && catcher.errors().empty()) return robot;
  } catch (const std::exception& error) {
    throw UrdfError(file, error.what());
  }
  throw UrdfError(file, catcher.errors().empty() ? "urdfdom refuses it" : catcher.errors());
}

}  // namespace detail

/// Reads a URDF as it is written.
/// @param source          a file or XML
/// @param without_masses  passes over all <inertial>, whatever they say
/// @throws UrdfError if it cannot be read, is not URDF, or its links form no tree
/// Real-time: no (reads a file, allocates, throws).
[[nodiscard]] inline UrdfDocument parse_urdf(const UrdfSource& source,
                                             bool without_masses = false) {
  UrdfDocument result{.file = source.name()};
  detail::XmlDocument document;
  detail::XmlElement& robot = detail::parse_xml(result.file, source.text(), document);
  detail::refuse_xacro(result.file, robot);
  if (without_masses) detail::remove_inertials(robot);

  detail::ControlReader control(result.file);
  control.read(robot);
  result.command_limits = std::move(control.limits);
  result.contradictions = std::move(control.contradictions);
  result.initial_values = std::move(control.initial_values);
  result.command_mimics = std::move(control.mimics);
  detail::TransmissionReader transmissions(result.file);
  transmissions.read(robot);
  result.transmissions = std::move(transmissions.transmissions);
  detail::SafetyReader safety(robot);
  result.soft_limits = safety.limits();
  const auto add_notices = [&result](const std::vector<std::string>& notices) {
    result.drive_notices.insert(result.drive_notices.end(), notices.begin(), notices.end());
  };
  add_notices(detail::ControlCheck(robot).take());
  add_notices(control.notices);
  add_notices(safety.notices());

  result.unknown_words = detail::UnknownWords(robot).take();  // some are removed next
  result.repeated_elements = detail::RepeatedElements(result.file, robot).take();

  // TinyXML may read odd characters otherwise than it has written them, so from here on everybody
  // reads what it writes.
  detail::keep_mechanics(result.file, robot);
  detail::for_each_child(robot, nullptr, [&](const detail::XmlElement& element) {
    const std::string where =
        std::string(element.Value()) + " '" + detail::attribute(element, "name") + "'";
    detail::refuse_placeholders(result.file, where, element);
    detail::check_numbers(result.file, where, element);
  });
  detail::XmlPrinter printer;
  document.Accept(&printer);
  std::string text = printer.CStr();
  detail::blank_white_space(text);
  detail::XmlDocument mechanics;
  const detail::XmlElement& bare = detail::parse_xml(result.file, text, mechanics);
  std::size_t links = 0;
  detail::for_each_child(bare, "link", [&](const detail::XmlElement&) { ++links; });
  if (links > UrdfDocument::most_links) {
    throw UrdfError(result.file, "it has " + std::to_string(links) + " links; 4096 are accepted");
  }
  detail::check_links(result.file, bare);
  try {
    detail::check_tree(result.file, bare);
    result.robot = detail::parse_mechanics(result.file, text);
  } catch (const UrdfError& error) {
    throw UrdfError(error, detail::perhaps_because_of(result.unknown_words, error.what()));
  }
  detail::for_each_child(bare, "joint", [&](const detail::XmlElement& joint) {
    result.joint_orientations[detail::attribute(joint, "name")] = detail::orientation_of(&joint);
  });
  detail::for_each_child(bare, "link", [&](const detail::XmlElement& link) {
    result.inertia_orientations[detail::attribute(link, "name")] =
        detail::orientation_of(link.FirstChildElement("inertial"));
  });
  return result;
}

}  // namespace articula

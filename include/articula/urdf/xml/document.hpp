// SPDX-License-Identifier: Apache-2.0
/// @file The contents of a URDF file: all links and joints, before a robot is selected.
#pragma once

#include "articula/urdf/xml/control.hpp"
#include "articula/urdf/xml/control_check.hpp"
#include "articula/urdf/xml/known_words.hpp"
#include "articula/urdf/xml/mechanics_check.hpp"
#include "articula/urdf/xml/source.hpp"
#include "articula/urdf/xml/transmission.hpp"

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace articula {

/// The contents of a URDF file. Its links form a tree; read_urdf checks whether a robot with them
/// can exist. Use it to list a file; to load a robot, use load_urdf.
struct UrdfDocument {
  std::string file{};                     ///< its name, for messages
  urdf::ModelInterfaceSharedPtr robot{};  ///< links and joints, from urdfdom
  std::map<std::string, Vector3<double>>
      joint_orientations{};  ///< roll, pitch, yaw [rad] by joint; urdfdom keeps quaternions only
  std::map<std::string, Vector3<double>> inertia_orientations{};  ///< the same by link
  UrdfControl control{};
  std::vector<UrdfTransmission> transmissions{};
  std::vector<std::string> unknown_words{};  ///< notices about words in links and joints
  std::vector<std::string> notices{};        ///< all other notices about the file
};

namespace detail {

/// Replaces white space by blanks, as XML demands in attributes. TinyXML may have written it as a
/// character's number.
inline void blank_white_space(std::string& text) {
  for (const std::string_view space : {"\t", "\r", "\n", "&#x09;", "&#x0D;", "&#x0A;"}) {
    for (std::size_t at = text.find(space); at != std::string::npos; at = text.find(space, at)) {
      text.replace(at, space.size(), space.size(), ' ');
    }
  }
}

/// Roll, pitch, yaw of an element's <origin>.
/// @pre urdfdom has accepted the element
[[nodiscard]] inline Vector3<double> orientation_of(const XmlElement* element) {
  const XmlElement* origin = element ? element->FirstChildElement("origin") : nullptr;
  if (!origin || !origin->Attribute("rpy")) return {};
  urdf::Vector3 rpy;
  rpy.init(origin->Attribute("rpy"));
  return {rpy.x, rpy.y, rpy.z};
}

/// While it lives, errors that urdfdom logs (through console_bridge, whose receiver is global) come
/// here. One at a time: another thread's waits.
class MessageCatcher {
 public:
  MessageCatcher()
      : lock_(receiver().mutex),
        previous_(console_bridge::getOutputHandler()),
        level_(console_bridge::getLogLevel()) {
    receiver().errors.clear();
    console_bridge::setLogLevel(console_bridge::CONSOLE_BRIDGE_LOG_ERROR);
    console_bridge::useOutputHandler(&receiver());
  }
  ~MessageCatcher() {
    console_bridge::useOutputHandler(previous_);
    console_bridge::setLogLevel(level_);
  }
  MessageCatcher(const MessageCatcher&) = delete;
  MessageCatcher& operator=(const MessageCatcher&) = delete;

  /// The errors so far, separated by semicolons.
  [[nodiscard]] const std::string& errors() const noexcept { return receiver().errors; }

 private:
  struct Receiver final : console_bridge::OutputHandler {
    void log(const std::string& text, console_bridge::LogLevel, const char*, int) override {
      if (!errors.empty()) errors += "; ";
      for (char c : text) errors += c == '\n' ? ' ' : c;
    }
    std::string errors{};
    std::mutex mutex{};
  };
  /// Lives to the end of the program, as console_bridge remembers the previous receiver.
  [[nodiscard]] static Receiver& receiver() {
    static Receiver& receiver = *new Receiver;
    return receiver;
  }

  std::lock_guard<std::mutex> lock_;
  console_bridge::OutputHandler* previous_;
  console_bridge::LogLevel level_;
};

/// Parses the mechanics of a robot by urdfdom.
[[nodiscard]] inline urdf::ModelInterfaceSharedPtr parse_mechanics(const std::string& file,
                                                                   const std::string& text) {
  const MessageCatcher catcher;
  try {
    const urdf::ModelInterfaceSharedPtr robot = urdf::parseURDF(text);
    // urdfdom continues after some errors, and drops a link's inertia for instance.
    if (robot && catcher.errors().empty()) return robot;
  } catch (const std::exception& error) {
    throw FileError(file, error.what());
  }
  throw FileError(file, catcher.errors().empty() ? "urdfdom refuses it" : catcher.errors());
}

}  // namespace detail

/// Parses a URDF and checks its syntax.
/// @param source          a file or XML
/// @param without_masses  skip all <inertial>, also invalid ones
/// @throws FileError if the file cannot be read or is not URDF, or its links do not form a tree
/// Real-time: no (reads a file, allocates, throws).
[[nodiscard]] inline UrdfDocument parse_urdf(const UrdfSource& source,
                                             bool without_masses = false) {
  UrdfDocument result{.file = source.name()};
  const std::string& file = result.file;
  detail::XmlDocument document;
  detail::XmlElement& robot = detail::parse_xml(file, source.text(), document);
  detail::refuse_xacro(file, robot);
  if (without_masses) detail::remove_inertials(robot);

  detail::NoticeList unknown_words, notices;
  detail::for_each_link_and_joint(robot, [&](const detail::XmlElement& part,
                                             const std::string& owner) {
    detail::report_unknown_words(part, detail::mechanics_words(), true,
                                 [&](const std::string& text) { unknown_words.add(owner, text); });
    detail::check_duplicates(file, part, owner, notices);
  });
  detail::ControlCheck(notices).check(robot);
  result.control = detail::ControlReader(file, notices).read(robot);
  result.transmissions = detail::read_transmissions(file, robot, notices);
  result.unknown_words = unknown_words.lines();
  result.notices = notices.lines();

  detail::keep_mechanics(file, robot);
  detail::for_each_link_and_joint(robot,
                                  [&](const detail::XmlElement& part, const std::string& owner) {
                                    detail::check_attributes(file, owner, part);
                                  });
  // TinyXML may read odd characters differently from how it writes them. So the checks of the tree,
  // urdfdom and the reader of angles all parse what TinyXML writes.
  detail::XmlPrinter printer;
  document.Accept(&printer);
  std::string text = printer.CStr();
  detail::blank_white_space(text);
  detail::XmlDocument mechanics;
  const detail::XmlElement& bare = detail::parse_xml(file, text, mechanics);
  detail::check_links(file, bare);
  try {
    detail::check_tree(file, bare);
    result.robot = detail::parse_mechanics(file, text);
  } catch (const FileError& error) {
    throw FileError(error, detail::possible_cause(result.unknown_words, error.what()));
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

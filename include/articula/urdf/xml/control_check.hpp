// SPDX-License-Identifier: Apache-2.0
/// @file What is odd in <ros2_control>.
#pragma once

#include "articula/text/meant_word.hpp"
#include "articula/text/numbers.hpp"
#include "articula/urdf/xml/control_words.hpp"
#include "articula/urdf/xml/grouped_lines.hpp"
#include "articula/urdf/xml/xml.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace articula::detail {

/// Looks for what is odd in the <ros2_control>s of a robot: words that are not known there, which
/// may be limits under another name; what ros2_control itself refuses; and joints that cannot take
/// commands. A line each.
class ControlCheck {
 public:
  explicit ControlCheck(const XmlElement& robot) {
    for_each_child(robot, "joint", [this](const XmlElement& joint) {
      joints_.try_emplace(attribute(joint, "name"), &joint);
    });
    for_each_child(robot, "ros2_control", [this](const XmlElement& e) { look_at_component(e); });
  }

  [[nodiscard]] std::vector<std::string> take() const { return lines_.take(); }

 private:
  void add(const std::string& text) { lines_.add(owner_, text); }

  void look_at_component(const XmlElement& component) {
    const std::string name = one_line(attribute(component, "name"));
    const std::string here = "<ros2_control>" + (name.empty() ? "" : " '" + name + "'") + ": ";
    owner_ = here;
    check_words(component, "");
    check_attribute(component, "name", {});
    check_attribute(component, "type", {"system", "actuator", "sensor"});
    check_truth(component, "is_async");
    for (const char* count : {"rw_rate", "thread_priority"}) check_count(component, count);
    if (const XmlElement* hardware = component.FirstChildElement("hardware")) {
      const XmlElement* plugin = hardware->FirstChildElement("plugin");
      if (!plugin || text_of(*plugin).empty()) add("its <hardware> has no <plugin>");
      check_words(*hardware, "");
      check_params(*hardware, "<hardware>");
    }
    for (const char* kind : {"joint", "sensor", "gpio"}) {
      for_each_child(component, kind, [&](const XmlElement& part) {
        owner_ = here + kind + " '" + one_line(attribute(part, "name")) + "': ";
        if (std::string_view(kind) == "joint") {
          owner_ = "<ros2_control>: joint '" + one_line(attribute(part, "name")) + "': ";
          look_at_joint(component, part);
        }
        look_at_part(part);
      });
    }
    for_each_child(component, "transmission", [&](const XmlElement& transmission) {
      owner_ = "transmission '" + one_line(attribute(transmission, "name")) + "': ";
      look_at_transmission(component, transmission);
    });
  }

  /// A joint, a sensor or a <gpio>.
  void look_at_part(const XmlElement& part) {
    const std::string kind = part.Value();
    check_words(part, "");
    check_attribute(part, "name", {});
    check_params(part, "<" + kind + ">");
    check_enable(part, "");
    for (const char* interface : {"command_interface", "state_interface"}) {
      for_each_child(part, interface, [&](const XmlElement& element) {
        const std::string name = one_line(attribute(element, "name"));
        const std::string where = "<" + std::string(interface) + " name=\"" + name + "\">";
        if (name.empty()) add("a <" + std::string(interface) + "> has no name");
        check_words(element, where + ": ");
        check_params(element, where);
        check_enable(element, where + ": ");
        if (kind == "joint") check_limits(element, where);
      });
    }
  }

  /// Limits that nobody reads.
  void check_limits(const XmlElement& interface, const std::string& where) {
    static constexpr std::array<std::string_view, 7> limited = {
        "position", "velocity", "effort", "torque", "force", "acceleration", "jerk"};
    const std::string name = attribute(interface, "name");
    const bool is_command = interface.Value() == std::string_view("command_interface");
    const bool has_limits = std::find(limited.begin(), limited.end(), name) != limited.end();
    for_each_child(interface, "param", [&](const XmlElement& param) {
      const std::string word = attribute(param, "name");
      const bool is_bound = word == "min" || word == "max";
      if (is_bound && is_command && has_limits) return;
      if (is_bound && is_command) {
        add(where + ": its " + word +
            " does not count; limits are read for position, velocity, "
            "effort (or torque, force), acceleration and jerk" +
            did_you_mean(name, limited));
      } else if (is_bound) {
        add(where + ": its " + word + " does not count; limits are those of commands");
      } else {
        check_param(word, is_command && has_limits, where);
      }
    });
  }

  /// A <param> whose name is none of those that are read.
  /// @param any  whether any is odd there; else only those that seem to be limits
  void check_param(const std::string& word, bool any, const std::string& where) {
    static constexpr std::array<std::string_view, 4> known = {"min", "max", "initial_value",
                                                              "data_type"};
    if (word.empty() || std::find(known.begin() + 2, known.end(), word) != known.end()) return;
    const std::string small = lower_case(word);
    const auto has = [&small](std::string_view part) {
      return small.find(part) != std::string::npos;
    };
    const std::string_view bound = has("max") || has("upper")   ? "max"
                                   : has("min") || has("lower") ? "min"
                                                                : std::string_view();
    if (!any && bound.empty() && !has("limit")) return;
    const std::string_view meant = bound.empty() ? meant_word(word, known) : bound;
    add(where + ": the parameter '" + one_line(word) + "' is not known there and does not count" +
        (meant.empty() || !any ? "" : "; did you mean '" + std::string(meant) + "'?"));
  }

  void look_at_joint(const XmlElement& component, const XmlElement& joint) {
    const std::string name = attribute(joint, "name");
    check_truth(joint, "mimic");
    const auto [seen, first] = components_.try_emplace(name, &component);
    if (!first && joint.FirstChildElement("command_interface")) {
      add(seen->second == &component
              ? "it stands there twice"
              : "it stands in two <ros2_control>; the narrower limits count");
    }
    for_each_child(joint, "param", [&](const XmlElement& param) {
      check_param(attribute(param, "name"), false, "<joint>");
    });
    const auto found = joints_.find(name);
    if (found == joints_.end()) return;  // UrdfNotices says so
    const XmlElement& mechanics = *found->second;
    const bool takes_commands = joint.FirstChildElement("command_interface");
    if (attribute(mechanics, "type") == "fixed") {
      add(takes_commands ? "it is fixed, so its commands move nothing" : "it is fixed");
    }
    const std::string mimic = lower_case(attribute(joint, "mimic"));
    const XmlElement* follows = mechanics.FirstChildElement("mimic");
    if (!follows && mimic == "true") {
      add("mimic=\"true\", but it has no <mimic>, so it follows nobody");
    }
    if (!follows || mimic == "false") return;
    const std::string leader = attribute(*follows, "joint");
    if (takes_commands) add("it mimics '" + one_line(leader) + "', so its commands do not count");
    if (!names_joint(component, leader)) {
      add("it mimics '" + one_line(leader) + "', which does not stand there");
    }
  }

  void look_at_transmission(const XmlElement& component, const XmlElement& transmission) {
    check_attribute(transmission, "name", {});
    const XmlElement* plugin = transmission.FirstChildElement("plugin");
    if (!plugin || text_of(*plugin).empty()) add("it has no <plugin>");
    for (const char* kind : {"joint", "actuator"}) {
      for_each_child(transmission, kind, [&](const XmlElement& end) {
        for (const char* word : {"name", "role"}) {
          if (attribute(end, word).empty()) add("a <" + std::string(kind) + "> has no " + word);
        }
        const std::string name = attribute(end, "name");
        if (kind[0] == 'j' && joints_.contains(name) && !names_joint(component, name)) {
          add("joint '" + one_line(name) + "' is no joint of its <ros2_control>");
        }
      });
    }
  }

  [[nodiscard]] static bool names_joint(const XmlElement& component, const std::string& name) {
    bool found = false;
    for_each_child(component, "joint", [&](const XmlElement& joint) {
      found = found || attribute(joint, "name") == name;
    });
    return found;
  }

  void check_words(const XmlElement& element, const std::string& where) {
    for (const std::string& text : unknown_control_words(element)) add(where + text);
  }

  void check_params(const XmlElement& element, const std::string& where) {
    for_each_child(element, "param", [&](const XmlElement& param) {
      const std::string name = one_line(attribute(param, "name"));
      if (name.empty()) {
        add(where + ": a <param> has no name, so it does not count");
      } else if (text_of(param).empty()) {
        add(where + ": the parameter '" + name + "' says nothing");
      }
    });
  }

  /// @param choice  what the attribute may say; anything but nothing if that is empty
  void check_attribute(const XmlElement& element, const char* name,
                       std::initializer_list<std::string_view> choice) {
    const std::string text = attribute(element, name);
    if (text.empty()) return add("it has no " + std::string(name));
    if (choice.size() == 0) return;
    if (std::find(choice.begin(), choice.end(), text) != choice.end()) return;
    std::string list;
    for (const std::string_view each : choice) list.append(list.empty() ? "" : ", ").append(each);
    add(std::string(name) + " '" + one_line(text) + "' is none of " + list);
  }

  void check_truth(const XmlElement& element, const char* name, const std::string& where = "") {
    const char* text = element.Attribute(name);
    if (!text || lower_case(text) == "true" || lower_case(text) == "false") return;
    add(where + name + " '" + one_line(text) + "' is neither true nor false and does not count");
  }

  void check_count(const XmlElement& element, const char* name) {
    const char* text = element.Attribute(name);
    if (!text || std::string_view(text).find_first_not_of("0123456789 ") == std::string_view::npos)
      return;
    add(std::string(name) + " '" + one_line(text) + "' is no whole number >= 0");
  }

  void check_enable(const XmlElement& element, const std::string& where) {
    const XmlElement* limits = element.FirstChildElement("limits");
    if (!limits) return;
    if (!limits->Attribute("enable")) add(where + "<limits> has no enable, so the limits count");
    check_words(*limits, where);
    check_truth(*limits, "enable", where + "<limits>: ");
  }

  std::map<std::string, const XmlElement*> joints_{};      ///< of the robot, by name
  std::map<std::string, const XmlElement*> components_{};  ///< <ros2_control>, by joint
  GroupedLines lines_{};
  std::string owner_{};  ///< the element that is looked at, for the lines
};

}  // namespace articula::detail

// SPDX-License-Identifier: Apache-2.0
/// @file Notices about mistakes in <ros2_control>.
#pragma once

#include "articula/text/similar_word.hpp"
#include "articula/urdf/xml/known_words.hpp"
#include "articula/urdf/xml/xml.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace articula::detail {

/// Checks the <ros2_control>s of a robot for unknown words, which may be misspelt limits. It also
/// checks for what ros2_control itself refuses, and for joints that cannot take commands.
class ControlCheck {
 public:
  explicit ControlCheck(NoticeList& notices) : notices_(notices) {}

  void check(const XmlElement& robot) {
    for_each_child(robot, "joint", [this](const XmlElement& joint) {
      joints_.try_emplace(attribute(joint, "name"), &joint);
    });
    for_each_child(robot, nullptr, [this](const XmlElement& e) {
      if (e.Value() == std::string_view("ros2_control")) return check_component(e);
      check_part_name(e.Value());
    });
  }

 private:
  void add(const std::string& text) { notices_.add(owner_, text); }

  /// Reports a misspelt <ros2_control>. Other programs have other elements of their own.
  void check_part_name(std::string_view name) {
    if (!is_near(name, "ros2_control")) return;
    notices_.add("<robot>: the element <" + one_line(std::string(name)) +
                 "> is unknown and is ignored; did you mean 'ros2_control'?");
  }

  void check_component(const XmlElement& component) {
    const std::string name = one_line(attribute(component, "name"));
    const std::string here = "<ros2_control>" + (name.empty() ? "" : " '" + name + "'") + ": ";
    owner_ = here;
    check_words(component, "");
    for (const char* word : {"name", "type"}) require(component, word);
    const std::string type = attribute(component, "type");
    if (!type.empty() && type != "system" && type != "actuator" && type != "sensor") {
      add("type '" + one_line(type) + "' is none of system, actuator, sensor");
    }
    check_truth(component, "is_async");
    for (const char* count : {"rw_rate", "thread_priority"}) check_count(component, count);
    if (const XmlElement* hardware = component.FirstChildElement("hardware")) {
      check_plugin(*hardware, "its <hardware>");
      check_words(*hardware, "");
      check_params(*hardware, "<hardware>");
    }
    for (const std::string kind : {"joint", "sensor", "gpio"}) {
      for_each_child(component, kind.c_str(), [&](const XmlElement& part) {
        owner_ = (kind == "joint" ? "<ros2_control>: " : here) + owner_text(part);
        if (kind == "joint") check_joint(component, part);
        check_part(part);
      });
    }
    for_each_child(component, "transmission", [&](const XmlElement& transmission) {
      owner_ = owner_text(transmission);
      check_transmission(component, transmission);
    });
  }

  /// Checks a joint, a sensor or a <gpio>.
  void check_part(const XmlElement& part) {
    const std::string kind = part.Value();
    check_words(part, "");
    require(part, "name");
    check_params(part, "<" + kind + ">");
    check_enable(part, "");
    for (const std::string interface : {"command_interface", "state_interface"}) {
      std::set<std::string> names;
      for_each_child(part, interface.c_str(), [&](const XmlElement& element) {
        const std::string name = one_line(attribute(element, "name"));
        const std::string where = "<" + interface + " name=\"" + name + "\">";
        if (name.empty()) add("a <" + interface + "> has no name");
        if (!name.empty() && !names.insert(name).second) {
          add(where + ": it occurs twice" +
              (kind == "joint" && interface == "command_interface"
                   ? "; the narrower limits are used"
                   : ""));
        }
        check_words(element, where + ": ");
        check_params(element, where);
        check_enable(element, where + ": ");
        if (kind == "joint") check_limits(element, where);
      });
    }
  }

  /// Reports limits that are not read.
  void check_limits(const XmlElement& interface, const std::string& where) {
    static constexpr std::array<std::string_view, 7> limited = {
        "position", "velocity", "effort", "torque", "force", "acceleration", "jerk"};
    const std::string name = attribute(interface, "name");
    const bool is_command = interface.Value() == std::string_view("command_interface");
    const bool has_limits = std::ranges::find(limited, name) != limited.end();
    for_each_child(interface, "param", [&](const XmlElement& param) {
      const std::string word = attribute(param, "name");
      if (word != "min" && word != "max") return check_param(word, is_command && has_limits, where);
      if (!is_command) {
        add(where + ": its " + word + " is ignored; limits are read from commands");
      } else if (!has_limits) {
        add(where + ": its " + word +
            " is ignored; limits are read for position, velocity, effort (or torque, force), "
            "acceleration and jerk" +
            did_you_mean(name, limited));
      }
    });
  }

  /// Reports a <param> whose name is not read.
  /// @param any  whether any such name is reported there; else only those that seem to be limits
  void check_param(const std::string& word, bool any, const std::string& where) {
    static constexpr std::array<std::string_view, 4> known = {"min", "max", "initial_value",
                                                              "data_type"};
    if (word.empty() || word == "initial_value" || word == "data_type") return;
    const std::string small = lower_case(word);
    const auto has = [&small](std::string_view part) {
      return small.find(part) != std::string::npos;
    };
    const std::string_view bound = has("max") || has("upper")   ? "max"
                                   : has("min") || has("lower") ? "min"
                                                                : "";
    const bool is_initial = small.starts_with("initial") && where.starts_with("<state_interface");
    if (!any && bound.empty() && !has("limit") && !is_initial) return;
    add(where + ": the parameter '" + one_line(word) + "' is unknown and is ignored" +
        (is_initial      ? "; did you mean 'initial_value'?"
         : !any          ? ""
         : bound.empty() ? did_you_mean(word, known)
                         : "; did you mean '" + std::string(bound) + "'?"));
  }

  void check_joint(const XmlElement& component, const XmlElement& joint) {
    const std::string name = attribute(joint, "name");
    const bool takes_commands = joint.FirstChildElement("command_interface");
    check_truth(joint, "mimic");
    const auto [first, is_new] = components_.try_emplace(name, &component);
    if (!is_new && takes_commands) {
      add(first->second == &component
              ? "it occurs twice"
              : "it occurs in two <ros2_control>; the narrower limits are used");
    }
    const std::string mimic = lower_case(attribute(joint, "mimic"));
    std::optional<std::string> mimicked_there;  // of older versions; empty: none
    if (mimic == "false") mimicked_there = "";
    for_each_child(joint, "param", [&](const XmlElement& param) {
      check_param(attribute(param, "name"), false, "<joint>");
      if (attribute(param, "name") == "mimic") mimicked_there = text_of(param);
    });
    const auto found = joints_.find(name);
    if (found == joints_.end()) {
      if (is_new) notices_.add(owner_ + "there is no such joint");
      return;
    }
    const XmlElement& mechanics = *found->second;
    if (attribute(mechanics, "type") == "fixed") {
      add(takes_commands ? "it is fixed, so its commands move nothing" : "it is fixed");
    }
    const XmlElement* mimics = mechanics.FirstChildElement("mimic");
    const std::string mimicked = attribute(mimics, "joint");
    if (mimicked_there.value_or(mimicked) != mimicked) {
      notices_.add(owner_ + "mimic '" + (mimic == "false" ? mimic : *mimicked_there) +
                   "' is ignored: only <mimic> in the joint itself is read");
    }
    if (!mimics && mimic == "true") add("mimic=\"true\", but the joint has no <mimic>");
    if (!mimics || mimic == "false") return;
    const std::string text = "it mimics '" + one_line(mimicked) + "', ";
    if (takes_commands) add(text + "so its commands are ignored");
    if (!has_joint(component, mimicked)) add(text + "which is not in its <ros2_control>");
  }

  void check_transmission(const XmlElement& component, const XmlElement& transmission) {
    require(transmission, "name");
    check_plugin(transmission, "it");
    for (const std::string kind : {"joint", "actuator"}) {
      for_each_child(transmission, kind.c_str(), [&](const XmlElement& end) {
        for (const char* word : {"name", "role"}) {
          if (attribute(end, word).empty()) add("a <" + kind + "> has no " + word);
        }
        const std::string name = attribute(end, "name");
        if (kind == "joint" && joints_.contains(name) && !has_joint(component, name)) {
          add("joint '" + one_line(name) + "' is not in its <ros2_control>");
        }
      });
    }
  }

  [[nodiscard]] static bool has_joint(const XmlElement& component, const std::string& name) {
    bool found = false;
    for_each_child(component, "joint", [&](const XmlElement& joint) {
      found = found || attribute(joint, "name") == name;
    });
    return found;
  }

  void check_words(const XmlElement& element, const std::string& where) {
    report_unknown_words(element, control_words(), false,
                         [&](const std::string& text) { add(where + text); });
  }

  void check_plugin(const XmlElement& element, const std::string& subject) {
    const XmlElement* plugin = element.FirstChildElement("plugin");
    if (!plugin || text_of(*plugin).empty()) add(subject + " has no <plugin>");
  }

  void check_params(const XmlElement& element, const std::string& where) {
    for_each_child(element, "param", [&](const XmlElement& param) {
      const std::string name = one_line(attribute(param, "name"));
      if (name.empty()) {
        add(where + ": a <param> has no name and is ignored");
      } else if (text_of(param).empty()) {
        add(where + ": the parameter '" + name + "' is empty");
      }
    });
  }

  void require(const XmlElement& element, const char* name) {
    if (attribute(element, name).empty()) add(std::string("it has no ") + name);
  }

  void check_truth(const XmlElement& element, const char* name, const std::string& where = "") {
    const char* text = element.Attribute(name);
    if (!text || lower_case(text) == "true" || lower_case(text) == "false") return;
    add(where + name + " '" + one_line(text) + "' is neither true nor false and is ignored");
  }

  void check_count(const XmlElement& element, const char* name) {
    const std::string text = attribute(element, name);
    if (text.find_first_not_of("0123456789 ") == std::string::npos) return;
    add(std::string(name) + " '" + one_line(text) + "' is not a whole number >= 0");
  }

  void check_enable(const XmlElement& element, const std::string& where) {
    const XmlElement* limits = element.FirstChildElement("limits");
    if (!limits) return;
    if (!limits->Attribute("enable")) add(where + "<limits> has no enable, so the limits are used");
    check_words(*limits, where);
    check_truth(*limits, "enable", where + "<limits>: ");
  }

  NoticeList& notices_;
  std::map<std::string, const XmlElement*> joints_{};      ///< of the robot, by name
  std::map<std::string, const XmlElement*> components_{};  ///< <ros2_control>, by joint
  std::string owner_{};                                    ///< the element, for notices
};

}  // namespace articula::detail

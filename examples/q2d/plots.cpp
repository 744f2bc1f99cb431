// SPDX-License-Identifier: Apache-2.0
#include "plots.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace articula::examples {

namespace {

std::string pair(const Q2dVector& values) {
  std::ostringstream text;
  text << "(" << values[0] << ", " << values[1] << ")";
  return text.str();
}

std::string title_of(const Experiment& e) {
  if (e.is_torque) return e.name + ": " + pair(e.target) + " N m, at rest at first";
  return e.name + ": " + pair(e.initial) + " to " + pair(e.target) + " rad";
}

// Curves that lie on each other stay visible: the lower ones are wider.
std::string style_of(const std::string& controller) {
  if (controller == "bypass") return "linecolor rgb '#909090' linewidth 2";
  if (controller == "pid") return "linecolor rgb '#f5c060' linewidth 6";
  if (controller == "pid-plus-gravity") return "linecolor rgb '#b04000' linewidth 2";
  return "linecolor rgb '#2060c0' linewidth 2";
}
const std::string reference_style = "linecolor rgb '#202020' linewidth 1.5 dashtype (10,6)";
const std::string limit_style = "linecolor rgb '#d02020' linewidth 1.5 dashtype (6,6)";

// Columns of a recording (csv_file.hpp): the time, and six for each joint.
constexpr std::size_t position_reference = 2, position = 3, effort_command = 6, columns = 6;

}  // namespace

Figure figure_of(const Experiment& experiment, const Options& options) {
  const long samples = std::lround(experiment.duration / Q2dSim().period());
  const long skip = std::max(1L, samples / 1000);
  Figure figure{
      .name = experiment.name,
      .width = 1100,
      .height = 800,
      .columns = 2,
      .layout =
          "title 'Q2D, " + title_of(experiment) + "' margins 0.1,0.98,0.09,0.835 spacing 0.11,0.1",
      .key = "at screen 0.54,0.955 center top vertical maxrows 2 Left reverse samplen 2.5"};
  for (const bool is_effort : {false, true}) {
    for (std::size_t joint = 0; joint < 2; ++joint) {
      const bool has_key = !is_effort && joint == 0;  // of all panels
      const auto title = [&](const std::string& text) { return has_key ? text : ""; };
      Panel panel{.title = is_effort ? "" : std::string(short_name(joint_names(Q2d())[joint])),
                  .unit = is_effort ? "effort command [N m]" : "position [rad]",
                  .times = "[0:" + std::to_string(experiment.duration) + "]"};
      const auto column = [&](const std::string& controller, std::size_t number) {
        return column_of(csv_name(experiment, controller), number + columns * joint, skip);
      };
      for (const std::string& controller : options.controllers) {
        panel.curves.push_back({column(controller, is_effort ? effort_command : position),
                                style_of(controller), title(controller)});
      }
      if (is_effort) {
        const double limit = effort_limits(Q2d())[static_cast<Eigen::Index>(joint)];
        const std::string range = std::to_string(1.15 * limit);
        panel.range = "[-" + range + ":" + range + "]";
        panel.curves.push_back({std::to_string(limit), limit_style, ""});
        panel.curves.push_back({std::to_string(-limit), limit_style, ""});
      } else {
        panel.curves.push_back({column(options.controllers.front(), position_reference),
                                reference_style, title("reference")});
        if (has_key) panel.curves.push_back({"NaN", limit_style, "limit"});
      }
      figure.panels.push_back(panel);
    }
  }
  return figure;
}

}  // namespace articula::examples

// SPDX-License-Identifier: Apache-2.0
#include "files/trajectory_file.hpp"

#include <articula/text/file_error.hpp>
#include <articula/text/numbers.hpp>

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace terminal {

namespace {

using articula::FileError;

/// Reads the nodes of one file. What is refused is named with its place.
class TrajectoryReader {
 public:
  explicit TrajectoryReader(std::string file) : file_(std::move(file)) {}

  [[nodiscard]] Json read() {
    std::error_code ignored;
    if (std::filesystem::is_directory(file_, ignored)) {
      throw FileError({.file = file_}, "it is a folder", "a file");
    }
    std::ifstream stream(file_, std::ios::binary);
    if (!stream) throw FileError({.file = file_}, "the file cannot be read");
    std::stringstream text;
    text << stream.rdbuf();
    YAML::Node top;
    try {
      top = YAML::Load(text.str());
    } catch (const YAML::Exception& error) {
      throw FileError(place_of(error.mark), "it is no YAML: " + error.msg);
    }
    if (!top.IsMap()) refuse(top, "no map", "a map with joint_names and points");
    if (top["trajectory"]) return trajectory(top["trajectory"]);
    return trajectory(top);
  }

 private:
  [[nodiscard]] articula::FilePlace place_of(const YAML::Mark& mark) const {
    if (mark.is_null()) return {.file = file_};
    return {.file = file_, .line = mark.line + 1, .column = mark.column + 1};
  }
  [[noreturn]] void refuse(const YAML::Node& node, const std::string& fault,
                           const std::string& expected) const {
    throw FileError(place_of(node.Mark()), fault, expected);
  }
  void check_keys(const YAML::Node& map, const std::vector<std::string_view>& known) const {
    std::string list;
    for (const std::string_view key : known) list += (list.empty() ? "" : ", ") + std::string(key);
    for (const auto& entry : map) {
      const std::string name = entry.first.IsScalar() ? entry.first.Scalar() : "?";
      if (std::ranges::find(known, name) == known.end()) {
        refuse(entry.first, "unknown key '" + name + "'", "one of " + list);
      }
    }
  }

  [[nodiscard]] Json trajectory(const YAML::Node& node) const {
    if (!node.IsMap()) refuse(node, "no map", "a map with joint_names and points");
    check_keys(node, {"header", "joint_names", "points"});
    const YAML::Node names = node["joint_names"], points = node["points"];
    if (!names || !names.IsSequence()) refuse(node, "joint_names are missing", "a list of names");
    if (!points || !points.IsSequence()) refuse(node, "points are missing", "a list of points");
    Json result{{"joint_names", Json::array()}, {"points", Json::array()}};
    for (const YAML::Node& name : names) {
      if (!name.IsScalar() || name.Scalar().empty()) refuse(name, "no name", "the name of a joint");
      result["joint_names"].push_back(name.Scalar());
    }
    if (points.size() == 0) refuse(points, "there are no points", "one at least");
    for (const YAML::Node& each : points) {
      result["points"].push_back(point(each, names.size()));
    }
    return result;
  }

  [[nodiscard]] Json point(const YAML::Node& node, std::size_t joints) const {
    if (!node.IsMap()) refuse(node, "no map", "a point: positions and time_from_start");
    check_keys(node, {"positions", "velocities", "accelerations", "effort", "time_from_start"});
    Json result = Json::object();
    for (const char* member : {"positions", "velocities", "accelerations", "effort"}) {
      const YAML::Node list = node[member];
      if (!list) continue;
      if (!list.IsSequence()) refuse(list, std::string(member) + " are no list", "numbers");
      if (list.size() != 0 && list.size() != joints) {
        refuse(list, std::string(member) + " has " + std::to_string(list.size()) + " numbers",
               "none, or one for each of the " + std::to_string(joints) + " joints");
      }
      Json numbers = Json::array();
      for (const YAML::Node& each : list) numbers.push_back(number(each));
      result[member] = numbers;
    }
    const YAML::Node time = node["time_from_start"];
    if (!time) refuse(node, "time_from_start is missing", "seconds, or {sec, nanosec}");
    result["time_from_start"] = seconds(time);
    return result;
  }

  [[nodiscard]] double number(const YAML::Node& node) const {
    const auto value =
        node.IsScalar() ? articula::detail::number_of(node.Scalar()) : std::optional<double>();
    if (!value) {
      refuse(node, node.IsScalar() ? "'" + node.Scalar() + "' is no number" : "no number",
             "a finite number");
    }
    return *value;
  }

  [[nodiscard]] double seconds(const YAML::Node& node) const {
    if (!node.IsMap()) return number(node);
    check_keys(node, {"sec", "nanosec", "secs", "nsecs"});
    double sum = 0;
    for (const auto& entry : node) {
      sum += (entry.first.Scalar().starts_with("n") ? 1e-9 : 1) * number(entry.second);
    }
    return sum;
  }

  std::string file_;
};

}  // namespace

Json read_trajectory_file(const std::string& file) { return TrajectoryReader(file).read(); }

double duration_of(const Json& trajectory) {
  return trajectory.at("points").back().at("time_from_start").get<double>();
}

}  // namespace terminal

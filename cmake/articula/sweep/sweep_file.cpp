// SPDX-License-Identifier: Apache-2.0
/// @file Reads the YAML of a sweep. docs/sweeps.md lists its keys.
#include "files/robot_file.hpp"
#include "program.hpp"
#include "sweep_plan.hpp"

#include <articula/config/read/read_signal.hpp>
#include <articula/config/yaml/config_map.hpp>
#include <articula/config/yaml/document.hpp>
#include <articula/text/similar_word.hpp>
#include <articula/urdf/read_urdf.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace terminal {

namespace {

using articula::Variation;
using articula::detail::ConfigMap;
using articula::detail::ConfigNode;
namespace fs = std::filesystem;

class SweepReader {
 public:
  SweepReader(const std::string& file, bool compiles)
      : file_(file),
        compiles_(compiles),
        root_(articula::detail::read_document(articula::ConfigSource(file))) {}

  SweepPlan read() {
    ConfigMap map(root_, plan_.notes);
    plan_.text = text_of_rows();
    const auto* experiment = map.require("experiment");
    const auto* vary = map.require("vary");
    for (const char* key :
         {"search", "sampling", "specifications", "worst", "quantiles", "plots", "output"}) {
      static_cast<void>(map.find(key));  // known before read_robot refuses unknown keys
    }
    read_robot(map);
    read_experiment(*experiment);
    for (const ConfigNode& item : vary->list()) plan_.vary.push_back(variation(item));
    if (auto search = map.find_map("search")) read_search(*search);
    if (const auto* node = map.find("sampling")) read_sampling(*node);
    if (levels_ != nullptr && plan_.options.sampling.method != articula::SamplingMethod::grid) {
      levels_->refuse("only a grid has levels", "no levels, or the sampling method grid");
    }
    if (const auto* node = map.find("specifications")) {
      if (!node->is_map()) node->refuse("a map of metrics and their highest values");
      for (const ConfigNode& item : node->items) {
        plan_.names[item.key] = item.key_place;
        plan_.options.specifications.push_back({item.key, item.number()});
      }
    }
    if (auto worst = map.find_map("worst")) {
      if (const auto* metric = worst->find("metric")) {
        plan_.options.worst_metric = metric->name();
        plan_.names[metric->text] = metric->place;
      }
      if (const auto* count = worst->find("count")) {
        plan_.options.worst = static_cast<std::size_t>(count->integer(0, 10'000));
      }
      worst->finish();
    }
    if (plan_.options.worst_metric.empty()) plan_.options.worst_metric = plan_.search.metric;
    if (const auto* node = map.find("quantiles")) read_quantiles(*node);
    if (auto plots = map.find_map("plots")) read_plots(*plots);
    plan_.output = fs::path(file_).replace_extension().string() + "_results";
    if (const auto* node = map.find("output")) plan_.output = beside(node->word());
    return std::move(plan_);
  }

 private:
  /// A file named in this one.
  [[nodiscard]] std::string beside(const std::string& name) const {
    return (fs::path(file_).parent_path() / name).string();
  }
  /// What decides the rows and is not in the checkpoint's options, without comments: plots and
  /// tables may change.
  [[nodiscard]] std::string text_of_rows() const {
    std::string text;
    for (const char* key : {"experiment", "controller", "allow_unphysical"}) {
      if (const ConfigNode* node = root_.find(key)) add_text(text, *node);
    }
    return text;
  }
  static void add_text(std::string& text, const ConfigNode& node) {
    text += node.key + ": " + node.text + " {";
    for (const ConfigNode& item : node.items) add_text(text, item);
    text += "}";
  }
  [[nodiscard]] static std::string text_of(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  /// Refuses a name that no controller of the file has.
  static void check_controller(const ConfigNode& node, const std::string& file) {
    std::vector<std::string> names;
    try {
      for (const PlannedController& each : read_controllers(file).controllers) {
        names.push_back(each.name);
      }
    } catch (const std::exception&) {
      return;  // all of them do not go together; one may
    }
    if (std::ranges::find(names, node.name()) != names.end()) return;
    node.refuse(file + " has no controller '" + articula::detail::shown(node.name()) + "'",
                articula::detail::one_of_words(node.name(), names));
  }

  void read_robot(ConfigMap& map) {
    const ConfigNode* robot = map.require("robot");
    const ConfigNode* controllers = map.require("controllers");
    const ConfigNode* controller = map.find("controller");
    articula::UrdfOptions options;
    map.read_truth("allow_unphysical", options.allow_unphysical);
    map.finish();  // throws if a key is missing or unknown
    const std::string file = beside(controllers->word());
    ControllersPlan& read = plan_.controllers;
    if (controller != nullptr) {
      check_controller(*controller, file);
      read = read_controllers(file, {controller->name()});
    } else {
      read = read_controllers(file);
    }
    auto& all = read.controllers;
    std::erase_if(all, [](const PlannedController& each) {
      return each.kind != ControllerKind::pid && each.kind != ControllerKind::pid_plus_gravity &&
             each.kind != ControllerKind::computed_torque;
    });
    if (all.empty()) {
      (controller ? controller : controllers)
          ->refuse("it names no Pid, PidPlusGravity or ComputedTorque controller",
                   "one of these, whose gains can vary");
    }
    options.root = read.root;
    options.tip = read.tip;
    if (read.gravity) options.gravity = *read.gravity;
    const std::string urdf = beside(robot->word());
    const articula::UrdfSource source = robot_source(urdf);
    plan_.urdf = source.text();
    plan_.allows_unphysical = options.allow_unphysical;
    plan_.text += text_of(file) + plan_.urdf;
    plan_.robot = articula::read_urdf(source, options);
    plan_.substeps = default_substeps(read.period);
    for (const articula::Joint& joint : (*plan_.robot)->joints) {
      if (articula::detail::is_free(joint)) joints_.emplace_back(joint.name.view());
    }
    for (const articula::Link& link : (*plan_.robot)->links) links_.emplace_back(link.name.view());
    const articula::ModelSize size = articula::model_size((*plan_.robot)->joints);
    if (size.bodies != size.joints) robot->refuse("it has mimic joints", "a robot without");
    if (!compiles_ && std::ranges::find(swept_joints, size.joints) == swept_joints.end()) {
      std::string ready;
      for (const int joints : swept_joints) {
        ready += (ready.empty() ? "" : ", ") + std::to_string(joints);
      }
      robot->refuse("it has " + std::to_string(size.joints) + " joints",
                    ready + " (CMake's ARTICULA_SWEPT_JOINTS), or the option --compile");
    }
  }

  /// Refuses a key that names no joint.
  void check_joint(const ConfigNode& item) const {
    if (std::ranges::find(joints_, item.key) != joints_.end()) return;
    throw articula::FileError(item.key_place,
                              "the robot has no joint '" + articula::detail::shown(item.key) + "'",
                              articula::detail::one_of_words(item.key, joints_));
  }
  [[nodiscard]] std::map<std::string, double> positions(const ConfigNode* node) const {
    std::map<std::string, double> all;
    if (node == nullptr) return all;
    if (!node->is_map()) node->refuse("a map of joints and positions");
    for (const ConfigNode& item : node->items) {
      check_joint(item);
      const auto joint = std::ranges::find_if(
          (*plan_.robot)->joints,
          [&](const articula::Joint& each) { return each.name.view() == item.key; });
      const double position = item.number();
      if (joint->type != articula::JointType::continuous &&
          (position < joint->limits.lower || position > joint->limits.upper)) {
        item.refuse("a position within the joint's limits, " +
                    articula::detail::rounded_text(joint->limits.lower) + " to " +
                    articula::detail::rounded_text(joint->limits.upper));
      }
      all[item.key] = position;
    }
    return all;
  }
  void read_experiment(const ConfigNode& node) {
    ConfigMap map(node, plan_.notes);
    if (const auto* duration = map.find("duration")) plan_.duration = duration->positive();
    if (const auto* substeps = map.find("substeps")) plan_.substeps = substeps->integer(1, 10'000);
    plan_.start = positions(map.find("start"));
    plan_.target = positions(map.require("target"));
    if (const auto* all = map.find("disturbances")) {
      if (!all->is_map()) all->refuse("a map of joints and signals");
      for (const ConfigNode& item : all->items) {
        check_joint(item);
        ConfigMap signal(item, plan_.notes);
        plan_.disturbances.push_back(
            {articula::Name(item.key),
             articula::detail::SignalShapeReader(signal, std::numeric_limits<double>::infinity())
                 .read(),
             articula::SignalTarget::effort});
        signal.finish();
      }
    }
    map.finish();
    const double cycles = plan_.duration / plan_.controllers.period;
    if (!(cycles >= 1 && cycles <= 1e6)) {
      map.find("duration")->refuse("1 to 1 000 000 periods of the controller");
    }
  }

  void read_search(ConfigMap& map) {
    SweepSearch& search = plan_.search;
    if (const auto* metric = map.require("minimise")) {
      search.metric = metric->name();
      plan_.names[metric->text] = metric->place;
    }
    if (const auto* quantile = map.find("quantile")) {
      search.quantile = quantile->number();
      if (!(search.quantile >= 0 && search.quantile <= 1)) quantile->refuse("a number from 0 to 1");
    }
    if (const auto* over = map.require("over")) {
      if (over->list().empty()) over->refuse("at least one quantity to search");
      for (const ConfigNode& item : over->items) {
        if (const auto* levels = item.find("levels")) {
          levels->refuse("a search has no levels", "no levels");
        }
        search.over.push_back(variation(item));
      }
    }
    if (const auto* evaluations = map.find("evaluations")) {
      search.evaluations = evaluations->integer(2, 1'000'000);
    }
    map.finish();
  }

  [[nodiscard]] Variation variation(const ConfigNode& node) {
    ConfigMap map(node, plan_.notes);
    Variation variation;
    if (const auto* quantity = map.require("quantity")) {
      std::vector<std::string> names;
      for (const auto& traits : articula::varied_quantities) names.emplace_back(traits.name);
      variation.quantity = static_cast<articula::VariedQuantity>(quantity->index_in(names));
    }
    if (const auto* joint = map.find("joint")) {
      variation.where = named(*joint, joints_, "joint");
    }
    if (const auto* link = map.find("link")) variation.where = named(*link, links_, "link");
    const auto subject = articula::traits_of(variation.quantity).subject;
    const auto* joint = node.find("joint");
    const auto* link = node.find("link");
    if (joint != nullptr && subject != articula::VariedSubject::joint) {
      map.refuse_key(*joint, subject == articula::VariedSubject::link ? "link" : "no joint");
    }
    if (link != nullptr && subject != articula::VariedSubject::link) {
      map.refuse_key(*link, subject == articula::VariedSubject::joint ? "joint" : "no link");
    }
    if (const auto* low = map.require("low")) variation.low = low->number();
    if (const auto* high = map.require("high")) variation.high = high->number();
    if (const auto* spacing = map.find("spacing")) {
      variation.spacing =
          static_cast<articula::Spacing>(spacing->index_in({"linear", "logarithmic"}));
    }
    if (const auto* levels = map.find("levels")) {
      variation.levels = levels->integer(1, 1'000'000);
      levels_ = levels;
    }
    map.finish();
    try {
      validate(variation);
    } catch (const std::invalid_argument& error) {
      throw articula::FileError(node.place, error.what());
    }
    const std::string name = variation.parameter().name;
    for (const auto* others : {&plan_.vary, &plan_.search.over}) {
      for (const Variation& other : *others) {
        if (other.parameter().name == name) node.refuse("'" + name + "' varies twice", "it once");
      }
    }
    plan_.names.emplace(name, node.place);
    return variation;
  }
  static articula::Name named(const ConfigNode& node, const std::vector<std::string>& names,
                              std::string_view what) {
    const std::string& name = node.name();
    if (std::ranges::find(names, name) == names.end()) {
      node.refuse(
          "the robot has no " + std::string(what) + " '" + articula::detail::shown(name) + "'",
          articula::detail::one_of_words(name, names));
    }
    return articula::Name(name);
  }

  void read_sampling(const ConfigNode& node) {
    ConfigMap map(node, plan_.notes);
    articula::Sampling& sampling = plan_.options.sampling;
    constexpr int most_runs = std::numeric_limits<int>::max();
    if (const auto* method = map.find("method")) {
      sampling.method = static_cast<articula::SamplingMethod>(
          method->index_in({"grid", "random", "latin_hypercube", "sobol"}));
    }
    if (const auto* runs = map.find("runs")) {
      sampling.runs = static_cast<std::uint64_t>(runs->integer(1, most_runs));
      if (sampling.method == articula::SamplingMethod::grid) {
        map.refuse_key(*runs, "no runs, since the levels of a grid tell them");
      }
    }
    if (const auto* seed = map.find("seed")) {
      sampling.seed = static_cast<std::uint64_t>(seed->integer(0, most_runs));
    }
    map.finish();
  }
  void read_quantiles(const ConfigNode& node) {
    plan_.quantiles.clear();
    for (const ConfigNode& item : node.list()) {
      const double share = item.number();
      if (share < 0 || share > 1) item.refuse("a number from 0 to 1");
      plan_.quantiles.push_back(share);
    }
  }
  void read_plots(ConfigMap& plots) {
    using enum SweepPlot::Kind;
    const auto column = [&](const ConfigNode& item) {
      plan_.names.emplace(item.name(), item.place);
      return item.text;
    };
    if (const auto* node = plots.find("histograms")) {
      for (const ConfigNode& item : node->list()) {
        plan_.plots.push_back({histogram, {column(item)}});
      }
    }
    const auto read_pairs = [&](const char* key, SweepPlot::Kind kind) {
      const auto* node = plots.find(key);
      if (node == nullptr) return;
      for (const ConfigNode& pair : node->list()) {
        if (pair.list().size() != 2) pair.refuse("a list of two columns");
        plan_.plots.push_back({kind, {column(pair.items[0]), column(pair.items[1])}});
      }
    };
    read_pairs("scatters", scatter);
    read_pairs("maps", map);
    plots.finish();
  }

  std::string file_;
  bool compiles_;
  ConfigNode root_;
  SweepPlan plan_{};
  std::vector<std::string> joints_{}, links_{};
  const ConfigNode* levels_ = nullptr;  ///< of an entry of vary that has them
};

}  // namespace

SweepPlan read_sweep(const std::string& file, bool compiles) {
  return SweepReader(file, compiles).read();
}

}  // namespace terminal

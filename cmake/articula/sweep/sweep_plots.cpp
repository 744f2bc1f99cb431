// SPDX-License-Identifier: Apache-2.0
/// @file Plots of a sweep's rows by gnuplot: histograms, scatter plots, and maps of two parameters.
#include "program.hpp"
#include "sweep_plan.hpp"

#include <articula/text/numbers.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace terminal {

namespace {

/// A column by its name. Names are those of joints and links, without quotation marks.
std::string column(const std::string& name) { return "column(\"" + name + "\")"; }

/// gnuplot's condition that a row meets all specifications.
std::string is_within(const SweepPlan& plan) {
  std::string condition = "(strcol(\"end\") eq \"stable\"";
  for (const articula::SweepSpecification& each : plan.options.specifications) {
    condition +=
        " && " + column(each.metric) + " <= " + articula::detail::number_text(each.highest);
  }
  return condition + ")";
}

/// gnuplot's commands for an axis whose column is spaced logarithmically; else nothing. gnuplot
/// labels powers of ten only; a short range gets labels at 1, 2 and 5.
std::string logarithmic_axis(const SweepPlan& plan, const std::string& name,
                             const std::string& axis) {
  const auto own = std::ranges::find_if(plan.vary, [&](const articula::Variation& each) {
    return each.spacing == articula::Spacing::logarithmic && each.parameter().name == name;
  });
  if (own == plan.vary.end()) return "";
  std::string text = "set logscale " + axis + "\nset format " + axis + " '%g'\n";
  constexpr double short_range = 300;
  if (own->high > short_range * own->low) return text;
  std::string labels;
  for (int decade = static_cast<int>(std::floor(std::log10(own->low)));
       decade <= static_cast<int>(std::ceil(std::log10(own->high))); ++decade) {
    for (const char* digit : {"1", "2", "5"}) {
      labels += (labels.empty() ? "" : ", ") + std::string(digit) + "e" + std::to_string(decade);
    }
  }
  return text + "set " + axis + "tics (" + labels + ")\n";
}

/// A column's name, and its unit unless it is a plain number.
std::string label(const AnyExperiment& experiment, const std::string& name) {
  std::string unit = "1";
  for (const auto& each : experiment.parameters()) {
    if (each.name == name) unit = each.unit;
  }
  for (const auto& each : experiment.metrics()) {
    if (each.name == name) unit = each.unit;
  }
  return unit == "1" ? name : name + " [" + unit + "]";
}

/// The two edges of a run's cell in a grid, for gnuplot; empty if the column is none of its
/// parameters.
std::string cell_edges(const SweepPlan& plan, const std::string& name) {
  const auto own = std::ranges::find_if(plan.vary, [&](const articula::Variation& each) {
    return each.parameter().name == name && each.levels > 1;
  });
  if (plan.options.sampling.method != articula::SamplingMethod::grid || own == plan.vary.end()) {
    return "";
  }
  const bool is_logarithmic = own->spacing == articula::Spacing::logarithmic;
  const double steps = 2.0 * (own->levels - 1);
  const std::string half = articula::detail::number_text(
      is_logarithmic ? std::pow(own->high / own->low, 1 / steps) : (own->high - own->low) / steps);
  const std::string x = column(name);
  return is_logarithmic ? "(" + x + " / " + half + "):(" + x + " * " + half + ")"
                        : "(" + x + " - " + half + "):(" + x + " + " + half + ")";
}

/// Of a script, by which it is recognised.
std::string first_line(const std::string& name) {
  return "# Draws " + name + ".svg in this folder: gnuplot " + name + ".gp";
}

std::string script_of(const SweepPlan& plan, const AnyExperiment& experiment, const SweepPlot& plot,
                      const std::string& name) {
  std::string text = first_line(name) +
                     "\nset terminal svg size 800,560 font 'Helvetica,15' background rgb 'white'"
                     "\nset output '" +
                     name + ".svg'\nset datafile separator ','\nset grid\nset rmargin 4\n";
  for (std::size_t k = 0; k < plot.columns.size(); ++k) {
    text += std::string("set ") + (k == 0 ? "x" : "y") + "label '" +
            label(experiment, plot.columns[k]) + "' noenhanced\n";
  }
  for (std::size_t k = 0; k < plot.columns.size(); ++k) {
    text += logarithmic_axis(plan, plot.columns[k], k == 0 ? "x" : "y");
  }
  const std::string x = column(plot.columns[0]);
  switch (plot.kind) {
    case SweepPlot::Kind::histogram:
      return text + "set ylabel 'runs'\nset style fill solid 0.6\n" +
             "set yrange [0:*]\nplot 'rows.csv' using (" + x +
             ") bins=50 with boxes linecolor rgb '#2060a0' notitle\n";
    case SweepPlot::Kind::scatter:
      return text + "plot 'rows.csv' using (" + x + "):(" + column(plot.columns[1]) +
             ") with points pointtype 7 pointsize 0.3 linecolor rgb '#2060a0' notitle\n";
    case SweepPlot::Kind::map:
      break;
  }
  const std::string y = column(plot.columns[1]);
  const std::string edges_x = cell_edges(plan, plot.columns[0]),
                    edges_y = cell_edges(plan, plot.columns[1]);
  // The runs of a grid are tiles, other runs are points.
  const bool has_tiles = !edges_x.empty() && !edges_y.empty();
  const auto drawn = [&](const std::string& condition, const std::string& color,
                         const char* title) {
    return "'rows.csv' using (" + condition + " ? " + x + " : NaN):(" + y + ")" +
           (has_tiles ? ":" + edges_x + ":" + edges_y + " with boxxyerror fillstyle solid noborder"
                      : " with points pointtype 5 pointsize 0.9") +
           " linecolor rgb '" + color + "' title '" + title + "'";
  };
  const bool has_specifications = !plan.options.specifications.empty();
  return text +
         "set key outside center top horizontal\nset autoscale xfix\nset autoscale yfix\nplot " +
         drawn(is_within(plan), "#30a050",
               has_specifications ? "within specifications" : "stable") +
         ", \\\n  " +
         drawn("!" + is_within(plan), "#c04040", has_specifications ? "outside" : "not stable") +
         "\n";
}

/// Removes the plots of a folder from a number on.
void remove_plots(const std::filesystem::path& folder, std::size_t number) {
  for (;; ++number) {
    const std::string name = "plot_" + std::to_string(number);
    std::string line;
    std::getline(std::ifstream(folder / (name + ".gp")), line);
    if (line != first_line(name)) return;  // there is none, or it is the user's own
    std::filesystem::remove(folder / (name + ".gp"));
    for (const char* ending : {".svg", ".log"}) std::filesystem::remove(folder / (name + ending));
  }
}

}  // namespace

std::string draw_sweep(const SweepPlan& plan, const AnyExperiment& experiment) {
  const std::string& folder = plan.output;
  remove_plots(folder, plan.plots.size() + 1);  // of another plan
  if (plan.plots.empty()) return "";
  const bool can_draw = std::system("command -v gnuplot >/dev/null 2>&1") == 0;
  std::size_t number = 0;
  const std::filesystem::path here = std::filesystem::current_path();
  std::string failed;
  for (const SweepPlot& plot : plan.plots) {
    const std::string name = "plot_" + std::to_string(++number);
    const std::filesystem::path path = std::filesystem::path(folder) / (name + ".gp");
    std::ofstream script(path);
    script << script_of(plan, experiment, plot, name);
    script.close();
    if (!script) throw Refusal("cannot write " + path.string());
    if (!can_draw) continue;
    std::filesystem::current_path(folder);  // so that no shell has to read the folder's name
    const int status = std::system(("gnuplot " + name + ".gp 2>" + name + ".log").c_str());
    std::filesystem::current_path(here);
    if (status != 0) failed += " " + name + ".gp";
  }
  if (!can_draw) return "no plots: gnuplot is not installed; the scripts are in " + folder;
  if (!failed.empty()) return "gnuplot could not draw" + failed + "; its logs are in " + folder;
  return std::to_string(number) + " plots in " + folder;
}

}  // namespace terminal

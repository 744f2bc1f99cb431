// SPDX-License-Identifier: Apache-2.0
/// @file Figures of runs, drawn by gnuplot: a general one, and one for the numbered examples.
#pragma once

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

/// A curve of a panel.
struct Curve {
  std::string data;             ///< what gnuplot draws: a function, or as from `column_of`
  std::string style;            ///< in gnuplot's words; may be empty
  std::string title;            ///< in the key; none if empty
  std::string drawn = "lines";  ///< or "points"
};

/// A column of a CSV file over its first column.
/// @param number  of the column, from 1
/// @param skip    every so many rows are drawn
inline std::string column_of(const std::string& csv, std::size_t number, long skip = 1) {
  return "'" + csv + "' every " + std::to_string(skip) + "::1 using 1:" + std::to_string(number);
}

/// Curves of one unit over time, or over another quantity.
struct Panel {
  std::string title;  ///< may be empty
  std::string unit;   ///< label of the vertical axis
  std::vector<Curve> curves{};
  std::string range = "[*:*]";  ///< of the vertical axis
  std::string times = "[]";     ///< range of the horizontal axis; all data by default
};

/// Panels in rows. The script, the drawing and the data lie in one folder.
struct Figure {
  std::string name;  ///< of <name>.gp and <name>.svg
  int width = 900, height = 700;
  std::size_t columns = 1;
  std::string layout{};  ///< more words for gnuplot's `set multiplot`
  std::string key = "outside center top horizontal";
  std::string horizontal = "time [s]";  ///< label of the horizontal axis
  std::vector<Panel> panels{};

  /// Writes <name>.gp.
  /// @throws std::runtime_error if the file cannot be written
  void write_script(const std::filesystem::path& folder) const {
    const std::filesystem::path path = folder / (name + ".gp");
    std::ofstream script(path);
    script << "# Draws " << name << ".svg in this folder: gnuplot " << name << ".gp\n"
           << "set terminal svg size " << width << ',' << height
           << " font 'Helvetica,15' background rgb 'white'\nset output '" << name << ".svg'\n"
           << "set datafile separator ','\nset autoscale xfix\nset lmargin 10\n"
           << "set offsets 0, 0, graph 0.05, graph 0.05\nset grid linecolor rgb '#d0d0d0'\n"
           << "set key " << key << "\nset multiplot layout "
           << (panels.size() + columns - 1) / columns << ',' << columns << ' ' << layout << '\n';
    for (std::size_t k = 0; k < panels.size(); ++k) {
      const Panel& panel = panels[k];
      if (k + columns == panels.size()) script << "set xlabel '" << horizontal << "'\n";
      script << "set title '" << panel.title << "' offset 0,-0.5\nset ylabel '" << panel.unit
             << "'\nplot " << panel.times << ' ' << panel.range;
      const char* separator = " ";
      for (const auto& [data, style, title, drawn] : panel.curves) {
        script << separator << "\\\n  " << data << " with " << drawn << ' ' << style << " title '"
               << title << "' noenhanced";
        separator = ", ";
      }
      script << '\n';
    }
    script << "unset multiplot\n";
    script.close();
    if (!script) throw std::runtime_error("cannot write " + path.string());
  }

  /// Runs the script.
  /// @return false if gnuplot is not installed
  /// @throws std::runtime_error if gnuplot fails
  [[nodiscard]] bool draw(const std::filesystem::path& folder) const {
    if (std::system("command -v gnuplot >/dev/null") != 0) return false;
    const std::filesystem::path here = std::filesystem::current_path();
    std::filesystem::current_path(folder);  // so that no shell has to read the folder's name
    const int status = std::system(("gnuplot " + name + ".gp").c_str());
    std::filesystem::current_path(here);
    if (status != 0) throw std::runtime_error("gnuplot failed on " + name + ".gp");
    return true;
  }
};

/// Collects the values of a run and draws them: one curve per column, one panel per unit. Values of
/// many runs are points over a quantity in which the runs differ.
///
///     Plot plot("waves", {"shoulder [rad]", "elbow [rad]", "elbow effort [N m]"});
///     plot.add(loop.time(), {state.position[0], state.position[1], state.effort[1]});
///     plot.save();  // waves.csv, waves.gp and waves.svg in the working folder
class Plot {
 public:
  /// @param name     of the files, made of letters, digits and underscores
  /// @param columns  names of the curves, each with its unit in brackets at the end
  /// @param points_over  the horizontal quantity with its unit: values are points; empty: they are
  ///                     curves over time
  Plot(std::string name, const std::vector<std::string>& columns,
       const std::string& points_over = {})
      : figure_{.name = std::move(name)}, width_(columns.size()), file_(csv()) {
    if (!points_over.empty()) figure_.horizontal = points_over;
    const std::string drawn = points_over.empty() ? "lines" : "points";
    const std::string style = points_over.empty() ? "linewidth 2" : "pointtype 7 pointsize 0.4";
    file_.precision(9);
    file_ << figure_.horizontal;
    for (std::size_t c = 0; c < width_; ++c) {
      file_ << ',' << columns[c];
      const std::size_t end = columns[c].rfind('[');
      panel_of(columns[c].substr(end))
          .curves.push_back({column_of(csv(), c + 2), style, columns[c].substr(0, end - 1), drawn});
    }
    file_ << '\n';
    figure_.height = 80 + 300 * static_cast<int>(figure_.panels.size());
  }

  /// One point in time [s] or of the horizontal quantity, with a value for each column. NaN is not
  /// drawn.
  void add(double horizontal, std::initializer_list<double> values) {
    if (values.size() != width_) throw std::invalid_argument("plot: one value for each column");
    file_ << horizontal;
    for (const double value : values) file_ << ',' << value;
    file_ << '\n';
  }

  /// Writes the files and draws. Without gnuplot, prints a line and leaves the data.
  /// @throws std::runtime_error if a file cannot be written or gnuplot fails
  void save() {
    file_.close();
    if (!file_) throw std::runtime_error("plot: cannot write " + csv());
    figure_.write_script(".");
    if (figure_.draw(".")) return;
    std::printf("no plot: gnuplot is not installed; the numbers are in %s\n", csv().c_str());
  }

 private:
  [[nodiscard]] std::string csv() const { return figure_.name + ".csv"; }

  Panel& panel_of(const std::string& unit) {
    for (Panel& panel : figure_.panels) {
      if (panel.unit == unit) return panel;
    }
    return figure_.panels.emplace_back(Panel{.title = "", .unit = unit});
  }

  Figure figure_;
  std::size_t width_;
  std::ofstream file_;
};

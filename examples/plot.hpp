// SPDX-License-Identifier: Apache-2.0
/// @file The picture of a run, for the numbered examples.
#pragma once

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

/// Collects what an example did and draws it with gnuplot: one curve per column, one panel per
/// unit.
///
///     Plot plot("waves", {"shoulder [rad]", "elbow [rad]", "elbow effort [N m]"});
///     plot.add(loop.time(), {state.position[0], state.position[1], state.effort[1]});
///     plot.save();  // waves.csv, waves.gp and waves.svg in the working folder
class Plot {
 public:
  /// @param name     of the files, made of letters, digits and underscores
  /// @param columns  what is drawn, each with its unit in brackets at the end
  Plot(std::string name, std::vector<std::string> columns)
      : name_(std::move(name)), columns_(std::move(columns)), file_(name_ + ".csv") {
    file_.precision(9);
    file_ << "time [s]";
    for (const std::string& column : columns_) file_ << ',' << column;
    file_ << '\n';
  }

  /// One point in time [s], with a value for each column.
  void add(double time, std::initializer_list<double> values) {
    if (values.size() != columns_.size()) throw std::invalid_argument("plot: columns and values");
    file_ << time;
    for (const double value : values) file_ << ',' << value;
    file_ << '\n';
  }

  /// Writes the files and draws. Without gnuplot, says so and leaves the rest.
  /// @throws std::runtime_error if a file cannot be written or gnuplot fails
  void save() {
    file_.close();
    if (!file_) throw std::runtime_error("plot: cannot write " + name_ + ".csv");
    write_script();
    if (std::system("command -v gnuplot >/dev/null") != 0) {
      std::printf("no plot: gnuplot is not installed; the numbers are in %s.csv\n", name_.c_str());
      return;
    }
    if (std::system(("gnuplot " + name_ + ".gp").c_str()) != 0) {
      throw std::runtime_error("plot: gnuplot failed on " + name_ + ".gp");
    }
  }

 private:
  static std::string unit(const std::string& column) { return column.substr(column.rfind('[')); }

  void write_script() const {
    std::vector<std::string> units;  // in the order of their first column
    for (const std::string& column : columns_) {
      bool known = false;
      for (const std::string& u : units) known = known || u == unit(column);
      if (!known) units.push_back(unit(column));
    }
    std::ofstream script(name_ + ".gp");
    script << "set terminal svg size 900," << 80 + 300 * units.size()
           << " font 'Helvetica,15' background rgb 'white'\n"
           << "set output '" << name_ << ".svg'\n"
           << "set datafile separator ','\nset grid\nset offsets 0, 0, graph 0.05, graph 0.05\n"
           << "set lmargin 10\nset key outside center top horizontal\nset multiplot layout "
           << units.size() << ",1\n";
    for (std::size_t u = 0; u < units.size(); ++u) {
      if (u + 1 == units.size()) script << "set xlabel 'time [s]'\n";
      script << "set ylabel '" << units[u] << "'\nplot ";
      for (std::size_t c = 0; c < columns_.size(); ++c) {
        const std::string& column = columns_[c];
        if (unit(column) != units[u]) continue;
        script << "'" << name_ << ".csv' every ::1 using 1:" << c + 2
               << " with lines linewidth 2 title '" << column.substr(0, column.rfind(" ["))
               << "' noenhanced, ";
      }
      script << "\n";
    }
    script << "unset multiplot\n";
    script.close();
    if (!script) throw std::runtime_error("plot: cannot write " + name_ + ".gp");
  }

  std::string name_;
  std::vector<std::string> columns_;
  std::ofstream file_;
};

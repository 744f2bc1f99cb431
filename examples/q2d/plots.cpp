// SPDX-License-Identifier: Apache-2.0
#include "plots.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <sys/wait.h>

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

// What all experiments share. Curves that lie on each other stay visible: the lower ones are wider.
constexpr const char* body = R"(
set terminal svg size 1100,800 font 'Helvetica,15' background rgb 'white'
set output name.'.svg'
set datafile separator ','
set xrange [0:duration]
set offsets 0, 0, graph 0.05, graph 0.05
set grid linecolor rgb '#d0d0d0'
set style line 1 linecolor rgb '#202020' linewidth 1.5 dashtype (10,6)  # reference
set style line 2 linecolor rgb '#d02020' linewidth 1.5 dashtype (6,6)   # limits

color(c) = c eq 'bypass' ? 0x909090 : c eq 'pid' ? 0xf5c060 : \
           c eq 'pid-plus-gravity' ? 0xb04000 : 0x2060c0
width(c) = c eq 'pid' ? 6 : 2
file(c) = name.'_'.c.'.csv'
column_of(j, what) = column(word(joints, j).'_active_joint '.what)
limit(j) = real(word(limits, j))

set multiplot layout 2,2 title 'Q2D, '.title margins 0.1,0.98,0.09,0.835 spacing 0.11,0.1
set ylabel 'position [rad]'
do for [j = 1:2] {
  set title word(joints, j) offset 0,-0.5
  set key at screen 0.54,0.955 center top vertical maxrows 2 Left reverse samplen 2.5
  if (j == 2) { unset key }
  plot for [c in controllers] file(c) every skip \
         using 'time [s]':(column_of(j, 'position [rad]')) \
         with lines linecolor rgb color(c) linewidth width(c) title c, \
       file(word(controllers, 1)) every skip \
         using 'time [s]':(column_of(j, 'position reference [rad]')) \
         with lines linestyle 1 title 'reference', \
       keyentry with lines linestyle 2 title 'limit'
}
unset title
set xlabel 'time [s]'
set ylabel 'effort command [N m]'
do for [j = 1:2] {
  set yrange [-1.15 * limit(j):1.15 * limit(j)]
  plot for [c in controllers] file(c) every skip \
         using 'time [s]':(column_of(j, 'effort command [N m]')) \
         with lines linecolor rgb color(c) linewidth width(c), \
       limit(j) linestyle 2, -limit(j) linestyle 2
}
unset multiplot
)";

}  // namespace

void write_plot_script(const Experiment& experiment, const Options& options) {
  const std::filesystem::path path = options.output / (experiment.name + ".gp");
  const Q2dVector limits = effort_limits(Q2d());
  const double samples = experiment.duration / Q2dSim().period();
  std::ofstream file(path);
  file << "# Draws " << experiment.name << ".svg from the recordings in this folder: gnuplot "
       << experiment.name << ".gp\n\n"
       << "name = '" << experiment.name << "'\n"
       << "title = '" << title_of(experiment) << "'\n"
       << "controllers = '";
  for (const std::string& controller : options.controllers) file << controller << ' ';
  file << "'\njoints = '";
  for (const std::string_view joint : joint_names(Q2d())) file << short_name(joint) << ' ';
  file << "'\nlimits = '" << limits.transpose() << "'  # [N m]\n"
       << "duration = " << experiment.duration << "  # [s]\n"
       << "skip = " << std::max(1L, std::lround(samples / 1000))
       << "  # draw every so many samples\n"
       << body;
  file.close();
  if (!file) throw std::runtime_error("cannot write " + path.string());
}

void draw_plot(const Experiment& experiment, const Options& options) {
  const std::filesystem::path here = std::filesystem::current_path();
  // Work in the folder, which keeps its name out of the shell's hands.
  std::filesystem::current_path(options.output);
  const std::string command = "command -v gnuplot >/dev/null || exit 127; gnuplot ";
  const int status = std::system((command + experiment.name + ".gp").c_str());
  std::filesystem::current_path(here);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 127) {
    throw std::runtime_error(
        "no plots: gnuplot is not installed (Debian: gnuplot-nox); the recordings are in " +
        options.output.string());
  }
  if (status != 0) throw std::runtime_error("gnuplot failed on " + experiment.name + ".gp");
}

}  // namespace articula::examples

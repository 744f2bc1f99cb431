// SPDX-License-Identifier: Apache-2.0
/// @file A loop in a browser, in one line. Linux; target articula::view.
#pragma once

#include "articula/loop/realtime/run_realtime.hpp"
#include "articula/loop/realtime/stop_on_signal.hpp"
#include "articula/remote/remote.hpp"
#include "articula/urdf/xml/source.hpp"
#include "articula/view/open_in_browser.hpp"
#include "articula/view/view.hpp"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <limits>
#include <string>

namespace articula {

/// Options of `show`: a view that lets clients operate, and a run until Ctrl-C.
struct ShowOptions {
  ViewOptions view{};                                        ///< clients operate by default
  RunOptions run{};                                          ///< `stop` is set by `show`
  double seconds = std::numeric_limits<double>::infinity();  ///< after which the run ends [s]
  /// The robot's URDF, whose visuals the view shows: a file's name, or XML. `view.mesh_folders` has
  /// the folders of its meshes. Empty: the view shows links as bones.
  std::string urdf{};
  ThreadOptions thread{.priority = 0, .lock_memory = false};  ///< of the loop
  bool opens_browser = false;  ///< opens the address on this machine, if it has a screen
};

/// Runs a loop at its own rate until Ctrl-C, and shows it in a browser:
///
///     int main() {
///       articula::SupervisedLoop<articula::Q2dSim, articula::PidPlusGravity> arm;
///       return articula::show(arm);  // http://127.0.0.1:8765/
///     }
///
/// Prints the address on standard output, and the loop's notices on standard error. A robot with
/// drives needs real-time priority: `{.thread = {.priority = 80}}`. For a recorder or an own
/// thread, use Remote, View and `run` as this function does.
/// @param options         of the view and the run
/// @param remote_options  of the operation, as tolerances of trajectories; `options.urdf` comes
///                        before its URDF
/// @return the exit status of a program: 0, or 1 with a line on standard error if the view cannot
///         start or the URDF cannot be read
template <class LoopType>
int show(LoopType& loop, const ShowOptions& options = {},
         const typename Remote<LoopType>::Options& remote_options = {}) {
  try {
    auto own = remote_options;
    if (!options.urdf.empty()) own.urdf = UrdfSource(options.urdf).text();
    Remote remote(loop, own);
    StopFlag stop;
    const StopOnSignal on_signal(stop);  // before anybody knows that it runs
    ViewOptions view_options = options.view;
    view_options.operates = view_options.operates.value_or(true);
    const View view(remote, view_options);
    std::printf("%s shows the robot. Ctrl-C ends the program.\n", view.url().c_str());
    std::fflush(stdout);
    if (options.opens_browser) open_in_browser(view.url());
    RunOptions run = options.run;
    run.stop = &stop;
    const double cycles = options.seconds / loop.period();
    if (cycles < static_cast<double>(run.cycles)) {
      run.cycles = static_cast<std::uint64_t>(std::llround(cycles));
    }
    articula::run(remote, {.thread = options.thread, .run = run}, remote.each());
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

}  // namespace articula

// SPDX-License-Identifier: Apache-2.0
// The PR2 in a browser, while the torques of pr2_waveforms.yaml act on some of its joints. Springs
// carry its arms. Ctrl-C ends the program, or the end of ARTICULA_VIEW_SECONDS.
#include <articula/articula.hpp>
#include <articula/config/load_signals.hpp>
#include <articula/robots/pr2.hpp>

#include "../beside.hpp"
#include "view_options.hpp"

using namespace articula;

/// The reference's effort, added to the gravity effort.
template <class R>
using Counterbalanced =
    EffortController<R, GravityCompensation<R>, EffortFeedforward<joint_count<R>>>;

/// The controller above, with waves that act beside the reference's effort.
struct Waves {
  JointSignals<Pr2> waves;
  Counterbalanced<Pr2> controller;
  double time = 0;  // s

  void start(const ControlInput<20>& in) noexcept {
    time = 0;
    start_controller(controller, in);
  }
  Outcome<EffortCommand<20>> update(const ControlInput<20>& in) noexcept {
    Outcome<EffortCommand<20>> outcome = update_controller(controller, in);
    outcome.command.effort += waves.sample(time).effort;
    time += in.period;
    return outcome;
  }
};

int main() {
  const Pr2 pr2;
  const JointVector<20> middle = joint_values(pr2, [](const JointProperties& joint) {
    const bool bounded = joint.type != JointType::continuous;
    return bounded ? (joint.limits.lower + joint.limits.upper) / 2 : 0;
  });
  const JointSignals<Pr2> waves(load_signals(pr2, beside("pr2_waveforms.yaml")).signals);
  SupervisedControlLoop robot(Pr2Sim({.initial_position = middle}),
                              Waves{waves, Counterbalanced<Pr2>(pr2, {}, {})},
                              SupervisionOptions{.overruns = 1000});
  robot.request_activation();
  return show(robot, view_options(robot.period()));
}

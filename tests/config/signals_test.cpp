// SPDX-License-Identifier: Apache-2.0
#include <articula/config/load_signals.hpp>
#include <articula/control/bypass.hpp>
#include <articula/loop/loop.hpp>
#include <articula/robots/q2d.hpp>

#include <cmath>
#include <numbers>
#include <string>

#include "catch.hpp"
#include "config_support.hpp"

using namespace articula;
using Catch::Matchers::Contains;
using support::config_file;
using support::yaml;

namespace {

JointReference<2> sampled(const std::string& text, double time, const std::string& name = "") {
  return JointSignals<Q2d>(load_signals(Q2d(), yaml(text), name).signals).sample(time);
}

}  // namespace

TEST_CASE("waveforms from a file are the efforts that they say") {
  const SignalConfig config = load_signals(Q2d(), config_file("waveforms.yaml"));
  REQUIRE(config.signals.size() == 3);
  CHECK(config.notes.empty());
  const JointSignals<Q2d> waves(config.signals);
  for (const double t : {0.0, 0.25, 1.0, 1.999, 2.0, 7.3}) {
    const JointReference<2> reference = waves.sample(t);
    const double pi = std::numbers::pi;
    const double step = t < 2 ? 0 : -1;
    CHECK(reference.effort[0] == Approx(2 * std::sin(pi * t)).margin(1e-12));
    CHECK(reference.effort[1] == Approx(0.5 + 1.5 * std::cos(pi / 2 * t) + step).margin(1e-12));
    CHECK(reference.position.isZero());
  }
  Loop<Q2dSim, Bypass> loop;
  loop.reference() = waves.sample(0.25);
  REQUIRE(loop.update() == Status::ok);
  CHECK(loop.command().effort[0] == Approx(std::numbers::sqrt2));
}

TEST_CASE("the layouts of waveforms mean the same") {
  const std::string wave = "amplitude: 2, frequency: 0.5";
  const std::string layouts[] = {
      "waveforms: {elbow_active_joint: {" + wave + "}}",
      "waveforms: {elbow_active_joint: [{type: sinusoid, " + wave + "}]}",
      "waveforms:\n  - {joint: elbow_active_joint, " + wave + "}\n",
      "waveforms:\n  - {joint_name: elbow_active_joint, amplitude: 2, period: 2}\n",
      "waves: {ros__parameters: {waveforms: {elbow_active_joint: {" + wave + "}}}}",
      "waves: {type: pr2/Waves, waveforms: {elbow_active_joint: {" + wave + "}}}",
      "elbow_active_joint: {" + wave + "}",
      "my_controller: {joint_name: elbow_active_joint, " + wave + "}",
      "waves: {joint: elbow_active_joint, amplitude: 2, angular_frequency: 3.141592653589793}",
  };
  for (const std::string& text : layouts) {
    INFO(text);
    const JointReference<2> reference = sampled(text, 0.25);
    CHECK(reference.effort[1] == Approx(std::numbers::sqrt2));
    CHECK(reference.effort[0] == 0);
  }
}

TEST_CASE("waveforms of positions, and the other shapes") {
  const std::string text =
      "waves:\n"
      "  target: position\n"
      "  waveforms:\n"
      "    shoulder_active_joint: {type: ramp, height: 0.5, duration: 2, start: 1}\n"
      "    elbow_active_joint:\n"
      "      - {type: chirp, amplitude: 0.1, first_frequency: 1, last_frequency: 2, duration: 4}\n"
      "      - {type: step, height: 3, target: torque}\n";
  const JointReference<2> reference = sampled(text, 2);
  CHECK(reference.position[0] == 0.25);
  CHECK(reference.velocity[0] == 0.25);
  CHECK(
      reference.position[1] ==
      Approx(ChirpSignal{.amplitude = 0.1, .first_frequency = 1, .last_frequency = 2, .duration = 4}
                 .sample(2)
                 .value));
  CHECK(reference.effort[1] == 3);
}

TEST_CASE("waveforms that cannot be are refused") {
  const auto complaint = [](const std::string& text) -> std::string {
    try {
      static_cast<void>(load_signals(Q2d(), yaml(text)));
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "none";
  };
  CHECK(complaint("waveforms:\n  elbow_active_joint: {amplitude: 14, frequency: 1}\n") ==
        "test:2:35: waveforms.elbow_active_joint.amplitude: an effort of 14 N m or N, expected at "
        "most the drive's limit, 13.62");
  CHECK_THAT(
      complaint("waveforms: {elbow_active_joint: {amplitude: 10, frequency: 1, offset: -4}}"),
      Contains("offset: an effort of 14"));
  CHECK_THAT(complaint("waveforms: {elbow: {amplitude: 1, frequency: 1}}"),
             Contains("robot 'q2d' has no free joint 'elbow'"));
  CHECK_THAT(
      complaint("waveforms: {elbow_active_joint: {type: sawtooth, amplitude: 1}}"),
      Contains("the word 'sawtooth', expected one of sine, sin, sinusoid, step, ramp, chirp"));
  CHECK_THAT(complaint("waveforms: {elbow_active_joint: {amplitude: 1}}"),
             Contains("the key 'frequency' is missing"));
  CHECK_THAT(complaint("waveforms: {elbow_active_joint: {amplitude: 1, frequency: 1, period: 1}}"),
             Contains("expected one of them"));
  CHECK_THAT(complaint("waveforms: {elbow_active_joint: {amplitude: 1, frequency: 1, amp: 1}}"),
             Contains("unknown key 'amp'"));
  CHECK_THAT(complaint("waveforms:\n  - {amplitude: 1, frequency: 1}\n"),
             Contains("the key 'joint' is missing"));
  CHECK_THAT(complaint("waveforms: {elbow_active_joint: {target: position, amplitude: 1e300, "
                       "frequency: 1e5}}"),
             Contains("the acceleration is infinite"));
  CHECK_THAT(complaint("gains: {p: 1}"), Contains("the key 'waveforms' is missing"));
}

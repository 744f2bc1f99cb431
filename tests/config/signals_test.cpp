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

TEST_CASE("signals whose sum is no number are refused in the file") {
  const std::string step = "      - {type: step, target: position, height: ";
  const auto load = [&](const std::string& second) {
    return load_signals(Q2d(), yaml("waveforms:\n    elbow_active_joint:\n" + step + "1e308}\n" +
                                    step + second + "}\n"));
  };
  CHECK_NOTHROW(load("1e307"));
  CHECK_THROWS_WITH(load("1e308"), Contains("elbow_active_joint") && Contains("no number"));
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

TEST_CASE("a square has the keys of a sine, and its height is the drive's to give") {
  const std::string square = "waveforms: {elbow_active_joint: {type: square, amplitude: 2, ";
  for (const std::string rest :
       {"frequency: 0.5}}", "period: 2}}", "angular_frequency: 3.14159}}"}) {
    CHECK(sampled(square + rest, 0.9).effort[1] == 2);
    CHECK(sampled(square + rest, 1.1).effort[1] == -2);
  }
  CHECK(sampled(square + "period: 2, offset: -1}}", 1.1).effort[1] == -3);
  CHECK_THROWS_WITH(sampled(square + "period: 2, offset: 12}}", 0), Contains("an effort of 14"));
  CHECK_THROWS_WITH(sampled(square + "period: 2, duty: 0.5}}", 0),
                    Contains("unknown key 'duty', expected one of frequency, amplitude, "));
  const std::string again = "{type: square, amplitude: 7, period: 2}";
  CHECK_THROWS_WITH(
      load_signals(Q2d(), yaml("waveforms: {elbow_active_joint: [" + again + ", " + again + "]}")),
      Contains("add up to 14 "));
}

TEST_CASE("waveforms that cannot be are refused") {
  const auto complaint = [](const std::string& text) -> std::string {
    try {
      static_cast<void>(load_signals(Q2d(), yaml(text)));
    } catch (const FileError& error) {
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
             Contains("robot 'q2d' has no joint 'elbow'"));
  CHECK_THAT(
      complaint("waveforms: {elbow_active_joint: {type: sawtooth, amplitude: 1}}"),
      Contains("the word 'sawtooth', expected one of sine, sin, sinusoid, step, ramp, chirp, "
               "square"));
  CHECK_THAT(complaint("waveforms: {elbow_active_joint: {amplitude: 1}}"),
             Contains("the key 'frequency' is missing"));
  CHECK_THAT(complaint("waveforms: {elbow_active_joint: {amplitude: 1, frequency: 1, period: 1}}"),
             Contains("period: 'frequency' has the same meaning, expected one of the two keys"));
  CHECK_THAT(complaint("waveforms: {elbow_active_joint: {amplitude: 1, frequency: 1, amp: 1}}"),
             Contains("unknown key 'amp'"));
  CHECK_THAT(complaint("waveforms:\n  - {amplitude: 1, frequency: 1}\n"),
             Contains("the key 'joint' is missing"));
  CHECK_THAT(complaint("waveforms: {elbow_active_joint: {target: position, amplitude: 1e300, "
                       "frequency: 1e5}}"),
             Contains("the acceleration is infinite"));
  CHECK_THAT(complaint("gains: {p: 1}"), Contains("the key 'waveforms' is missing"));
  CHECK_THAT(complaint("waveforms: {elbow_active_joint: {joint: elbow_active_joint, amplitude: 1, "
                       "frequency: 1}}"),
             Contains("unknown key 'joint'"));
}

TEST_CASE("waveforms of one joint may not add up to more than its drive gives") {
  const auto complaint = [](const std::string& waves) -> std::string {
    try {
      static_cast<void>(load_signals(Q2d(), yaml("waveforms:\n  elbow_active_joint:\n" + waves)));
    } catch (const FileError& error) {
      return error.what();
    }
    return "none";
  };
  const std::string sine = "    - {amplitude: 10, frequency: 1}\n";
  CHECK(complaint(sine) == "none");
  CHECK(complaint(sine + sine) ==
        "test:4:7: waveforms.elbow_active_joint[1]: the signals on joint 'elbow_active_joint' add "
        "up to 20 N m or N, expected at most the drive's limit, 13.62");
  CHECK_THAT(complaint(sine + "    - {type: step, height: -4, start: 9}\n"),
             Contains("add up to 14 "));
  CHECK_THAT(complaint(sine + "    - {type: ramp, height: 4, duration: 2}\n"),
             Contains("add up to 14 "));
  CHECK_THAT(complaint(sine + "    - {type: chirp, amplitude: 4, first_frequency: 1, "
                              "last_frequency: 2, duration: 2}\n"),
             Contains("add up to 14 "));
  CHECK_THAT(complaint(sine + "    - {amplitude: 1, frequency: 1, offset: -3}\n"),
             Contains("add up to 14 "));
  // What takes itself back does not add up, and neither does what is a position.
  CHECK(complaint("    - {type: step, height: 13, start: 1}\n"
                  "    - {type: step, height: -13, start: 2}\n"
                  "    - {type: ramp, height: -13, duration: 2, start: 2}\n"
                  "    - {type: step, height: 13, start: 5}\n"
                  "    - {type: step, height: 13, start: 6}\n") == "none");
  CHECK_THAT(complaint("    - {type: step, height: 13, start: 1}\n"
                       "    - {type: step, height: 13, start: 2}\n"
                       "    - {type: step, height: -13, start: 3}\n"),
             Contains("add up to 26 "));
  CHECK(complaint(sine + "    - {amplitude: 10, frequency: 1, target: position}\n") == "none");
  CHECK(
      complaint("    - {amplitude: 6.81, frequency: 1}\n    - {amplitude: 6.81, frequency: 2}\n") ==
      "none");
}

TEST_CASE("a controller's type and joints may stand beside its waveforms") {
  const std::string wave = "amplitude: 2, frequency: 0.5";
  const auto loaded = [](const std::string& text) { return load_signals(Q2d(), yaml(text)); };
  const SignalConfig plugin =
      loaded("elbow_sine: {type: pr2_controller/Sine, joint: elbow_active_joint, " + wave + "}");
  REQUIRE(plugin.signals.size() == 1);
  CHECK(plugin.signals[0].joint.view() == "elbow_active_joint");
  REQUIRE(plugin.notes.size() == 1);
  CHECK_THAT(plugin.notes[0], Contains("elbow_sine.type: not used: a plugin's name"));

  for (const std::string key :
       {"joint: elbow_active_joint", "joint_name: elbow_active_joint",
        "joints: [elbow_active_joint]", "joints: [shoulder_active_joint, elbow_active_joint]"}) {
    INFO(key);
    CHECK(loaded("w: {" + key + ", waveforms: {elbow_active_joint: {" + wave + "}}}")
              .signals.size() == 1);
  }
  CHECK(loaded("w: {joint: elbow_active_joint, waveforms: [{" + wave + "}]}")
            .signals[0]
            .joint.view() == "elbow_active_joint");
  CHECK_THROWS_WITH(loaded("w:\n  joint: shoulder_active_joint\n"
                           "  waveforms: {elbow_active_joint: {" +
                           wave + "}}"),
                    Contains("test:3:35: w.waveforms.elbow_active_joint: joint "
                             "'elbow_active_joint' is not the section's, see line 2"));
  CHECK_THROWS_WITH(loaded("w: {joints: [elbow], waveforms: {elbow_active_joint: {" + wave + "}}}"),
                    Contains("w.joints[0]: robot 'q2d' has no joint 'elbow'"));
  CHECK_THROWS_WITH(
      loaded("w: {joint: elbow_active_joint, joints: [elbow_active_joint], waveforms: "
             "{elbow_active_joint: {" +
             wave + "}}}"),
      Contains("joints: 'joint' has the same meaning, expected one of the two keys"));
}

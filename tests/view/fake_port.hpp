// SPDX-License-Identifier: Apache-2.0
/// @file A port without a loop: two joints that follow their reference. For tests of the view.
#pragma once

#include "articula/remote/port.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

namespace support {

namespace remote = articula::remote;

/// Makes a cycle for each millisecond that passes, and answers every request at once.
class FakePort final : public remote::Port {
 public:
  FakePort() {
    const auto joint = [](const char* name) {
      remote::SheetJoint sheet{name, articula::JointType::revolute, {}};
      sheet.limits.lower = -1.5;
      sheet.limits.upper = 1.5;
      sheet.limits.velocity = 2;
      return sheet;
    };
    sheet_.name = "fake arm";
    sheet_.joints = {joint("shoulder"), joint("elbow")};
    sheet_.mimics = {{"finger", 1, -2, 0.5}};
    sheet_.links = {"base", "upper_arm", "forearm"};
    sheet_.commands = {"effort"};
    sheet_.urdf =
        "<robot name=\"fake arm\"><link name=\"base\"/><link name=\"upper_arm\"/><link "
        "name=\"forearm\"/></robot>";
    sheet_.is_simulated = true;
    parameters_ = {{"pid.shoulder.p", 10, "N m/rad", 0, 100, "Stiffness."},
                   {"pid.elbow.p", 20, "N m/rad", 0, 100, "Stiffness."}};
    situation_.motion = "rest";
    situation_.controllers = {{"pid", articula::ControllerStatus::active},
                              {"bypass", articula::ControllerStatus::inactive}};
  }

  [[nodiscard]] const remote::RobotSheet& robot() const override { return sheet_; }
  [[nodiscard]] remote::Situation situation() override {
    const std::lock_guard lock(mutex_);
    if (fails_) throw std::runtime_error("a port that fails");
    return situation_;
  }
  [[nodiscard]] std::vector<remote::LinkPose> link_poses(
      const std::vector<double>& position) const override {
    return {{"base", {0, 0, 0}, {0, 0, 0, 1}},
            {"upper_arm", {0, 0, 1}, {0, 0, std::sin(position[0] / 2), std::cos(position[0] / 2)}},
            {"forearm", {1, 0, 1}, {0, 0, std::sin(position[1] / 2), std::cos(position[1] / 2)}}};
  }
  [[nodiscard]] std::vector<remote::Parameter> parameters() override {
    const std::lock_guard lock(mutex_);
    return parameters_;
  }
  [[nodiscard]] remote::Statistics statistics() override { return {.cycles = cycles_now()}; }
  std::atomic<int> questions = 0;        ///< that were begun
  std::vector<double> answered_gains{};  ///< in their order
  remote::FuturesQuestion last_question{};
  /// Future k of the elbow goes from 0 to its proposed gain times k + 1, and the last one of
  /// several is unstable. A question of more than 5 s goes on until it is stopped.
  [[nodiscard]] remote::FuturesAnswer futures(const remote::FuturesQuestion& question) override {
    ++questions;
    while (question.options.horizon > 5 && !(question.stop && question.stop->requested())) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    double gain = 1;
    for (const remote::ParameterValue& value : question.gains) {
      if (value.name != "pid.elbow.p") {
        throw std::invalid_argument("there is no parameter '" + value.name + "'");
      }
      gain = value.value;
    }
    answered_gains.push_back(gain);
    last_question = question;
    remote::FuturesAnswer answer{.time = question.start ? question.start->time : 1,
                                 .horizon = question.options.horizon,
                                 .samples = 1};
    for (int k = 0; k < std::clamp(question.options.count, 0, 100); ++k) {
      answer.futures.push_back({articula::SimulationEnd::stable, {{0, 0}, {0, gain * (k + 1)}}});
    }
    if (answer.futures.size() > 1) answer.futures.back().end = articula::SimulationEnd::unstable;
    answer.margins = {{"pid", "elbow", true, std::numeric_limits<double>::infinity(), 1,
                       static_cast<double>(question.options.spread.delay)}};
    return answer;
  }
  [[nodiscard]] std::unique_ptr<remote::Session> connect(std::string name, bool operates) override {
    return std::make_unique<FakeSession>(*this, std::move(name), operates);
  }

  /// The sessions that are open now, the view's own included.
  [[nodiscard]] int sessions() {
    const std::lock_guard lock(mutex_);
    return sessions_;
  }
  /// Whether requests are answered.
  void answer_requests(bool answers) {
    const std::lock_guard lock(mutex_);
    answers_ = answers;
  }
  /// Whether every question for the situation fails, as a port may when memory is short.
  void fail(bool fails) {
    const std::lock_guard lock(mutex_);
    fails_ = fails;
  }
  /// The last requests that were handed over.
  [[nodiscard]] std::vector<remote::Request> requests() {
    const std::lock_guard lock(mutex_);
    return requests_;
  }
  [[nodiscard]] std::vector<double> reference() {
    const std::lock_guard lock(mutex_);
    return reference_;
  }
  /// How often a session said that its client is there.
  [[nodiscard]] int signs_of_life() {
    const std::lock_guard lock(mutex_);
    return signs_of_life_;
  }

 private:
  class FakeSession final : public remote::Session {
   public:
    FakeSession(FakePort& port, std::string name, bool operates)
        : port_(port), name_(std::move(name)), operates_(operates), next_(port.cycles_now()) {
      const std::lock_guard lock(port_.mutex_);
      ++port_.sessions_;
      events_.push_back({0, remote::Event::Level::info, name_ + " has come"});
    }
    ~FakeSession() override {
      FakeSession::release_controls();
      const std::lock_guard lock(port_.mutex_);
      --port_.sessions_;
    }
    FakeSession(const FakeSession&) = delete;
    FakeSession& operator=(const FakeSession&) = delete;

    std::string take_controls() override {
      const std::lock_guard lock(port_.mutex_);
      std::string& owner = port_.situation_.operator_name;
      if (!operates_) return "this client only watches";
      if (!owner.empty() && owner != name_) return "somebody else has the controls: " + owner;
      owner = name_;
      return {};
    }
    void release_controls() override {
      const std::lock_guard lock(port_.mutex_);
      if (port_.situation_.operator_name == name_) port_.situation_.operator_name.clear();
    }
    [[nodiscard]] bool has_controls() const override {
      const std::lock_guard lock(port_.mutex_);
      return port_.situation_.operator_name == name_;
    }
    void keep_alive() override {
      const std::lock_guard lock(port_.mutex_);
      ++port_.signs_of_life_;
    }

    std::uint64_t ask(const remote::Request& request) override {
      const std::string other =
          std::holds_alternative<remote::Stop>(request) ? "" : take_controls();
      const std::lock_guard lock(port_.mutex_);
      const std::string fault = other.empty() ? port_.take(request) : other;
      if (!port_.answers_) return ++asked_;
      const auto verdict = fault.empty() ? remote::Verdict::done : remote::Verdict::refused;
      answers_.push_back({.request = ++asked_,
                          .verdict = verdict,
                          .text = fault.empty() ? "done" : fault,
                          .cycle = fault.empty() ? 8u : 0u});
      return asked_;
    }
    std::optional<remote::Answer> answer() override { return take_first(answers_); }
    std::optional<remote::Event> event() override { return take_first(events_); }

    bool next(remote::Cycle& cycle) override {
      if (next_ >= port_.cycles_now()) return false;
      const std::vector<double> q = port_.reference(), zero(q.size());
      cycle.number = next_++;
      cycle.time = 1e-3 * static_cast<double>(cycle.number);
      cycle.position = cycle.reference_position = q;
      cycle.velocity = cycle.effort = cycle.reference_velocity = zero;
      cycle.reference_acceleration = cycle.reference_effort = zero;
      cycle.command = {q};
      cycle.latency = 1e-6;
      cycle.update = 2e-6;
      return true;
    }

   private:
    template <class Thing>
    static std::optional<Thing> take_first(std::deque<Thing>& queue) {
      if (queue.empty()) return std::nullopt;
      std::optional<Thing> first(std::move(queue.front()));
      queue.pop_front();
      return first;
    }

    FakePort& port_;
    std::string name_;
    bool operates_;
    std::uint64_t next_;
    std::uint64_t asked_ = 0;
    std::deque<remote::Answer> answers_{};
    std::deque<remote::Event> events_{};
  };

  [[nodiscard]] std::uint64_t cycles_now() const {
    const auto since = std::chrono::steady_clock::now() - start_;
    return static_cast<std::uint64_t>(
        std::chrono::duration_cast<std::chrono::milliseconds>(since).count());
  }

  /// Does what a request asks for. Returns why it does not.
  std::string take(const remote::Request& request) {
    requests_.push_back(request);
    if (requests_.size() > 100) requests_.erase(requests_.begin());
    const auto move = [&](const std::vector<remote::JointValue>& values) -> std::string {
      for (const remote::JointValue& value : values) {
        const auto joint =
            std::find_if(sheet_.joints.begin(), sheet_.joints.end(),
                         [&](const remote::SheetJoint& j) { return j.name == value.joint; });
        if (joint == sheet_.joints.end()) return "there is no joint '" + value.joint + "'";
        reference_[static_cast<std::size_t>(joint - sheet_.joints.begin())] = value.value;
      }
      return {};
    };
    if (const auto* go = std::get_if<remote::Go>(&request)) return move(go->positions);
    if (const auto* set = std::get_if<remote::SetReference>(&request)) return move(set->positions);
    if (const auto* pause = std::get_if<remote::Pause>(&request)) situation_.paused = pause->paused;
    const auto* set = std::get_if<remote::SetParameters>(&request);
    if (set == nullptr) return {};
    std::vector<remote::Parameter> changed = parameters_;
    for (const remote::ParameterValue& value : set->values) {
      const auto parameter =
          std::find_if(changed.begin(), changed.end(),
                       [&](const remote::Parameter& p) { return p.name == value.name; });
      if (parameter == changed.end()) return "there is no parameter '" + value.name + "'";
      if (value.value < parameter->lowest || value.value > parameter->highest) {
        return value.name + " is out of its range";
      }
      parameter->value = value.value;
    }
    parameters_ = std::move(changed);
    return {};
  }

  remote::RobotSheet sheet_{};
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::mutex mutex_{};
  remote::Situation situation_{};
  std::vector<remote::Parameter> parameters_{};
  std::vector<remote::Request> requests_{};
  std::vector<double> reference_{0, 0};
  int sessions_ = 0;
  int signs_of_life_ = 0;
  bool answers_ = true;
  bool fails_ = false;
};

}  // namespace support

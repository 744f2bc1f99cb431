// SPDX-License-Identifier: Apache-2.0
/// @file A port made from a loop by its types alone.
#pragma once

#include "articula/loop/loop_clock.hpp"
#include "articula/loop/run.hpp"
#include "articula/recording/cycle_record.hpp"
#include "articula/remote/engine/loop_side.hpp"
#include "articula/remote/outside.hpp"
#include "articula/remote/remote_options.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace articula::remote {

/// Offers a running loop to the outside: to browsers, terminals and other programs, by a transport
/// such as View, or by code in other threads:
///
///     SupervisedLoop<Q2dSim, PidPlusGravity> arm;
///     Remote remote(arm);
///     std::thread other([&] {
///       auto session = remote.connect("a test", true);
///       session->ask(Activate{});
///       session->ask(Go{{{"shoulder_active_joint", 0.5}}});
///     });
///     remote.run(clock);
///
/// Everything is found from the types: joints, limits and links of the robot, controllers, gains,
/// and whether it is simulated. A Remote is a loop itself. In its thread `update` takes requests,
/// makes the reference, makes the cycles of the loop and publishes them. That thread never waits
/// for another. The functions of Port and its sessions are for any other threads.
///
/// A program that computes its references itself may do so around a plain loop while nobody
/// operates. While there is a Remote, gains are changed by it alone. It outlives its sessions, and
/// the loop outlives it.
/// @tparam LoopType  a ControlLoop or SupervisedControlLoop
template <class LoopType>
class Remote final : public Port {
 public:
  using RobotType = typename LoopType::RobotType;
  using Command = typename LoopType::Command;
  static constexpr int joint_count = LoopType::joint_count;
  using Options = RemoteOptions<joint_count>;

  /// @throws std::invalid_argument if an option makes no sense, or a joint has a limit with which
  ///         nothing can move; the message names joint, value and limit
  explicit Remote(LoopType& loop, const RemoteOptions<LoopType::joint_count>& options = {})
      : loop_(loop), outside_(std::make_unique<Outside<LoopType>>(loop, options)) {}
  Remote(const Remote&) = delete;
  Remote& operator=(const Remote&) = delete;

  // For the loop's thread:

  /// One period: requests, reference, the cycles that belong to it.
  /// @return the status of the last cycle
  /// Real-time: yes, if the loop's update is.
  [[nodiscard]] Status update() noexcept { return outside_->side().update(); }
  /// Publishes the timing of a cycle: `each` calls it. Real-time: yes.
  void report(const RunReport& report) noexcept { outside_->side().report(report); }
  /// Reports periods without an update: `run` calls it. Real-time: yes.
  void missed_periods(std::uint64_t periods) noexcept { outside_->side().missed_periods(periods); }
  /// Ends control and all motions: `run` calls it. Real-time: no (the hardware may take its time).
  [[nodiscard]] Status stop() noexcept { return outside_->side().stop(); }

  /// What `run` shall do after each cycle: publish its timing. The run goes on whatever the status,
  /// since an operator may have an answer to it.
  [[nodiscard]] auto each() noexcept {
    return [](Remote& remote, const RunReport& report) noexcept {
      remote.report(report);
      return true;
    };
  }
  /// Likewise, and push a record of the last cycle: `each(stream)`. While a simulation is paused,
  /// the record repeats; while it is faster than real time, cycles have no record.
  /// @param records  a RecordStream, or another object whose `push` neither waits nor throws
  template <class Records>
  [[nodiscard]] auto each(Records& records) noexcept {
    return [&records](Remote& remote, const RunReport& report) noexcept {
      remote.report(report);
      records.push(record_of(remote, report));
      return true;
    };
  }
  /// articula::run of this loop.
  template <LoopClock Clock>
  RunReport run(Clock& clock, const RunOptions& options = {}) {
    return articula::run(*this, clock, options, each());
  }

  [[nodiscard]] LoopType& loop() noexcept { return loop_; }
  [[nodiscard]] auto& hardware() noexcept { return loop_.hardware(); }
  /// As the loop's. Real-time: yes.
  [[nodiscard]] double period() const noexcept { return loop_.period(); }
  [[nodiscard]] double time() const noexcept { return loop_.time(); }
  [[nodiscard]] const auto& state() const noexcept { return loop_.state(); }
  [[nodiscard]] const auto& reference() const noexcept { return std::as_const(loop_).reference(); }
  [[nodiscard]] const auto& command() const noexcept { return loop_.command(); }
  [[nodiscard]] const auto& followed() const noexcept { return loop_.followed(); }
  [[nodiscard]] const auto& input() const noexcept { return loop_.input(); }
  /// As the loop's. Real-time: no (allocates).
  [[nodiscard]] std::vector<std::string> notices() const { return loop_.notices(); }

  // For any thread:

  [[nodiscard]] const RobotSheet& robot() const override { return outside_->sheet(); }
  [[nodiscard]] Situation situation() override { return outside_->situation(); }
  [[nodiscard]] std::vector<LinkPose> link_poses(
      const std::vector<double>& position) const override {
    return link_poses_of(std::as_const(loop_).hardware().robot(), position);
  }
  [[nodiscard]] std::vector<std::optional<JointMotion>> planned(double time) override {
    return outside_->planned(time);
  }
  [[nodiscard]] std::vector<Parameter> parameters() override { return outside_->parameters(); }
  [[nodiscard]] Statistics statistics() override { return outside_->statistics(); }
  [[nodiscard]] FuturesAnswer futures(const FuturesQuestion& question) override {
    return outside_->futures(question);
  }
  [[nodiscard]] std::unique_ptr<Session> connect(std::string name, bool operates) override {
    return std::make_unique<Client>(*outside_, std::move(name), operates);
  }

 private:
  /// A session: its number, under which the outside knows the rest.
  class Client final : public Session {
   public:
    Client(Outside<LoopType>& outside, std::string name, bool operates)
        : outside_(outside), id_(outside.connect(std::move(name), operates)) {}
    ~Client() override { outside_.disconnect(id_); }
    Client(const Client&) = delete;
    Client& operator=(const Client&) = delete;

    std::string take_controls() override { return outside_.take_controls(id_); }
    void release_controls() override { outside_.release_controls(id_); }
    [[nodiscard]] bool has_controls() const override { return outside_.has_controls(id_); }
    void keep_alive() override { outside_.keep_alive(id_); }
    std::uint64_t ask(const Request& request) override { return outside_.ask(id_, request); }
    [[nodiscard]] std::optional<Answer> answer() override { return outside_.answer(id_); }
    [[nodiscard]] bool next(Cycle& cycle) override { return outside_.next(id_, cycle); }
    [[nodiscard]] std::optional<Event> event() override { return outside_.event(id_); }

   private:
    Outside<LoopType>& outside_;
    std::uint64_t id_;
  };

  LoopType& loop_;
  std::unique_ptr<Outside<LoopType>> outside_;
};

}  // namespace articula::remote

namespace articula {
using remote::Remote;
}  // namespace articula

// SPDX-License-Identifier: Apache-2.0
/// @file A control loop under supervision.
#pragma once

#include "articula/loop/control_loop.hpp"
#include "articula/loop/cycle_input.hpp"
#include "articula/loop/exchange/latest_value.hpp"
#include "articula/loop/supervision/loop_mode.hpp"
#include "articula/loop/supervision/overrun_counter.hpp"
#include "articula/loop/supervision/supervised_hardware.hpp"
#include "articula/loop/supervision/supervision_options.hpp"

#include <atomic>
#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace articula {

/// A ControlLoop under supervision:
///
///     inactive --request_activation--> starting --good state--> active --too much--> fault
///        ^---------- request_deactivation -------------------------'                   |
///        ^----------------------------- acknowledge_fault -----------------------------'
///
/// Nothing moves before activation. At activation the controller starts and the reference is the
/// measured position, so nothing jumps. References come through `post`, from one other thread if
/// need be. Those that come while the loop is not active are dropped and never used later. What is
/// a fault, and what the joints do then, is in SupervisionOptions; docs/realtime.md has a table.
///
/// It is a layer around ControlLoop, which does not depend on it. It stays where it was made.
/// @tparam HardwareType  satisfies Hardware
/// @tparam C             satisfies Controller
template <class HardwareType, class C>
class SupervisedControlLoop {
 public:
  using RobotType = typename HardwareType::RobotType;
  using ControllerType = C;
  static constexpr int joint_count = articula::joint_count<RobotType>;
  using State = JointState<joint_count>;
  using Reference = JointReference<joint_count>;
  using Command = typename ControlLoop<HardwareType, C>::Command;

  /// Default hardware and controller.
  explicit SupervisedControlLoop(const SupervisionOptions& options = {})
    requires std::default_initializable<HardwareType>
      : SupervisedControlLoop(HardwareType(), detail::default_controller<C>(), options) {}

  /// Given hardware under the default controller.
  explicit SupervisedControlLoop(HardwareType hardware, const SupervisionOptions& options = {})
      : SupervisedControlLoop(std::move(hardware), detail::default_controller<C>(), options) {}

  /// Does not activate the hardware.
  /// @param hardware    the joints
  /// @param controller  with its gains
  /// @param options     what is tolerated
  /// @param period      as Loop's
  /// @throws std::invalid_argument if the period or an option makes no sense
  SupervisedControlLoop(HardwareType hardware, C controller, const SupervisionOptions& options = {},
                        std::optional<double> period = {})
      : options_(options),
        loop_(Gate(std::move(hardware), options), std::move(controller), period),
        overruns_(options.overruns, loop_.period()) {
    validate(options, loop_.period());
  }

  /// Active hardware is stopped.
  ~SupervisedControlLoop() { static_cast<void>(stop()); }
  SupervisedControlLoop(const SupervisedControlLoop&) = delete;
  SupervisedControlLoop& operator=(const SupervisedControlLoop&) = delete;

  /// One cycle.
  /// @return Status::ok, or what is wrong with this cycle; in a fault its cause; Status::inactive
  ///         while inactive or starting
  /// Real-time: yes, if the hardware's read and write are. The exceptions are the cycles that
  /// activate or deactivate the hardware on request. They take as long as it does.
  [[nodiscard]] Status update() noexcept {
    input_ = std::exchange(next_input_, {});
    obey_request();
    take_reference();
    const Status status = loop_.update();
    overruns_.note_cycle();
    input_.read = gate().verdict();
    input_.write = loop_.input().write;
    if (mode_ == LoopMode::starting) return start();
    if (mode_ == LoopMode::active) {
      bad_cycles_ = status == Status::ok ? 0 : bad_cycles_ + 1;
      if (bad_cycles_ > options_.bad_cycles) fail(status);
      taking_references_ = taking_references_ || status == Status::ok;
      return status;
    }
    if (mode_ == LoopMode::inactive) return Status::inactive;
    // A controller that was trusted to hold, and cannot, is trusted no longer.
    if (status != Status::ok && gate().passage() == Passage::command) {
      gate().open(Passage::behaviour, Status::inactive);
    }
    return fault();
  }

  /// Asks for activation: if the loop is inactive, it starts with the next update. From any thread.
  /// Real-time: yes.
  void request_activation() noexcept { request_.store(Request::activation); }
  /// Asks for deactivation: if the loop is starting or active, it stops with the next update. From
  /// any thread. Real-time: yes.
  void request_deactivation() noexcept { request_.store(Request::deactivation); }
  /// Lets a loop in fault go inactive with the next update. From any thread. Real-time: yes.
  void acknowledge_fault() noexcept { request_.store(Request::acknowledgement); }

  /// Posts what the joints shall do from the next update on. From one thread, any one; or by
  /// several that take turns.
  /// Real-time: yes. Wait-free.
  void post(const Reference& reference) noexcept { posted_.write(reference); }

  /// Reports periods without an update: `run` calls it. In the loop's thread. Real-time: yes.
  void missed_periods(std::uint64_t periods) noexcept {
    ++next_input_.overruns;
    next_input_.missed += periods;
    reference_age_ += static_cast<double>(periods) * loop_.period();
    if (mode_ == LoopMode::active && overruns_.note_overrun()) fail(Status::overrun);
  }

  /// Ends control: a last safe command, then the hardware is deactivated. In the loop's thread.
  /// @return the first thing that went wrong
  /// Real-time: no (deactivation may take its time).
  [[nodiscard]] Status stop() noexcept {
    if (mode_ == LoopMode::inactive) return Status::ok;
    if (gate().passage() != Passage::closed) {
      gate().open(Passage::behaviour, Status::inactive);
      static_cast<void>(loop_.update());
    }
    enter(LoopMode::inactive, Passage::closed, Status::inactive);
    return gate().hardware().deactivate();
  }

  /// From any thread. Real-time: yes.
  [[nodiscard]] LoopMode mode() const noexcept { return shared_mode_.load(); }
  /// What the last fault was; Status::ok before the first. From any thread. Real-time: yes.
  [[nodiscard]] Status fault() const noexcept { return fault_.load(); }
  /// What the joints are asked to do. Real-time: yes.
  [[nodiscard]] const Reference& reference() const noexcept { return loop_.reference(); }
  /// The reference of the last update, from which the controller made its command: after a fault,
  /// reference() is another. Real-time: yes.
  [[nodiscard]] const Reference& followed() const noexcept { return loop_.followed(); }
  /// What else came into the last update. Real-time: yes.
  [[nodiscard]] const CycleInput& input() const noexcept { return input_; }
  /// What was measured at the beginning of the last update. Real-time: yes.
  [[nodiscard]] const State& state() const noexcept { return loop_.state(); }
  /// What was written last. Real-time: yes.
  [[nodiscard]] const Command& command() const noexcept { return gate().written(); }
  /// As Loop's. Real-time: yes.
  [[nodiscard]] double time() const noexcept { return loop_.time(); }
  [[nodiscard]] double period() const noexcept { return loop_.period(); }
  /// As Loop's. Real-time: no (allocates).
  [[nodiscard]] std::vector<std::string> notices() const { return loop_.notices(); }
  [[nodiscard]] C& controller() noexcept { return loop_.controller(); }
  [[nodiscard]] const C& controller() const noexcept { return loop_.controller(); }
  [[nodiscard]] HardwareType& hardware() noexcept { return gate().hardware(); }
  [[nodiscard]] const HardwareType& hardware() const noexcept { return gate().hardware(); }

 private:
  using Gate = SupervisedHardware<HardwareType, Command>;
  using Request = LoopRequest;

  [[nodiscard]] Gate& gate() noexcept { return loop_.hardware(); }
  [[nodiscard]] const Gate& gate() const noexcept { return loop_.hardware(); }

  void enter(LoopMode mode, Passage passage, Status answer) noexcept {
    mode_ = mode;
    shared_mode_.store(mode);
    taking_references_ = false;
    bad_cycles_ = 0;
    gate().open(passage, answer);
  }

  void obey_request() noexcept {
    const Request request = request_.exchange(Request::none);
    input_.request = request;
    const bool inactive = mode_ == LoopMode::inactive, faulty = mode_ == LoopMode::fault;
    if (request == Request::activation && inactive) {
      input_.change = gate().hardware().activate();
      if (input_.change != Status::ok) return fail_closed();
      waited_ = 0;
      overruns_.start();
      enter(LoopMode::starting, Passage::command, Status::inactive);
    } else if ((request == Request::deactivation && !inactive && !faulty) ||
               (request == Request::acknowledgement && faulty)) {
      input_.change = stop();
      if (input_.change != Status::ok) fail_closed();
    }
  }

  /// After a cycle with a good state: the controller starts from there, in the next one.
  [[nodiscard]] Status start() noexcept {
    if (gate().verdict() == Status::ok) {
      hold_here();
      start_controller(loop_.controller(),
                       ControlInput<joint_count>{loop_.state(), loop_.reference(), loop_.period()});
      reference_age_ = 0;
      enter(LoopMode::active, Passage::command, Status::ok);
    } else if ((waited_ += loop_.period()) > options_.start_time) {
      fail(gate().verdict());
    }
    return Status::inactive;
  }

  void take_reference() noexcept {
    const bool posted = posted_.update();  // also where it is not used, so that it is gone
    input_.posted = posted;
    if (mode_ != LoopMode::active) return;
    reference_age_ += loop_.period();
    if (posted && taking_references_) {
      loop_.reference() = posted_.value();
      reference_age_ = 0;
    }
    if (reference_age_ > options_.reference_lifetime) fail(Status::stale_reference);
  }

  void fail(Status cause) noexcept {
    fault_.store(cause);
    const bool controller_is_trusted = cause == Status::stale_reference ||
                                       cause == Status::non_finite_reference ||
                                       cause == Status::overrun;
    hold_here();
    // Damping knows no limits of position. A controller that keeps them brakes as it should.
    const bool holds = options_.behaviour == SafeBehaviour::hold ||
                       (options_.behaviour == SafeBehaviour::damp && Brakes<C, joint_count>);
    if (holds && controller_is_trusted) {
      enter(LoopMode::fault, Passage::command, Status::ok);
    } else {
      enter(LoopMode::fault, Passage::behaviour, Status::inactive);
    }
  }

  /// Hardware that does not follow a change of mode is written nothing any more.
  void fail_closed() noexcept {
    fault_.store(Status::hardware_fault);
    enter(LoopMode::fault, Passage::closed, Status::inactive);
  }

  void hold_here() noexcept {
    loop_.reference() = {};
    if (is_finite(loop_.state().position)) loop_.reference().position = loop_.state().position;
  }

  SupervisionOptions options_;
  ControlLoop<Gate, C> loop_;
  LoopMode mode_ = LoopMode::inactive;
  CycleInput input_{}, next_input_{};
  int bad_cycles_ = 0;
  OverrunCounter overruns_;
  double waited_ = 0;         ///< [s]
  double reference_age_ = 0;  ///< [s]
  bool taking_references_ = false;
  std::atomic<Request> request_ = Request::none;
  std::atomic<LoopMode> shared_mode_ = LoopMode::inactive;
  std::atomic<Status> fault_ = Status::ok;
  LatestValue<Reference> posted_;
};

}  // namespace articula

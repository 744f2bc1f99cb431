// SPDX-License-Identifier: Apache-2.0
#include "articula/ros2/bridge/manager_services.hpp"

#include "articula/ros2/messages/controller_manager_msgs.hpp"
#include "articula/ros2/messages/monitoring/diagnostic_msgs.hpp"
#include "articula/ros2/node/periodic.hpp"
#include "articula/ros2/node/publisher.hpp"
#include "articula/ros2/node/service.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace articula::ros2 {

namespace {

namespace msg = controller_manager_msgs::msg;
namespace srv = controller_manager_msgs::srv;
using Names = std::vector<std::string>;
using State = lifecycle_msgs::msg::State<Jazzy>;

bool contains(const Names& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

void set_number(Absent&, int) {}
void set_number(std::uint16_t& field, int number) { field = static_cast<std::uint16_t>(number); }
void set_text(Absent&, std::string_view) {}
void set_text(std::string& field, std::string_view text) { field = text; }

/// Names of a joint's interfaces.
Names interfaces(const Names& joints, const Names& quantities) {
  Names all;
  for (const std::string& joint : joints) {
    for (const std::string& quantity : quantities) all.push_back(joint + "/" + quantity);
  }
  return all;
}

template <class Layout>
class Services final : public ManagerServices {
 public:
  explicit Services(BridgeCore& core)
      : core_(core), diagnostics_(core.manager, "/diagnostics", quality_of_service::states) {
    if constexpr (Layout::distribution >= Distribution::jazzy) {
      activity_.emplace(core.manager, "~/activity", quality_of_service::activity);
    }
    for (const remote::SheetJoint& joint : core.port.robot().joints) joints_.push_back(joint.name);
    on<srv::ListControllers<Layout>>("list_controllers", [this](const auto&) {
      typename srv::ListControllers<Layout>::Response response;
      response.controller = controllers();
      return response;
    });
    on<srv::ListControllerTypes<Jazzy>>("list_controller_types",
                                        [this](const auto&) { return controller_types(); });
    on<srv::ListHardwareComponents<Layout>>("list_hardware_components", [this](const auto&) {
      typename srv::ListHardwareComponents<Layout>::Response response;
      response.component = {component()};
      return response;
    });
    on<srv::ListHardwareInterfaces<Layout>>("list_hardware_interfaces", [this](const auto&) {
      const auto own = component();
      typename srv::ListHardwareInterfaces<Layout>::Response response;
      response.command_interfaces = own.command_interfaces;
      response.state_interfaces = own.state_interfaces;
      return response;
    });
    serve_loading();
    serve<srv::SwitchController<Layout>>(
        core.manager, "~/switch_controller",
        [this](const auto& request, const auto& reply) { switch_controllers(request, reply); });
    serve<srv::SetHardwareComponentState<Jazzy>>(
        core.manager, "~/set_hardware_component_state",
        [this](const auto& request, const auto& reply) { set_hardware(request, reply); });
  }

  void update() override {
    publish_activity();
    if (!second_.due(core_.context.wall)) return;
    const remote::Statistics statistics = core_.port.statistics();
    const auto micro = [](double seconds) { return std::to_string(std::lround(seconds * 1e6)); };
    const bool fault = core_.watch.situation.mode == LoopMode::fault;
    diagnostics_.publish(
        {.header = core_.header(),
         .status = {{.level = std::byte(fault ? 2 : 0),
                     .name = core_.manager.name().substr(1) + ": loop",
                     .message = std::string(fault ? to_string(core_.watch.situation.fault)
                                                  : to_string(core_.watch.situation.mode)),
                     .hardware_id = core_.port.robot().name,
                     .values = {{"cycles", std::to_string(statistics.cycles)},
                                {"overruns", std::to_string(statistics.overruns)},
                                {"latency 99 % [us]", micro(statistics.latency_99)},
                                {"latency max [us]", micro(statistics.latency_max)},
                                {"execution 99 % [us]", micro(statistics.execution_99)},
                                {"execution max [us]", micro(statistics.execution_max)}}}}});
  }

 private:
  template <class Service, class Answer>
  void on(std::string_view name, Answer answer) {
    serve<Service>(core_.manager, "~/" + std::string(name),
                   [answer = std::move(answer)](const auto& request, const auto& reply) {
                     reply.send(answer(request));
                   });
  }

  void refuse(const std::string& text) { core_.log.refuse("controller_manager", text); }

  // Controllers:

  [[nodiscard]] bool is_active(std::string_view name) const {
    return name == BridgeCore::broadcaster ? core_.broadcasts : core_.watch.is_active(name);
  }
  [[nodiscard]] Names names() const {
    Names all{BridgeCore::broadcaster};
    for (const BridgedController& own : core_.controllers) all.push_back(own.name);
    return all;
  }
  [[nodiscard]] std::string no_such(const std::string& name) const {
    std::string text = "there is no controller '" + name + "'; the loop has ";
    for (const std::string& own : names()) text += (text.back() == ' ' ? "" : ", ") + own;
    return text;
  }

  [[nodiscard]] std::vector<msg::ControllerState<Layout>> controllers() const {
    std::vector<msg::ControllerState<Layout>> all;
    const auto add = [&](const std::string& name, const std::string& type, const Names& joints,
                         Names claims) {
      msg::ControllerState<Layout> own;
      own.name = name;
      own.type = type;
      own.state = is_active(name) ? "active" : "inactive";
      set_number(own.update_rate, rate());
      if (is_active(name)) own.claimed_interfaces = claims;
      own.required_command_interfaces = std::move(claims);
      own.required_state_interfaces = interfaces(joints, {"position", "velocity", "effort"});
      all.push_back(std::move(own));
    };
    add(BridgeCore::broadcaster, BridgeCore::broadcaster_type, joints_, {});
    for (const BridgedController& own : core_.controllers) {
      add(own.name, own.type, own.joints, interfaces(own.joints, core_.port.robot().commands));
    }
    return all;
  }

  [[nodiscard]] int rate() const {
    return static_cast<int>(std::clamp(1 / core_.port.robot().period, 1.0, 65535.0));
  }

  [[nodiscard]] auto controller_types() const {
    srv::ListControllerTypes<Jazzy>::Response response;
    for (const auto& own : controllers()) {
      if (contains(response.types, own.type)) continue;
      response.types.push_back(own.type);
      response.base_classes.emplace_back("controller_interface::ControllerInterface");
    }
    return response;
  }

  void serve_loading() {
    const auto answer = [this]<class Service>(std::string_view name, TypeOf<Service>,
                                              std::string refusal) {
      on<Service>(name, [this, refusal, name](const auto& request) {
        const bool known = contains(names(), request.name);
        if (!known) {
          refuse(std::string(name) + ": " + no_such(request.name));
        } else if (!refusal.empty()) {
          refuse(std::string(name) + ": '" + request.name + "' " + refusal);
        }
        typename Service::Response response;
        response.ok = known && refusal.empty();
        return response;
      });
    };
    answer("load_controller", TypeOf<srv::LoadController<Jazzy>>(), "");
    answer("configure_controller", TypeOf<srv::ConfigureController<Jazzy>>(), "");
    answer("unload_controller", TypeOf<srv::UnloadController<Jazzy>>(),
           "is compiled into the loop, which cannot unload it");
    if constexpr (Layout::distribution >= Distribution::jazzy) {
      answer("cleanup_controller", TypeOf<srv::CleanupController<Jazzy>>(),
             "is compiled into the loop and always configured");
    }
    on<srv::ReloadControllerLibraries<Jazzy>>("reload_controller_libraries", [this](const auto&) {
      refuse("reload_controller_libraries: the controllers are compiled into the loop");
      return srv::ReloadControllerLibraries<Jazzy>::Response{};
    });
  }

  void switch_controllers(const typename srv::SwitchController<Layout>::Request& request,
                          const Reply<srv::SwitchController<Layout>>& reply) {
    remote::SwitchControllers wanted{.start = request.activate_controllers,
                                     .stop = request.deactivate_controllers};
    if constexpr (Layout::distribution == Distribution::humble) {
      for (const auto& name : request.start_controllers) wanted.start.push_back(name);
      for (const auto& name : request.stop_controllers) wanted.stop.push_back(name);
    }
    for (Names* const names : {&wanted.start, &wanted.stop}) *names = without_repeats(*names);
    // A part that best effort leaves out is in the log, also where the rest is done.
    const auto answer = [this, reply](bool ok, const std::string& text) {
      const std::string line = "switch_controller: " + text;
      if (!ok) refuse(line);
      if (ok && !text.empty()) core_.log.write(RosLog::Line::warn, "controller_manager", line);
      typename srv::SwitchController<Layout>::Response response;
      response.ok = ok;
      set_text(response.message, text.empty() ? "Successfully switched controllers!" : text);
      reply.send(response);
    };
    constexpr int best_effort = 1, force_automatic = 4;
    const int strictness = request.strictness == 0 ? best_effort : request.strictness;
    if (strictness < best_effort || strictness > force_automatic) {
      return answer(false, "strictness " + std::to_string(strictness) +
                               " is not 1 (best effort), 2 (strict), 3 (auto) or 4 (force auto)");
    }
    wanted.best_effort = strictness == best_effort;
    wanted.replace = strictness == force_automatic;
    // The broadcaster is not the loop's.
    const bool begin = take(wanted.start, BridgeCore::broadcaster);
    const bool end = take(wanted.stop, BridgeCore::broadcaster);
    const std::string left_out = end && !core_.broadcasts            ? not_done(": not active")
                                 : begin && !end && core_.broadcasts ? not_done(": already active")
                                                                     : "";
    if (!wanted.best_effort && !left_out.empty()) return answer(false, left_out);
    const auto broadcast = [this, begin, end] {
      core_.broadcasts = (core_.broadcasts && !end) || begin;
    };
    if (wanted.start.empty() && wanted.stop.empty()) {
      const std::string refusal = core_.loop_operator.session().take_controls();
      if (!refusal.empty()) return answer(false, refusal);
      broadcast();
      return answer(true, left_out);
    }
    if (core_.watch.situation.mode != LoopMode::active) {
      return answer(false,
                    "the hardware is not active: ros2 control set_hardware_component_state " +
                        core_.port.robot().name + " active");
    }
    core_.loop_operator.ask(
        wanted, [this, answer, broadcast, left_out, wanted](const remote::Answer& own) {
          if (own.verdict != remote::Verdict::done) {
            // A loop without a Switch refuses also to start what it runs.
            if (!wanted.best_effort || !is_done(wanted)) return answer(false, own.text);
            return broadcast(), answer(true, own.text);
          }
          broadcast();
          const std::string text = own.text.empty() ? left_out : own.text;
          core_.watch.situation = core_.port.situation();
          // As in ros2_control, an unknown name is no failure, and joints that are taken are one.
          for (const std::string& name : wanted.start) {
            if (!contains(names(), name) || core_.watch.runs(name)) continue;
            return answer(false, "Could not activate controller : '" + name + "': " + text);
          }
          answer(true, text);
        });
  }

  /// Whether all that shall start is active, and nothing shall stop.
  [[nodiscard]] bool is_done(const remote::SwitchControllers& wanted) const {
    return wanted.stop.empty() && std::ranges::all_of(wanted.start, [this](const auto& name) {
             return core_.watch.is_active(name);
           });
  }
  static std::string not_done(const char* what) {
    return std::string("controller '") + BridgeCore::broadcaster + "'" + what;
  }
  /// Each name once, in the same order.
  static Names without_repeats(const Names& names) {
    Names once;
    for (const std::string& name : names) {
      if (!contains(once, name)) once.push_back(name);
    }
    return once;
  }
  /// Removes a name.
  static bool take(Names& names, std::string_view name) { return std::erase(names, name) > 0; }

  // Hardware:

  [[nodiscard]] State hardware_state() const {
    switch (core_.watch.situation.mode) {
      case LoopMode::inactive:
        return {State::inactive, "inactive"};
      case LoopMode::fault:
        return {State::unconfigured, "unconfigured"};
      case LoopMode::starting:
      case LoopMode::active:
        break;
    }
    return {State::active, "active"};
  }

  [[nodiscard]] msg::HardwareComponentState<Layout> component() const {
    const remote::RobotSheet& robot = core_.port.robot();
    const bool available = core_.watch.situation.mode != LoopMode::fault;
    Names claimed;
    for (const auto& own : controllers()) {
      claimed.insert(claimed.end(), own.claimed_interfaces.begin(), own.claimed_interfaces.end());
    }
    const auto interface = [&](const std::string& name) {
      msg::HardwareInterface<Layout> own;
      own.name = name;
      set_text(own.data_type, "double");
      own.is_available = available;
      own.is_claimed = contains(claimed, name);
      return own;
    };
    msg::HardwareComponentState<Layout> own;
    own.name = robot.name;
    own.type = "system";
    set_number(own.rw_rate, rate());
    set_text(own.class_type, "articula/" + robot.name);
    set_text(own.plugin_name, "articula/" + robot.name);
    const State state = hardware_state();
    own.state.id = state.id;
    own.state.label = state.label;
    for (const std::string& name : interfaces(joints_, robot.commands)) {
      own.command_interfaces.push_back(interface(name));
    }
    for (const std::string& name : interfaces(joints_, {"position", "velocity", "effort"})) {
      own.state_interfaces.push_back(interface(name));
      own.state_interfaces.back().is_claimed = false;
    }
    return own;
  }

  void set_hardware(const srv::SetHardwareComponentState<Jazzy>::Request& request,
                    const Reply<srv::SetHardwareComponentState<Jazzy>>& reply) {
    const auto answer = [this, reply](bool ok, const std::string& text) {
      if (!ok) refuse("set_hardware_component_state: " + text);
      core_.watch.situation = core_.port.situation();
      srv::SetHardwareComponentState<Jazzy>::Response response;
      response.ok = ok;
      const State state = hardware_state();
      response.state.id = state.id;
      response.state.label = state.label;
      reply.send(response);
    };
    const std::string& name = core_.port.robot().name;
    if (request.name != name) {
      refuse("set_hardware_component_state: there is no hardware '" + request.name + "'; it is '" +
             name + "'");
      return reply.send({});  // of unknown state, as in ros2_control
    }
    const std::uint8_t id = request.target_state.id;
    const std::string& label = request.target_state.label;
    const auto is = [&](std::uint8_t own,
                        std::string_view text) {  // as the label says, if there is one
      return label.empty() ? id == own : label == text;
    };
    const bool activates = is(State::active, "active");
    if (!activates && !is(State::inactive, "inactive")) {
      return answer(false, "'" + name + "' can be made inactive or active, not '" +
                               (label.empty() ? std::to_string(id) : label) + "'");
    }
    const LoopMode mode = core_.watch.situation.mode;
    if (hardware_state().label == (activates ? "active" : "inactive")) return answer(true, "");
    const auto last = [answer](const remote::Answer& own) {
      answer(own.verdict == remote::Verdict::done, own.text);
    };
    if (mode == LoopMode::fault) {
      core_.loop_operator.ask(remote::AcknowledgeFault{},
                              [this, activates, last](const remote::Answer& own) {
                                if (!activates || own.verdict != remote::Verdict::done)
                                  return last(own);
                                core_.loop_operator.ask(remote::Activate{}, last);
                              });
    } else if (activates) {
      core_.loop_operator.ask(remote::Activate{}, last);
    } else {
      core_.loop_operator.ask(remote::Deactivate{}, last);
    }
  }

  void publish_activity() {
    if (!activity_) return;
    Activity now;
    const auto named = [](const std::string& name, const State& state) {
      msg::NamedLifecycleState<Jazzy> own;
      own.name = name;
      own.state = state;
      return own;
    };
    std::string text;
    for (const std::string& name : names()) {
      const bool active = is_active(name);
      now.controllers.push_back(named(
          name, active ? State{State::active, "active"} : State{State::inactive, "inactive"}));
      text += active ? '1' : '0';
    }
    now.hardware_components = {named(core_.port.robot().name, hardware_state())};
    text += hardware_state().label;
    if (text == published_) return;
    published_ = text;
    now.header = core_.header();
    activity_->publish(now);
  }

  using Activity = msg::ControllerManagerActivity<Jazzy>;

  BridgeCore& core_;
  Names joints_{};
  std::optional<Publisher<Activity>> activity_{};
  Publisher<diagnostic_msgs::msg::DiagnosticArray<Jazzy>> diagnostics_;
  Periodic second_{1};
  std::string published_{};  ///< the last activity, in short
};

}  // namespace

std::unique_ptr<ManagerServices> make_manager_services(BridgeCore& core) {
  switch (core.options.distribution) {
    case Distribution::humble:
      return std::make_unique<Services<Humble>>(core);
    case Distribution::jazzy:
      break;
    case Distribution::rolling:
      return std::make_unique<Services<Rolling>>(core);
  }
  return std::make_unique<Services<Jazzy>>(core);
}

}  // namespace articula::ros2

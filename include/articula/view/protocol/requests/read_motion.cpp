// SPDX-License-Identifier: Apache-2.0
#include "articula/view/protocol/requests/read_motion.hpp"

#include <cstddef>
#include <optional>
#include <utility>

namespace articula::view {

namespace {

constexpr std::array point_members{
    Member{"positions", Kind::numbers}, Member{"velocities", Kind::numbers},
    Member{"accelerations", Kind::numbers}, Member{"effort", Kind::numbers},
    Member{"time_from_start", Kind::duration, true}};

constexpr Member joint_member{"joint", Kind::text, true}, kind_member{"kind", Kind::text, true},
    target_member{"target", Kind::text};
constexpr std::array step_signal_members{joint_member, kind_member, target_member,
                                         Member{"height", Kind::number, true},
                                         Member{"start", Kind::number}};
constexpr std::array ramp_members{joint_member,
                                  kind_member,
                                  target_member,
                                  Member{"height", Kind::number, true},
                                  Member{"duration", Kind::number},
                                  Member{"start", Kind::number}};
constexpr std::array wave_members{joint_member,
                                  kind_member,
                                  target_member,
                                  Member{"amplitude", Kind::number, true},
                                  Member{"frequency", Kind::number, true},
                                  Member{"phase", Kind::number},
                                  Member{"offset", Kind::number}};
constexpr std::array chirp_members{joint_member,
                                   kind_member,
                                   target_member,
                                   Member{"amplitude", Kind::number, true},
                                   Member{"first_frequency", Kind::number, true},
                                   Member{"last_frequency", Kind::number, true},
                                   Member{"duration", Kind::number, true},
                                   Member{"start", Kind::number}};

double seconds(const Json& duration) {
  if (duration.is_number()) return duration.get<double>();
  const double nanoseconds = duration.value("nanosec", 0.0) + duration.value("nsec", 0.0);
  return duration.value("sec", 0.0) + 1e-9 * nanoseconds;
}

double number_or(const Json& object, const char* member, double otherwise) {
  return object.value(member, otherwise);
}

template <class Wave>
Signal wave(const Json& json) {
  return Wave{number_or(json, "amplitude", 0), number_or(json, "frequency", 0),
              number_or(json, "phase", 0), number_or(json, "offset", 0)};
}

/// A kind of signal: its name, the members of its JSON, and how to read them.
struct SignalKind {
  std::string_view name{};
  std::span<const Member> members{};
  Signal (*read)(const Json&) = nullptr;
};

const std::array signal_kinds{
    SignalKind{"step", step_signal_members,
               [](const Json& x) -> Signal {
                 return StepSignal{number_or(x, "height", 0), number_or(x, "start", 0)};
               }},
    SignalKind{"ramp", ramp_members,
               [](const Json& x) -> Signal {
                 return RampSignal{number_or(x, "height", 0), number_or(x, "duration", 1),
                                   number_or(x, "start", 0)};
               }},
    SignalKind{"sine", wave_members, wave<SineSignal>},
    SignalKind{"square", wave_members, wave<SquareSignal>},
    SignalKind{"chirp", chirp_members,
               [](const Json& x) -> Signal {
                 return ChirpSignal{number_or(x, "amplitude", 0),
                                    number_or(x, "first_frequency", 1),
                                    number_or(x, "last_frequency", 1), number_or(x, "duration", 1),
                                    number_or(x, "start", 0)};
               }},
};

std::optional<std::string> text_of(const Json& object, const char* member) {
  const auto found = object.find(member);
  if (found == object.end() || !found->is_string()) return std::nullopt;
  return found->get<std::string>();
}

std::variant<Refusal, remote::NamedSignal> read_signal(const Json& json, const std::string& place) {
  const auto kind = text_of(json, "kind");
  for (const SignalKind& known : signal_kinds) {
    if (kind != known.name) continue;
    if (std::string fault = fault_of(json, known.members, place); !fault.empty()) {
      return Refusal{std::move(fault)};
    }
    const std::string target = json.value("target", "position");
    if (target != "position" && target != "effort") {
      return Refusal{place + "target: expected \"position\" or \"effort\""};
    }
    return remote::NamedSignal{json.at("joint").get<std::string>(), known.read(json),
                               target == "effort" ? SignalTarget::effort : SignalTarget::position};
  }
  return Refusal{place + "kind: expected \"step\", \"ramp\", \"sine\", \"square\" or \"chirp\""};
}

}  // namespace

std::vector<remote::JointValue> joint_values(const Json& object, const char* member) {
  std::vector<remote::JointValue> values;
  const auto found = object.find(member);
  if (found == object.end()) return values;
  for (const auto& [joint, value] : found->items()) values.push_back({joint, value.get<double>()});
  return values;
}

Asked read_trajectory(const Json& message) {
  remote::PlayTrajectory request;
  request.trajectory.joint_names = message.at("joint_names").get<std::vector<std::string>>();
  std::size_t index = 0;
  for (const Json& point : message.at("points")) {
    const std::string place = "points[" + std::to_string(index++) + "].";
    if (std::string fault = fault_of(point, point_members, place); !fault.empty()) {
      return Refusal{std::move(fault)};
    }
    request.trajectory.points.push_back(
        {seconds(point.at("time_from_start")), numbers_of(point, "positions"),
         numbers_of(point, "velocities"), numbers_of(point, "accelerations"),
         numbers_of(point, "effort")});
  }
  return remote::Request(std::move(request));
}

Asked read_signals(const Json& call) {
  remote::PlaySignals request{{}, call.at("duration").get<double>()};
  std::size_t index = 0;
  for (const Json& signal : call.at("signals")) {
    auto read = read_signal(signal, "signals[" + std::to_string(index++) + "].");
    if (auto* refusal = std::get_if<Refusal>(&read)) return std::move(*refusal);
    request.signals.push_back(std::get<remote::NamedSignal>(std::move(read)));
  }
  return remote::Request(std::move(request));
}

Asked read_published_reference(const Json& message) {
  const auto names = message.at("name").get<std::vector<std::string>>();
  remote::SetReference request;
  for (const auto& [member, target] :
       {std::pair{"position", &request.positions}, std::pair{"velocity", &request.velocities},
        std::pair{"effort", &request.efforts}}) {
    const auto values = numbers_of(message, member);
    if (values.empty()) continue;
    if (values.size() != names.size()) {
      return Refusal{std::string(member) + ": has " + std::to_string(values.size()) +
                     " numbers; expected none, or one for each of " + std::to_string(names.size()) +
                     " names"};
    }
    for (std::size_t i = 0; i < names.size(); ++i) target->push_back({names[i], values[i]});
  }
  return remote::Request(std::move(request));
}

}  // namespace articula::view

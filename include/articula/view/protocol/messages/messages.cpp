// SPDX-License-Identifier: Apache-2.0
#include "articula/view/protocol/messages/messages.hpp"

#include "articula/model/joint_type_name.hpp"

#include <cmath>

namespace articula::view {

namespace {

Json finite_or_null(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json joint_json(const remote::SheetJoint& joint) {
  const JointLimits& limits = joint.limits;
  return {{"name", joint.name},
          {"type", to_string(joint.type)},
          {"position_unit", joint.position_unit()},
          {"effort_unit", joint.effort_unit()},
          {"limits",
           {{"lower", finite_or_null(limits.lower)},
            {"upper", finite_or_null(limits.upper)},
            {"velocity", finite_or_null(limits.velocity)},
            {"effort", finite_or_null(limits.effort)},
            {"acceleration", finite_or_null(limits.acceleration)},
            {"jerk", finite_or_null(limits.jerk)},
            {"soft_lower", finite_or_null(limits.soft_lower)},
            {"soft_upper", finite_or_null(limits.soft_upper)},
            {"soft_rate", finite_or_null(limits.soft_rate)}}}};
}

}  // namespace

Json robot_json(const remote::RobotSheet& robot) {
  Json json = {{"name", robot.name},         {"joints", Json::array()},
               {"mimics", Json::array()},    {"links", robot.links},
               {"commands", robot.commands}, {"urdf", robot.urdf},
               {"period", robot.period},     {"is_simulated", robot.is_simulated}};
  for (const remote::SheetJoint& joint : robot.joints) json["joints"].push_back(joint_json(joint));
  for (const remote::SheetMimic& mimic : robot.mimics) {
    json["mimics"].push_back({{"name", mimic.name},
                              {"joint", mimic.joint},
                              {"multiplier", mimic.multiplier},
                              {"offset", mimic.offset}});
  }
  return json;
}

Json situation_json(const remote::Situation& situation, bool operates, bool you_operate) {
  Json json = {{"mode", to_string(situation.mode)},
               {"fault", to_string(situation.fault)},
               {"advice", situation.advice},
               {"motion", situation.motion},
               {"operator", situation.operator_name},
               {"you_operate", you_operate},
               {"controllers", Json::array()},
               {"paused", situation.paused},
               {"speed", situation.speed},
               {"operates", operates}};
  for (const ControllerInfo& controller : situation.controllers) {
    json["controllers"].push_back(
        {{"name", controller.name.view()}, {"status", to_string(controller.status)}});
  }
  return json;
}

Json statistics_json(const remote::Statistics& statistics) {
  return {{"cycles", statistics.cycles},
          {"overruns", statistics.overruns},
          {"dropped", statistics.dropped},
          {"latency_median", statistics.latency_median},
          {"latency_99", statistics.latency_99},
          {"latency_max", statistics.latency_max},
          {"execution_median", statistics.execution_median},
          {"execution_99", statistics.execution_99},
          {"execution_max", statistics.execution_max}};
}

Json log_json(const remote::Event& event, WallTime stamp) {
  // The levels of foxglove.Log: 1 debug, 2 info, 3 warning, 4 error.
  const int level = 2 + static_cast<int>(event.level);
  return {{"timestamp", {{"sec", stamp / 1'000'000'000}, {"nsec", stamp % 1'000'000'000}}},
          {"level", level},
          {"message", event.text},
          {"name", "articula"},
          {"file", ""},
          {"line", 0}};
}

Json parameters_json(const std::vector<remote::Parameter>& parameters) {
  Json json = {{"parameters", Json::array()}};
  for (const remote::Parameter& parameter : parameters) {
    json["parameters"].push_back({{"name", parameter.name},
                                  {"value", parameter.value},
                                  {"unit", parameter.unit},
                                  {"lowest", finite_or_null(parameter.lowest)},
                                  {"highest", finite_or_null(parameter.highest)},
                                  {"description", parameter.description}});
  }
  return json;
}

}  // namespace articula::view

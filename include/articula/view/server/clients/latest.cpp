// SPDX-License-Identifier: Apache-2.0
#include "articula/view/server/clients/latest.hpp"

#include "articula/version.hpp"
#include "articula/view/protocol/messages/channels.hpp"
#include "articula/view/protocol/requests/requests.hpp"

#include <memory>

namespace articula::view {

namespace {

Json server_info_json(const remote::RobotSheet& robot, const std::string& session_id) {
  return {{"op", "serverInfo"},
          {"name", "articula: " + robot.name},
          {"capabilities",
           {"clientPublish", "parameters", "parametersSubscribe", "services", "assets"}},
          {"supportedEncodings", {"json"}},
          {"metadata", {{"articula", library_version}, {"robot", robot.name}}},
          {"sessionId", session_id}};
}

Json advertise_json() {
  Json json = {{"op", "advertise"}, {"channels", Json::array()}};
  for (std::size_t i = 0; i < topic_count; ++i) {
    json["channels"].push_back(advertisement_of(static_cast<Topic>(i)));
  }
  return json;
}

Json services_json() {
  const std::string answer = to_text({{"type", "object"},
                                      {"properties",
                                       {{"success", {{"type", "boolean"}}},
                                        {"message", {{"type", "string"}}},
                                        {"cycle", {{"type", "integer"}}}}}});
  Json json = {{"op", "advertiseServices"}, {"services", Json::array()}};
  int id = 0;
  for (const Service& service : services()) {
    const std::string type = "articula" + std::string(service.name);
    const auto part = [&](const std::string& schema, const char* end) {
      return Json{{"encoding", "json"},
                  {"schemaName", type + end},
                  {"schemaEncoding", "jsonschema"},
                  {"schema", schema}};
    };
    const std::string request = to_text(schema_of(service.members));
    // Clients of older versions read requestSchema and responseSchema.
    json["services"].push_back({{"id", ++id},
                                {"name", service.name},
                                {"type", type},
                                {"request", part(request, "_Request")},
                                {"response", part(answer, "_Response")},
                                {"requestSchema", request},
                                {"responseSchema", answer}});
  }
  return json;
}

}  // namespace

Latest::Latest(const remote::RobotSheet& robot, const std::string& session_id)
    : server_info(share(server_info_json(robot, session_id))),
      advertise(share(advertise_json())),
      advertise_services(share(services_json())),
      robot_description(share(Json{{"data", robot.urdf}})) {}

}  // namespace articula::view

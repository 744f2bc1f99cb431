// SPDX-License-Identifier: Apache-2.0
#include "cyclone_peer.hpp"

#include <dds/dds.h>

#include <array>
#include <span>
#include <stdexcept>
#include <utility>

namespace {

struct Text {
  char* data;
};
struct Request {
  std::uint64_t client;
  std::int64_t sequence;
  std::uint8_t structure_needs_at_least_one_member;
};
struct Response {
  std::uint64_t client;
  std::int64_t sequence;
  std::uint8_t success;
  char* message;
};
struct SwitchRequest {
  std::uint64_t client;
  std::int64_t sequence;
  dds_sequence_t activate, deactivate;
  std::int32_t strictness;
  bool activate_asap;
  std::int32_t timeout_sec;
  std::uint32_t timeout_nanosec;
};
struct States {
  std::int32_t stamp_sec;
  std::uint32_t stamp_nanosec;
  char* frame;
  dds_sequence_t name, position, velocity, effort;
};

constexpr std::uint32_t field_8by = std::uint32_t{DDS_OP_ADR} | std::uint32_t{DDS_OP_TYPE_8BY},
                        field_signed = field_8by | DDS_OP_FLAG_SGN,
                        field_1by = std::uint32_t{DDS_OP_ADR} | std::uint32_t{DDS_OP_TYPE_1BY},
                        field_4by = std::uint32_t{DDS_OP_ADR} | std::uint32_t{DDS_OP_TYPE_4BY},
                        field_signed_4by = field_4by | DDS_OP_FLAG_SGN,
                        field_text = std::uint32_t{DDS_OP_ADR} | std::uint32_t{DDS_OP_TYPE_STR},
                        field_texts = std::uint32_t{DDS_OP_ADR} | std::uint32_t{DDS_OP_TYPE_SEQ} |
                                      std::uint32_t{DDS_OP_SUBTYPE_STR},
                        field_doubles = std::uint32_t{DDS_OP_ADR} | std::uint32_t{DDS_OP_TYPE_SEQ} |
                                        std::uint32_t{DDS_OP_SUBTYPE_8BY} | DDS_OP_FLAG_FP;

constexpr std::array<std::uint32_t, 3> text_fields{field_text, offsetof(Text, data), DDS_OP_RTS};
constexpr std::array<std::uint32_t, 7> request_fields{
    field_8by,    offsetof(Request, client),
    field_signed, offsetof(Request, sequence),
    field_1by,    offsetof(Request, structure_needs_at_least_one_member),
    DDS_OP_RTS};
constexpr std::array<std::uint32_t, 9> response_fields{
    field_8by, offsetof(Response, client),  field_signed, offsetof(Response, sequence),
    field_1by, offsetof(Response, success), field_text,   offsetof(Response, message),
    DDS_OP_RTS};

constexpr std::array<std::uint32_t, 17> switch_fields{
    field_8by,        offsetof(SwitchRequest, client),
    field_signed,     offsetof(SwitchRequest, sequence),
    field_texts,      offsetof(SwitchRequest, activate),
    field_texts,      offsetof(SwitchRequest, deactivate),
    field_signed_4by, offsetof(SwitchRequest, strictness),
    field_1by,        offsetof(SwitchRequest, activate_asap),
    field_signed_4by, offsetof(SwitchRequest, timeout_sec),
    field_4by,        offsetof(SwitchRequest, timeout_nanosec),
    DDS_OP_RTS};
constexpr std::array<std::uint32_t, 15> states_fields{
    field_signed_4by, offsetof(States, stamp_sec), field_4by,     offsetof(States, stamp_nanosec),
    field_text,       offsetof(States, frame),     field_texts,   offsetof(States, name),
    field_doubles,    offsetof(States, position),  field_doubles, offsetof(States, velocity),
    field_doubles,    offsetof(States, effort),    DDS_OP_RTS};

template <class T, std::size_t n>
dds_topic_descriptor_t descriptor(const char* name, const std::array<std::uint32_t, n>& fields) {
  return {.m_size = sizeof(T),
          .m_align = alignof(T),
          .m_flagset = 0,
          .m_nkeys = 0,
          .m_typename = name,
          .m_keys = nullptr,
          .m_nops = static_cast<std::uint32_t>(n),
          .m_ops = fields.data(),
          .m_meta = "",
          .type_information = {},
          .type_mapping = {},
          .restrict_data_representation = 0};
}

dds_return_t good(dds_return_t code, const char* what) {
  if (code < 0) throw std::runtime_error(std::string(what) + ": " + dds_strretcode(code));
  return code;
}

struct Qos {
  explicit Qos(bool transient_local) {
    dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
    dds_qset_durability(qos,
                        transient_local ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
    dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 100);
  }
  Qos(const Qos&) = delete;
  Qos& operator=(const Qos&) = delete;
  ~Qos() { dds_delete_qos(qos); }
  dds_qos_t* qos = dds_create_qos();
};

template <class T>
std::span<T> items(const dds_sequence_t& sequence) {
  return {reinterpret_cast<T*>(sequence._buffer), sequence._length};
}

// A sequence of texts, which stay where they are.
struct Texts {
  explicit Texts(std::vector<std::string> own) : texts(std::move(own)) {
    for (std::string& text : texts) pointers.push_back(text.data());
  }
  dds_sequence_t sequence() {
    const auto size = static_cast<std::uint32_t>(pointers.size());
    return {size, size, reinterpret_cast<std::uint8_t*>(pointers.data()), false};
  }
  std::vector<std::string> texts;
  std::vector<char*> pointers{};
};

std::string user_data(const dds_qos_t* qos) {
  void* data = nullptr;
  std::size_t size = 0;
  dds_qget_userdata(qos, &data, &size);
  std::string text(static_cast<const char*>(data), size);
  dds_free(data);
  return text;
}

// Calls function(sample) for each sample of a reader, and takes or only reads it.
template <class T, class Function>
void for_each_sample(dds_entity_t reader, bool take, Function function) {
  std::array<void*, 64> samples{};
  std::array<dds_sample_info_t, 64> infos{};
  const int count = good((take ? dds_take : dds_read)(reader, samples.data(), infos.data(),
                                                      samples.size(), samples.size()),
                         "take");
  for (int i = 0; i < count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (infos[at].valid_data) function(*static_cast<const T*>(samples[at]));
  }
  if (count > 0) dds_return_loan(reader, samples.data(), count);
}

}  // namespace

struct CyclonePeer::Entities {
  dds_entity_t domain = 0, participant = 0, requests = 0, replies = 0, participants = 0,
               publications = 0, subscriptions = 0;
  std::uint64_t client = 0;

  dds_entity_t make_topic(const dds_topic_descriptor_t& type, const std::string& name) const {
    return good(dds_create_topic(participant, &type, name.c_str(), nullptr, nullptr), "topic");
  }
};

CyclonePeer::CyclonePeer(unsigned domain) : entities_(std::make_unique<Entities>()) {
  Entities& e = *entities_;
  e.domain = good(dds_create_domain(domain, R"(<CycloneDDS><Domain Id="any">
      <General><Interfaces><NetworkInterface address="127.0.0.1" multicast="false"/></Interfaces>
        <AllowMulticast>false</AllowMulticast></General>
      <Discovery><ParticipantIndex>auto</ParticipantIndex>
        <MaxAutoParticipantIndex>31</MaxAutoParticipantIndex>
        <Peers><Peer address="127.0.0.1"/></Peers></Discovery>
    </Domain></CycloneDDS>)"),
                  "domain");
  e.participant = good(dds_create_participant(domain, nullptr, nullptr), "participant");
  const auto builtin = [&](dds_entity_t topic) {
    return good(dds_create_reader(e.participant, topic, nullptr, nullptr), "reader");
  };
  e.participants = builtin(DDS_BUILTIN_TOPIC_DCPSPARTICIPANT);
  e.publications = builtin(DDS_BUILTIN_TOPIC_DCPSPUBLICATION);
  e.subscriptions = builtin(DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION);
}

CyclonePeer::~CyclonePeer() {
  dds_delete(entities_->participant);
  dds_delete(entities_->domain);
}

int CyclonePeer::make_writer(const std::string& topic, bool transient_local,
                             std::size_t user_data) {
  const auto type = descriptor<Text>("std_msgs::msg::dds_::String_", text_fields);
  const Qos qos(transient_local);
  const std::string data(user_data, 'x');
  dds_qset_userdata(qos.qos, data.data(), data.size());
  return good(dds_create_writer(entities_->participant, entities_->make_topic(type, topic), qos.qos,
                                nullptr),
              "writer");
}

int CyclonePeer::make_reader(const std::string& topic, bool transient_local) {
  const auto type = descriptor<Text>("std_msgs::msg::dds_::String_", text_fields);
  const Qos qos(transient_local);
  return good(dds_create_reader(entities_->participant, entities_->make_topic(type, topic), qos.qos,
                                nullptr),
              "reader");
}

void CyclonePeer::write(int writer, const std::string& text) {
  std::string copy = text;
  const Text message{copy.data()};
  good(dds_write(writer, &message), "write");
}

std::vector<std::string> CyclonePeer::take(int reader) {
  std::vector<std::string> texts;
  for_each_sample<Text>(reader, true, [&](const Text& text) { texts.emplace_back(text.data); });
  return texts;
}

std::size_t CyclonePeer::matches_of_writer(int writer) {
  return static_cast<std::size_t>(
      good(dds_get_matched_subscriptions(writer, nullptr, 0), "matched subscriptions"));
}

std::size_t CyclonePeer::matches_of_reader(int reader) {
  return static_cast<std::size_t>(
      good(dds_get_matched_publications(reader, nullptr, 0), "matched publications"));
}

void CyclonePeer::make_request_writer(const std::string& service) {
  Entities& e = *entities_;
  const auto type = descriptor<Request>("std_srvs::srv::dds_::Trigger_Request_", request_fields);
  const Qos qos(false);
  e.requests = good(dds_create_writer(e.participant, e.make_topic(type, "rq" + service + "Request"),
                                      qos.qos, nullptr),
                    "writer");
  dds_instance_handle_t handle = 0;
  good(dds_get_instance_handle(e.requests, &handle), "instance handle");
  e.client = handle;
}

void CyclonePeer::make_reply_reader(const std::string& service) {
  Entities& e = *entities_;
  const auto type = descriptor<Response>("std_srvs::srv::dds_::Trigger_Response_", response_fields);
  const Qos qos(false);
  e.replies = good(dds_create_reader(e.participant, e.make_topic(type, "rr" + service + "Reply"),
                                     qos.qos, nullptr),
                   "reader");
}

int CyclonePeer::make_states_reader(const std::string& topic) {
  const auto type = descriptor<States>("sensor_msgs::msg::dds_::JointState_", states_fields);
  const Qos qos(false);
  return good(dds_create_reader(entities_->participant, entities_->make_topic(type, topic), qos.qos,
                                nullptr),
              "reader");
}

std::vector<CyclonePeer::JointStates> CyclonePeer::take_states(int reader) {
  std::vector<JointStates> all;
  for_each_sample<States>(reader, true, [&](const States& states) {
    const auto names = items<char*>(states.name);
    const auto positions = items<double>(states.position);
    all.push_back({{names.begin(), names.end()}, {positions.begin(), positions.end()}});
  });
  return all;
}

void CyclonePeer::make_switch_client(const std::string& service) {
  Entities& e = *entities_;
  const Qos qos(false);
  const auto reply = descriptor<Response>(
      "controller_manager_msgs::srv::dds_::SwitchController_Response_", response_fields);
  e.replies = good(dds_create_reader(e.participant, e.make_topic(reply, "rr" + service + "Reply"),
                                     qos.qos, nullptr),
                   "reader");
  const auto request = descriptor<SwitchRequest>(
      "controller_manager_msgs::srv::dds_::SwitchController_Request_", switch_fields);
  e.requests =
      good(dds_create_writer(e.participant, e.make_topic(request, "rq" + service + "Request"),
                             qos.qos, nullptr),
           "writer");
  dds_instance_handle_t handle = 0;
  good(dds_get_instance_handle(e.requests, &handle), "instance handle");
  e.client = handle;
}

void CyclonePeer::request_switch(std::int64_t sequence, const std::vector<std::string>& activate,
                                 const std::vector<std::string>& deactivate) {
  Texts on(activate), off(deactivate);
  const SwitchRequest request{.client = entities_->client,
                              .sequence = sequence,
                              .activate = on.sequence(),
                              .deactivate = off.sequence(),
                              .strictness = 2,
                              .activate_asap = true,
                              .timeout_sec = 5,
                              .timeout_nanosec = 0};
  good(dds_write(entities_->requests, &request), "write");
}

bool CyclonePeer::finds_service() {
  return matches_of_writer(entities_->requests) > 0 &&
         (entities_->replies == 0 || matches_of_reader(entities_->replies) > 0);
}

void CyclonePeer::request(std::int64_t sequence) {
  const Request request{entities_->client, sequence, 0};
  good(dds_write(entities_->requests, &request), "write");
}

std::optional<CyclonePeer::Reply> CyclonePeer::take_reply() {
  std::optional<Reply> reply;
  for_each_sample<Response>(entities_->replies, true, [&](const Response& response) {
    reply = Reply{response.client, response.sequence, response.success != 0, response.message};
  });
  return reply;
}

std::uint64_t CyclonePeer::client() const { return entities_->client; }

std::vector<CyclonePeer::Discovered> CyclonePeer::participants() {
  std::vector<Discovered> all;
  for_each_sample<dds_builtintopic_participant_t>(
      entities_->participants, false, [&](const dds_builtintopic_participant_t& participant) {
        all.push_back({std::to_array(participant.key.v), user_data(participant.qos)});
      });
  return all;
}

namespace {

std::vector<CyclonePeer::Discovered> endpoints(dds_entity_t reader, const std::string& topic) {
  std::vector<CyclonePeer::Discovered> all;
  for_each_sample<dds_builtintopic_endpoint_t>(
      reader, false, [&](const dds_builtintopic_endpoint_t& endpoint) {
        if (topic != endpoint.topic_name) return;
        all.push_back({std::to_array(endpoint.key.v), user_data(endpoint.qos)});
      });
  return all;
}

}  // namespace

std::vector<CyclonePeer::Discovered> CyclonePeer::writers(const std::string& topic) {
  return endpoints(entities_->publications, topic);
}

std::vector<CyclonePeer::Discovered> CyclonePeer::readers(const std::string& topic) {
  return endpoints(entities_->subscriptions, topic);
}

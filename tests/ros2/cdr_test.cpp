// SPDX-License-Identifier: Apache-2.0
#include "articula/ros2/cdr_decoder.hpp"
#include "articula/ros2/cdr_encoder.hpp"
#include "articula/ros2/message_text.hpp"
#include "articula/ros2/names.hpp"
#include "articula/ros2/service_header.hpp"
#include "articula/ros2/type_hash.hpp"

#include "all_messages.hpp"
#include "catch.hpp"

#include <nlohmann/json.hpp>

#include <bit>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <iostream>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using namespace articula::ros2;
using Json = nlohmann::json;
using Bytes = std::vector<std::byte>;
using std::endian;

Bytes from_hex(const std::string& digits) {
  Bytes bytes;
  for (std::size_t i = 0; i < digits.size(); i += 2) {
    bytes.push_back(static_cast<std::byte>(std::stoi(digits.substr(i, 2), nullptr, 16)));
  }
  return bytes;
}

/// Fills a value from the values that a file of frames states. They must name all fields.
template <class T>
void fill(T& value, const Json& json) {
  if constexpr (std::is_same_v<T, std::byte>) {  // a character of Latin-1, written in UTF-8
    const auto text = json.get<std::string>();
    const auto first = static_cast<unsigned char>(text[0]);
    value = static_cast<std::byte>(
        text.size() == 1 ? first : ((first & 3) << 6) | (static_cast<unsigned char>(text[1]) & 63));
  } else if constexpr (std::is_same_v<T, double>) {
    value = json.is_string() ? std::stod(json.get<std::string>()) : json.get<double>();
  } else if constexpr (MessageNumber<T>) {
    value = json.get<T>();
  } else if constexpr (MessageText<T>) {
    value.assign(json.get<std::string>());
  } else if constexpr (Message<T>) {
    if (field_count<T>() > 0 && json.size() != field_count<T>()) {
      throw std::invalid_argument(T::ros_type.view().data());
    }
    for_each_field(value, [&](std::string_view name, auto& field) {
      fill(field, json.at(std::string(name)));
      return true;
    });
  } else {
    if constexpr (FieldShape<T>::multiplicity != Multiplicity::array) value.resize(json.size());
    if (value.size() != json.size()) throw std::invalid_argument("length of an array");
    for (std::size_t i = 0; i < json.size(); ++i) {
      typename FieldShape<T>::Element item{};
      fill(item, json[i]);
      value[i] = item;
    }
  }
}

template <Message M>
Bytes encoded(const M& message, endian order = endian::little) {
  Bytes bytes(1 << 16);
  const Encoded result = encode(message, bytes, order);
  REQUIRE(result.error == CdrError::none);
  bytes.resize(result.size);
  return bytes;
}

/// Bytes that were decoded and encoded again.
struct Rewritten {
  CdrError error = CdrError::none;
  Bytes bytes{};
  std::int64_t sequence = 0;  ///< of a request
};

/// What the tests do with each type. Every type is compiled once.
struct Codec {
  std::string dds_type;
  std::string hash;
  Bytes (*write)(const Json& fields, endian order);
  Rewritten (*rewrite)(const Bytes& bytes);
  Rewritten (*rewrite_from_cyclone)(const Bytes& bytes);  ///< without client and number
  Rewritten (*rewrite_in_cyclone)(const Bytes& bytes);
};

template <class Read, class Written = Read>
Rewritten rewrite(const Bytes& bytes) {
  Read message;
  const CdrError error = decode(bytes, message);
  if (error != CdrError::none) return {error};
  if constexpr (!requires { message.sequence; }) {
    return {error, encoded(message)};
  } else if constexpr (std::is_same_v<Read, Written>) {
    return {error, encoded(message), message.sequence};
  } else {
    return {error, encoded(message.message), message.sequence};
  }
}

template <class M>
Codec codec_of() {
  return {.dds_type = dds_type_name<M>(),
          .hash = std::string(compute_type_hash<M>().view()),
          .write =
              [](const Json& fields, endian order) {
                M message;
                fill(message, fields);
                return encoded(message, order);
              },
          .rewrite = rewrite<M>,
          .rewrite_from_cyclone = rewrite<CycloneMessage<M>, M>,
          .rewrite_in_cyclone = rewrite<CycloneMessage<M>>};
}

template <class Layout>
const std::vector<Codec>& codecs() {
  static const std::vector<Codec> all = [] {
    std::vector<Codec> made;
    test::for_each_sent<Layout>([&]<class M> { made.push_back(codec_of<M>()); });
    return made;
  }();
  return all;
}

Json frames() {
  std::ifstream file(ARTICULA_ROS2_FRAMES "/jazzy.json");
  REQUIRE(file);
  return Json::parse(file);
}

/// Calls visit(codec, frame) for each frame, with the codec of its type.
template <class Visit>
std::size_t for_each_frame(const std::vector<Codec>& codecs, const Visit& visit) {
  const Json all = frames();
  std::size_t count = 0;
  for (const Json& frame : all) {
    INFO(frame.at("name").get<std::string>());
    for (const Codec& codec : codecs) {
      if (frame.at("dds_type") != codec.dds_type) continue;
      visit(codec, frame);
      ++count;
    }
  }
  CHECK(count == all.size());
  return count;
}

TEST_CASE("the bytes of every message are those of ROS's own tools, both ways") {
  const auto visit = [](const Codec& codec, const Json& frame) {
    const Bytes cdr = from_hex(frame.at("cdr"));
    CHECK(codec.hash == frame.at("type_hash").get<std::string>());
    CHECK((codec.write(frame.at("fields"), endian::little) == cdr));
    const Rewritten read = codec.rewrite(cdr);
    CHECK(read.error == CdrError::none);
    CHECK((read.bytes == cdr));
    const Bytes big = codec.write(frame.at("fields"), endian::big);
    CHECK((big.size() == cdr.size() && big[1] == std::byte{0}));
    const Rewritten swapped = codec.rewrite(big);
    CHECK(swapped.error == CdrError::none);
    CHECK((swapped.bytes == cdr));
  };
  CHECK(for_each_frame(codecs<Jazzy>(), visit) > 90);
}

TEST_CASE("requests and replies of the Cyclone dialect begin with client and number") {
  int count = 0;
  for_each_frame(codecs<Jazzy>(), [&](const Codec& codec, const Json& frame) {
    if (!frame.contains("wire")) return;
    Bytes wire = from_hex(frame.at("wire"));
    const Rewritten message = codec.rewrite_from_cyclone(wire);
    CHECK(message.error == CdrError::none);
    CHECK(message.sequence == frame.at("sequence"));
    CHECK((message.bytes == from_hex(frame.at("cdr"))));
    const Rewritten whole = codec.rewrite_in_cyclone(wire);
    wire.resize(wire.size() - frame.at("padding").get<std::size_t>());
    CHECK((whole.bytes == wire));
    ++count;
  });
  CHECK(count > 0);
}

/// Checks the frames of one type, and returns their number.
template <class M>
int check_without_heap() {
  int count = 0;
  for (const Json& frame : frames()) {
    if (frame.at("dds_type") != dds_type_name<M>()) continue;
    const Bytes cdr = from_hex(frame.at("cdr"));
    M message;
    fill(message, frame.at("fields"));
    CHECK((encoded(message) == cdr));
    M read;
    REQUIRE(decode(cdr, read) == CdrError::none);
    CHECK((encoded(read) == cdr));
    ++count;
  }
  return count;
}

TEST_CASE("a message in a layout without heap has the same bytes") {
  using Layout = InlineLayout<Jazzy, 16, 1600>;
  CHECK(check_without_heap<sensor_msgs::msg::JointState<Layout>>() > 0);
  CHECK(check_without_heap<std_msgs::msg::String<Layout>>() > 0);
}

TEST_CASE("numbers are written in the byte order that is asked for") {
  const builtin_interfaces::msg::Time time{.sec = 0x01020304, .nanosec = 5};
  CHECK((encoded(time, endian::big) == from_hex("000000000102030400000005")));
  CHECK((encoded(time) == from_hex("000100000403020105000000")));
}

TEST_CASE("a message that does not fit is refused at every size") {
  const std_msgs::msg::Header<Jazzy> header{.stamp = {1, 2}, .frame_id = "base"};
  const std::size_t size = encoded(header).size();
  for (std::size_t room = 0; room < size; ++room) {
    Bytes bytes(room);
    const Encoded result = encode(header, bytes);
    CHECK(result.error == CdrError::no_room);
    CHECK(result.size == 0);
  }
}

TEST_CASE("wrong bytes are refused with the reason") {
  const auto error = []<class M>(M message, const char* digits) {
    return decode(from_hex(digits), message);
  };
  const std_msgs::msg::String<Jazzy> string;
  const std_srvs::srv::SetBool<Jazzy>::Request flag;
  const sensor_msgs::msg::JointState<InlineLayout<Jazzy, 1, 3>> state;
  CHECK(error(string, "00010000020000006100") == CdrError::none);
  CHECK(error(string, "0001000000000000") == CdrError::none);
  CHECK(error(string, "000100000200000061") == CdrError::no_room);
  CHECK(error(string, "00010000020000006162") == CdrError::bad_text);
  CHECK(error(string, "00010000020000000000") == CdrError::bad_text);
  CHECK(error(string, "00070000020000006100") == CdrError::unknown_header);
  CHECK(error(string, "0001") == CdrError::no_room);
  CHECK(error(string, "0001000002000000610000000000") == CdrError::surplus);
  CHECK(error(flag, "0001000002") == CdrError::bad_bool);
  CHECK(error(std_msgs::msg::Float64MultiArray<Jazzy>(), "00010000ffffff7f") ==
        CdrError::long_sequence);
  CHECK(error(state, "00010000000000000000000005000000616263640000000000000000000000000000") ==
        CdrError::long_sequence);
  Bytes room(64);
  const std_msgs::msg::String<Jazzy> with_nul{std::string(1, '\0')};
  CHECK(encode(with_nul, room).error == CdrError::bad_text);
}

TEST_CASE("random changes of real messages give a message or an error") {
  const auto seed = std::random_device()();
  std::cout << "seed " << seed << '\n';
  std::mt19937 random(seed);
  std::size_t inputs = 0, accepted = 0;
  const auto attack = [&](const Codec& codec, const Json& frame) {
    const Bytes original = from_hex(frame.at("cdr"));
    for (int i = 0; i < 600; ++i, ++inputs) {
      Bytes bytes = original;
      for (auto changes = 1 + random() % 3; changes > 0; --changes) {
        bytes[random() % bytes.size()] = static_cast<std::byte>(random() % 2 == 0 ? random() : 255);
      }
      if (random() % 4 == 0) bytes.resize(random() % (bytes.size() + 8));
      bytes.shrink_to_fit();
      const Rewritten message = codec.rewrite(bytes);
      if (message.error != CdrError::none) continue;
      ++accepted;
      REQUIRE((codec.rewrite(message.bytes).bytes == message.bytes));
    }
  };
  for_each_frame(codecs<Jazzy>(), attack);
  for_each_frame(codecs<Humble>(), attack);
  CHECK(inputs > 100'000);
  CHECK(accepted > inputs / 100);
  CHECK(accepted < inputs);
}

TEST_CASE("layouts of Humble, Jazzy and Rolling differ where the distributions differ") {
  using controller_manager_msgs::msg::HardwareComponentState;
  CHECK(field_count<HardwareComponentState<Humble>>() == 6);
  CHECK(field_count<HardwareComponentState<Jazzy>>() == 9);
  CHECK(field_count<HardwareComponentState<Rolling>>() == 8);
  CHECK(field_count<controller_manager_msgs::srv::SwitchController<Humble>::Request>() == 8);
  CHECK(field_count<controller_manager_msgs::srv::SwitchController<Jazzy>::Request>() == 5);
  CHECK(encoded(rmw_dds_common::msg::Gid<Humble>()).size() == 4 + 24);
  CHECK(encoded(rmw_dds_common::msg::Gid<Jazzy>()).size() == 4 + 16);
}

TEST_CASE("the text of a message lists its fields and the types that it refers to") {
  const std::string line(80, '=');
  CHECK(message_text<sensor_msgs::msg::JointState<Jazzy>>() ==
        "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\n"
        "float64[] effort\n" +
            line + "\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n" + line +
            "\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n");
  CHECK(message_text<unique_identifier_msgs::msg::UUID>() == "uint8[16] uuid\n");
  CHECK(message_text<rcl_interfaces::msg::ParameterDescriptor<Jazzy>>().find(
            "IntegerRange[<=1] integer_range\n") != std::string::npos);
}

TEST_CASE("topics of services and actions have the names that clients use") {
  for (const Json& frame : frames()) {
    const std::string topic = frame.at("topic");
    const std::string arm = "/arm_controller/follow_joint_trajectory";
    const std::string type = frame.at("dds_type");
    if (topic.find("_action/feedback") != std::string::npos) {
      CHECK(topic == topic_name(feedback_name(arm)));
    } else if (type.find("SendGoal_Request") != std::string::npos) {
      CHECK(topic == request_topic_name(send_goal_name(arm)));
    } else if (type.find("GetResult_Response") != std::string::npos) {
      CHECK(topic == reply_topic_name(get_result_name(arm)));
    } else if (type.find("CancelGoal_Request") != std::string::npos) {
      CHECK(topic == request_topic_name(cancel_goal_name(arm)));
    }
  }
  CHECK(status_name("/a") == "/a/_action/status");
  CHECK(type_hash_user_data("RIHS01_0") == "typehash=RIHS01_0;");
}

TEST_CASE("the number of a request survives its halves") {
  for (const std::int64_t number :
       {std::int64_t{1}, std::int64_t{0xffffffff}, std::int64_t{0x100000000}, std::int64_t{-1},
        std::numeric_limits<std::int64_t>::min()}) {
    CHECK(sequence(related_sample_identity({}, number)) == number);
  }
  CHECK(related_sample_identity({}, 0x100000002).sequence_high == 1);
  CHECK(related_sample_identity({}, 0x100000002).sequence_low == 2);
}

}  // namespace

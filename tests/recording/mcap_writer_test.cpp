// SPDX-License-Identifier: Apache-2.0
// MCAP files, read back by the specification: once from the front, once through the summary.
#include <articula/recording/mcap_record_writer.hpp>
#include <articula/recording/ros_record_writer.hpp>
#include <articula/robots/q2d.hpp>
#include <articula/ros2/cdr_decoder.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "remote/record.hpp"
#include "scratch_file.hpp"

using namespace articula;

namespace {

const std::string magic("\x89MCAP0\r\n", 8);

/// Takes a record's fields one by one.
class Fields {
 public:
  explicit Fields(std::string_view bytes) : bytes_(bytes) {}
  std::uint64_t number(std::size_t size) {
    std::uint64_t value = 0;
    for (std::size_t i = size; i-- > 0;) {
      value = value << 8 | static_cast<unsigned char>(bytes_.at(at_ + i));
    }
    at_ += size;
    return value;
  }
  std::string_view text() { return bytes(number(4)); }
  std::string_view bytes(std::size_t size) {
    if (at_ + size > bytes_.size()) throw std::out_of_range("a field beyond the record");
    at_ += size;
    return bytes_.substr(at_ - size, size);
  }
  std::string_view rest() { return bytes(bytes_.size() - at_); }
  [[nodiscard]] bool empty() const { return at_ == bytes_.size(); }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
};

struct RawRecord {
  std::uint64_t opcode;
  std::size_t start;
  std::string content;
};

/// All complete records of a file or of a chunk's content, from the front.
std::vector<RawRecord> records_of(std::string_view bytes, std::size_t at = 0) {
  std::vector<RawRecord> records;
  while (at + 9 <= bytes.size()) {
    Fields head(bytes.substr(at, 9));
    const std::uint64_t opcode = head.number(1);
    const std::size_t length = head.number(8);
    if (at + 9 + length > bytes.size()) break;
    records.push_back({opcode, at, std::string(bytes.substr(at + 9, length))});
    at += 9 + length;
  }
  return records;
}

/// The same for a file, whose magic bytes are not records.
std::vector<RawRecord> records_of_file(const std::string& file) {
  return records_of(std::string_view(file).substr(0, file.size() - magic.size()), magic.size());
}

struct Chunk {
  std::uint64_t first, last;
  std::string messages;
};

Chunk chunk_of(const RawRecord& record) {
  Fields fields(record.content);
  Chunk chunk{fields.number(8), fields.number(8), {}};
  const std::uint64_t size = fields.number(8);
  CHECK(fields.number(4) == 0);  // no checksum
  CHECK(fields.text().empty());  // no compression
  CHECK(fields.number(8) == size);
  chunk.messages = fields.bytes(size);
  CHECK(fields.empty());
  return chunk;
}

struct Message {
  std::uint64_t sequence, time;
  std::string text;
};

Message message_of(const RawRecord& record) {
  Fields fields(record.content);
  CHECK(fields.number(2) == 1);  // the channel
  Message message{fields.number(4), fields.number(8), {}};
  CHECK(fields.number(8) == message.time);
  message.text = fields.rest();
  return message;
}

/// All messages that a reader from the front finds, in chunks and outside.
std::vector<Message> messages_from_the_front(const std::string& file) {
  std::vector<Message> messages;
  for (const RawRecord& record : records_of(file, magic.size())) {
    if (record.opcode == 5) messages.push_back(message_of(record));
    if (record.opcode != 6) continue;
    for (const RawRecord& inner : records_of(chunk_of(record).messages)) {
      REQUIRE(inner.opcode == 5);
      messages.push_back(message_of(inner));
    }
  }
  return messages;
}

std::string content_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

TEST_CASE("an MCAP file is what its specification says") {
  const support::ScratchFile file("records.mcap");
  McapRecordWriter<Q2d, EffortCommand<2>> writer(file.path());
  auto record = support::some_record();
  for (int k = 0; k < 3; ++k) {
    record.time = 0.001 * (k + 1);
    writer.write(record);
  }
  writer.close();

  const std::string bytes = content_of(file.path());
  REQUIRE(bytes.substr(0, 8) == magic);
  REQUIRE(bytes.substr(bytes.size() - 8) == magic);
  const auto records = records_of_file(bytes);
  std::vector<std::uint64_t> opcodes;
  for (const RawRecord& r : records) opcodes.push_back(r.opcode);
  REQUIRE(opcodes == std::vector<std::uint64_t>{1, 3, 4, 6, 7, 15, 3, 4, 11, 8, 14, 14, 14, 14, 2});

  Fields header(records[0].content);
  CHECK(header.text().empty());
  CHECK(header.text() == "articula");
  CHECK(header.empty());

  Fields schema(records[1].content);
  const std::uint64_t schema_id = schema.number(2);
  CHECK(schema_id > 0);
  CHECK(schema.text() == "articula.Cycle");
  CHECK(schema.text() == "jsonschema");
  const Json description = Json::parse(schema.text());
  CHECK(schema.empty());
  CHECK(description["type"] == "object");
  const Json& shoulder =
      description["properties"]["q2d"]["properties"]["shoulder_active_joint"]["properties"];
  CHECK(shoulder["position"]["type"] == "number");
  CHECK(shoulder["reference"]["properties"]["effort"]["type"] == "number");
  CHECK(description["properties"]["status"]["type"] == "string");

  Fields channel(records[2].content);
  const std::uint64_t channel_id = channel.number(2);
  CHECK(channel.number(2) == schema_id);
  CHECK(channel.text() == "cycle");
  CHECK(channel.text() == "json");
  CHECK(channel.number(4) == 0);  // an empty map
  CHECK(channel.empty());

  const Chunk chunk = chunk_of(records[3]);
  CHECK(chunk.first == 1'000'000);
  CHECK(chunk.last == 3'000'000);
  const auto messages = records_of(chunk.messages);
  REQUIRE(messages.size() == 3);
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(messages[k].opcode == 5);
    Fields message(messages[k].content);
    CHECK(message.number(2) == channel_id);
    CHECK(message.number(4) == k);
    CHECK(message.number(8) == 1'000'000 * (k + 1));
    CHECK(message.number(8) == 1'000'000 * (k + 1));
    const Json json = Json::parse(message.rest());
    CHECK(json["timestamp"] == 0.001 * static_cast<double>(k + 1));
    CHECK(json["q2d"]["shoulder_active_joint"]["position"] == record.state.position[0]);
    CHECK(json["q2d"]["elbow_active_joint"]["command"] == record.command.effort[1]);
    CHECK(json["q2d"]["elbow_active_joint"]["reference"]["acceleration"] ==
          record.reference.acceleration[1]);
    CHECK(json["status"] == "overrun");
    CHECK(json["timing"]["update"] == Approx(20e-6));
  }
  Fields message_index(records[4].content);
  CHECK(message_index.number(2) == channel_id);
  CHECK(message_index.number(4) == 3 * 16);
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(message_index.number(8) == 1'000'000 * (k + 1));
    CHECK(message_index.number(8) == messages[k].start);
  }
  CHECK(message_index.empty());

  CHECK(records[6].content == records[1].content);
  CHECK(records[7].content == records[2].content);
  Fields statistics(records[8].content);
  CHECK(statistics.number(8) == 3);  // messages
  CHECK(statistics.number(2) == 1);  // schemas
  CHECK(statistics.number(4) == 1);  // channels
  CHECK(statistics.number(4) == 0);  // attachments
  CHECK(statistics.number(4) == 0);  // metadata
  CHECK(statistics.number(4) == 1);  // chunks
  CHECK(statistics.number(8) == 1'000'000);
  CHECK(statistics.number(8) == 3'000'000);
  CHECK(statistics.number(4) == 10);  // length of the map of message counts
  CHECK(statistics.number(2) == channel_id);
  CHECK(statistics.number(8) == 3);
  CHECK(statistics.empty());

  // As readers with random access do it: the footer says where the summary is.
  Fields footer(std::string_view(bytes).substr(bytes.size() - 8 - 20, 20));
  CHECK(footer.number(8) == records[6].start);
  CHECK(footer.number(8) == records[10].start);
  CHECK(footer.number(4) == 0);
  for (std::size_t k = 0; k < 4; ++k) {
    Fields offset(records[10 + k].content);
    CHECK(offset.number(1) == records[6 + k].opcode);
    CHECK(offset.number(8) == records[6 + k].start);
    CHECK(offset.number(8) == records[6 + k].content.size() + 9);
  }
}

TEST_CASE("the index of the chunks leads to every message") {
  const support::ScratchFile file("many.mcap");
  constexpr std::uint64_t count = 5000;
  const auto text = [](std::uint64_t k) {
    return "{\"k\":" + std::to_string(k) + ",\"x\":\"" + std::string(700, 'x') + "\"}";
  };
  McapWriter writer(file.path(), "cycle", "K", "{}");
  for (std::uint64_t k = 0; k < count; ++k) {
    writer.write(std::chrono::milliseconds(k ^ 3), text(k));  // not in the order of time
  }
  writer.close();
  const std::string bytes = content_of(file.path());
  std::uint64_t found = 0, chunks = 0;
  std::vector<RawRecord> indexes;
  for (const RawRecord& record : records_of_file(bytes)) {
    if (record.opcode == 8) indexes.push_back(record);
    chunks += record.opcode == 6;
  }
  CHECK(chunks > 2);
  REQUIRE(indexes.size() == chunks);
  for (const RawRecord& record : indexes) {
    Fields index(record.content);
    const std::uint64_t first = index.number(8), last = index.number(8);
    const std::uint64_t start = index.number(8), length = index.number(8);
    const auto at_start = records_of(std::string_view(bytes).substr(0, start + length), start);
    REQUIRE(at_start.size() == 1);
    REQUIRE(at_start[0].opcode == 6);
    const Chunk chunk = chunk_of(at_start[0]);
    CHECK(chunk.first == first);
    CHECK(chunk.last == last);
    CHECK(index.number(4) == 10);  // one channel
    CHECK(index.number(2) == 1);
    const std::uint64_t message_index = index.number(8), index_length = index.number(8);
    CHECK(index.text().empty());
    CHECK(index.number(8) == chunk.messages.size());
    CHECK(index.number(8) == chunk.messages.size());
    CHECK(index.empty());
    const auto entries_record =
        records_of(std::string_view(bytes).substr(0, message_index + index_length), message_index);
    REQUIRE(entries_record.size() == 1);
    REQUIRE(entries_record[0].opcode == 7);
    Fields entries(entries_record[0].content);
    CHECK(entries.number(2) == 1);
    for (std::size_t left = entries.number(4); left > 0; left -= 16) {
      const std::uint64_t time = entries.number(8), offset = entries.number(8);
      CHECK((first <= time && time <= last));
      const auto at_offset = records_of(chunk.messages, offset);
      REQUIRE(!at_offset.empty());
      const Message message = message_of(at_offset[0]);
      CHECK(message.sequence == found);
      CHECK(message.time == time);
      CHECK(message.text == text(found));
      ++found;
    }
    CHECK(entries.empty());
  }
  CHECK(found == count);
  CHECK(messages_from_the_front(bytes).size() == count);
}

TEST_CASE("a file that was never closed has all messages, wherever it ends") {
  const support::ScratchFile file("open.mcap");
  const std::string text(3'750, 'x');  // 18 of them complete a chunk
  McapWriter writer(file.path(), "cycle", "K", "{}");
  for (std::size_t k = 0; k < 40; ++k) writer.write(std::chrono::milliseconds(k), text);
  const std::string bytes = content_of(file.path());  // as a crash would leave it
  const auto all = messages_from_the_front(bytes);
  const std::size_t count = all.size();
  REQUIRE(count >= 37);  // the last ones may still be in the stream's buffer
  for (std::size_t k = 0; k < count; ++k) CHECK(all[k].sequence == k);

  // As the file was while the third chunk was being filled: cut within it.
  std::size_t third = 0;
  for (const RawRecord& record : records_of(bytes, magic.size())) {
    if (record.opcode == 6) third = record.start;
  }
  REQUIRE(chunk_of(records_of(bytes, third)[0]).messages.empty());
  const std::size_t size = text.size() + 9 + 22, head = 9 + 40;  // of a message, of a chunk
  const std::size_t before = count - (bytes.size() - third - head) / size;
  CHECK(before == 36);
  for (std::size_t cut = third; cut <= bytes.size(); cut += 997) {
    const std::size_t whole = cut < third + head ? 0 : (cut - third - head) / size;
    CHECK(messages_from_the_front(bytes.substr(0, cut)).size() == before + whole);
  }
  // A copy that lacks its end, in the middle of a chunk that is complete.
  for (std::size_t cut = 500; cut < third; cut += 997) {
    const std::size_t reached = cut / size;
    CHECK(messages_from_the_front(bytes.substr(0, cut)).size() + 18 >= reached);
  }
}

TEST_CASE("a command of several numbers is an object of its members") {
  CycleRecord<2, MultiModeCommand<2>> record;
  record.command = {{1, 2}, {3, 4}, {5, 6}, {7, 8}, {9, 10}};
  const Json json = record_json(Q2d(), record, RecordExtras<Q2d>(Q2d(), {}));
  const Json& command = json["q2d"]["elbow_active_joint"]["command"];
  CHECK(command["position"] == 2);
  CHECK(command["velocity"] == 4);
  CHECK(command["stiffness"] == 6);
  CHECK(command["damping"] == 8);
  CHECK(command["effort"] == 10);
  const Json schema = schema_of(json);
  CHECK(schema["properties"]["q2d"]["properties"]["elbow_active_joint"]["properties"]["command"]
              ["properties"]["damping"]["type"] == "number");
}

TEST_CASE("a writer that ends completes its file as close() does, which may be called twice") {
  const support::ScratchFile closed("closed.mcap"), left("left.mcap"), moved("moved.mcap");
  const auto fill = [](McapWriter& writer) {
    for (int k = 0; k < 3; ++k) writer.write(std::chrono::milliseconds(k), "{}");
  };
  {
    McapWriter writer(closed.path(), "cycle", "K", "{}");
    fill(writer);
    writer.close();
    const std::string complete = content_of(closed.path());
    writer.close();
    CHECK(content_of(closed.path()) == complete);
    CHECK_THROWS_WITH(writer.write(std::chrono::milliseconds(4), "{}"),
                      "cannot write " + closed.path().string() + ": Bad file descriptor");
    CHECK_NOTHROW(writer.close());
  }
  {
    McapWriter writer(left.path(), "cycle", "K", "{}");
    fill(writer);
  }
  {
    McapWriter first(moved.path(), "cycle", "K", "{}");
    fill(first);
    const McapWriter second(std::move(first));
  }
  const std::string complete = content_of(closed.path());
  CHECK(records_of_file(complete).back().opcode == 2);  // the footer
  CHECK(content_of(left.path()) == complete);
  CHECK(content_of(moved.path()) == complete);
}

TEST_CASE("records that were written are in a complete file without a call of close()") {
  const support::ScratchFile file("record.mcap");
  {
    McapRecordWriter<Q2d, EffortCommand<2>> writer(file.path());
    writer.write(support::some_record());
  }
  const std::string bytes = content_of(file.path());
  CHECK(bytes.substr(bytes.size() - 8) == magic);
  CHECK(messages_from_the_front(bytes).size() == 1);
}

TEST_CASE("what cannot be written is an error of close(), not of the destructor") {
  if (!std::filesystem::exists("/dev/full")) return;
  CHECK_NOTHROW([] { McapWriter writer("/dev/full", "a", "A", "{}"); }());
  McapWriter writer("/dev/full", "a", "A", "{}");
  CHECK_THROWS_WITH(writer.close(), "cannot write /dev/full: No space left on device");
  CHECK_NOTHROW(writer.close());
}

TEST_CASE("an MCAP file without messages is one, too") {
  const support::ScratchFile file("empty.mcap");
  McapWriter writer(file.path(), "nothing", "Nothing", "{}");
  writer.close();
  const auto records = records_of_file(content_of(file.path()));
  REQUIRE(records.size() == 11);
  REQUIRE(records[6].opcode == 11);
  Fields statistics(records[6].content);
  CHECK(statistics.number(8) == 0);
  static_cast<void>(statistics.bytes(18));
  CHECK(statistics.number(8) == 0);
  CHECK(statistics.number(8) == 0);
}

TEST_CASE("an MCAP file that cannot be written is an error") {
  CHECK_THROWS_WITH(McapWriter("/nowhere/a.mcap", "a", "A", "{}"),
                    "cannot write /nowhere/a.mcap: No such file or directory");
}

TEST_CASE("cycles are written as messages of ROS 2, on topics with an index each") {
  const support::ScratchFile file("ros.mcap");
  using States = ros2::sensor_msgs::msg::JointState<ros2::Jazzy>;
  constexpr int cycles = 300;  // more than one chunk
  auto record = support::some_record();
  {
    RosRecordWriter writer(file.path(), {"shoulder", "elbow"});
    for (int k = 0; k < cycles; ++k) {
      record.time = 1.25 + k;
      writer.write(record);
    }
    writer.close();
  }
  const std::string bytes = content_of(file.path());
  const auto records = records_of_file(bytes);
  CHECK(Fields(records.at(0).content).text() == "ros2");  // the profile

  std::vector<std::string> topics;
  std::vector<std::vector<States>> messages(4);  // by channel, from 1
  std::size_t chunks = 0;
  std::vector<std::size_t> indexed(4);
  for (const RawRecord& own : records) {
    Fields fields(own.content);
    if (own.opcode == 3 && topics.size() < 3) {
      CHECK(fields.number(2) == topics.size() + 1);
      CHECK(fields.text() == "sensor_msgs/msg/JointState");
      CHECK(fields.text() == "ros2msg");
      CHECK(
          fields.text().starts_with("std_msgs/Header header\nstring[] name\nfloat64[] position\n"));
    }
    if (own.opcode == 4 && topics.size() < 3) {
      CHECK(fields.number(2) == topics.size() + 1);
      CHECK(fields.number(2) == topics.size() + 1);
      topics.emplace_back(fields.text());
      CHECK(fields.text() == "cdr");
    }
    if (own.opcode == 6) {
      ++chunks;
      for (const RawRecord& inner : records_of(chunk_of(own).messages)) {
        Fields message(inner.content);
        const std::size_t channel = message.number(2);
        CHECK(message.number(4) == messages.at(channel).size());  // counted by channel
        const std::uint64_t time = message.number(8);
        message.number(8);
        const std::string_view cdr = message.rest();
        States states;
        REQUIRE(ros2::decode(std::as_bytes(std::span(cdr)), states) == ros2::CdrError::none);
        CHECK(static_cast<std::uint64_t>(states.header.stamp.sec) * 1'000'000'000 +
                  states.header.stamp.nanosec ==
              time);
        messages.at(channel).push_back(states);
      }
    }
    if (own.opcode == 7) {
      const std::size_t channel = fields.number(2);
      Fields places(fields.text());
      while (!places.empty()) {
        const std::uint64_t time = places.number(8), place = places.number(8);
        ++indexed.at(channel);
        // Where the index says, there is a message of this channel and time.
        std::size_t chunk = 0;
        for (const RawRecord& other : records) {
          if (other.opcode == 6 && other.start < own.start) chunk = other.start;
        }
        Fields message(std::string_view(bytes).substr(chunk + 9 + 40 + place, 9 + 14));
        CHECK(message.number(1) == 5);
        message.number(8);
        CHECK(message.number(2) == channel);
        message.number(4);
        CHECK(message.number(8) == time);
      }
    }
    if (own.opcode == 11) {
      CHECK(fields.number(8) == 3 * cycles);
      CHECK(fields.number(2) == 3);
      CHECK(fields.number(4) == 3);
      fields.bytes(8);
      CHECK(fields.number(4) == chunks);
    }
  }
  CHECK(topics == std::vector<std::string>{"/joint_states", "/reference", "/command"});
  CHECK(chunks > 1);
  for (const std::size_t channel : {1U, 2U, 3U}) {
    REQUIRE(messages.at(channel).size() == cycles);
    CHECK(indexed.at(channel) == cycles);
    CHECK(messages.at(channel)[0].name == std::vector<std::string>{"shoulder", "elbow"});
  }
  using Values = std::vector<double>;
  const States& state = messages[1][2];
  CHECK(state.header.stamp.sec == 3);
  CHECK(state.header.stamp.nanosec == 250'000'000);
  CHECK(state.position == Values{1.0 / 3, -0.2});
  CHECK(state.velocity == Values{3.5, 4.5});
  CHECK(state.effort == Values{5.5, 6.5});
  CHECK(messages[2][2].position == Values{1.25, 2.25});
  CHECK(messages[2][2].effort == Values{7.25, 8.25});
  CHECK(messages[3][2].position.empty());
  CHECK(messages[3][2].effort == Values{1e-17, -13.62});
}

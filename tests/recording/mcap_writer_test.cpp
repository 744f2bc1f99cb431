// SPDX-License-Identifier: Apache-2.0
// MCAP files, read back by the specification: once from the front, once through the summary.
#include <articula/loop/mcap_record_writer.hpp>
#include <articula/robots/q2d.hpp>

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "catch.hpp"
#include "record.hpp"
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

/// All records of a file, from the front.
std::vector<RawRecord> records_of(const std::string& file) {
  std::vector<RawRecord> records;
  for (std::size_t at = magic.size(); at < file.size() - magic.size();) {
    Fields head(std::string_view(file).substr(at, 9));
    const std::uint64_t opcode = head.number(1);
    const std::size_t length = head.number(8);
    records.push_back({opcode, at, file.substr(at + 9, length)});
    REQUIRE(records.back().content.size() == length);
    at += 9 + length;
  }
  return records;
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
  const auto records = records_of(bytes);
  std::vector<std::uint64_t> opcodes;
  for (const RawRecord& r : records) opcodes.push_back(r.opcode);
  REQUIRE(opcodes == std::vector<std::uint64_t>{1, 3, 4, 5, 5, 5, 15, 3, 4, 11, 14, 14, 14, 2});

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

  for (std::size_t k = 0; k < 3; ++k) {
    Fields message(records[3 + k].content);
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

  CHECK(records[7].content == records[1].content);
  CHECK(records[8].content == records[2].content);
  Fields statistics(records[9].content);
  CHECK(statistics.number(8) == 3);  // messages
  CHECK(statistics.number(2) == 1);  // schemas
  CHECK(statistics.number(4) == 1);  // channels
  CHECK(statistics.number(4) == 0);  // attachments
  CHECK(statistics.number(4) == 0);  // metadata
  CHECK(statistics.number(4) == 0);  // chunks
  CHECK(statistics.number(8) == 1'000'000);
  CHECK(statistics.number(8) == 3'000'000);
  CHECK(statistics.number(4) == 10);  // length of the map of message counts
  CHECK(statistics.number(2) == channel_id);
  CHECK(statistics.number(8) == 3);
  CHECK(statistics.empty());

  // As readers with random access do it: the footer tells where the summary is.
  Fields footer(std::string_view(bytes).substr(bytes.size() - 8 - 20, 20));
  CHECK(footer.number(8) == records[7].start);
  CHECK(footer.number(8) == records[10].start);
  CHECK(footer.number(4) == 0);
  for (std::size_t k = 0; k < 3; ++k) {
    Fields offset(records[10 + k].content);
    CHECK(offset.number(1) == records[7 + k].opcode);
    CHECK(offset.number(8) == records[7 + k].start);
    CHECK(offset.number(8) == records[7 + k].content.size() + 9);
  }
}

TEST_CASE("a command of several numbers is an object of its members") {
  CycleRecord<2, MultiModeCommand<2>> record;
  record.command = {{1, 2}, {3, 4}, {5, 6}, {7, 8}, {9, 10}};
  const Json json = record_json(Q2d(), record);
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

TEST_CASE("an MCAP file without messages is one, too") {
  const support::ScratchFile file("empty.mcap");
  McapWriter writer(file.path(), "nothing", "Nothing", "{}");
  writer.close();
  const auto records = records_of(content_of(file.path()));
  REQUIRE(records.size() == 11);
  REQUIRE(records[6].opcode == 11);
  Fields statistics(records[6].content);
  CHECK(statistics.number(8) == 0);
  static_cast<void>(statistics.bytes(18));
  CHECK(statistics.number(8) == 0);
  CHECK(statistics.number(8) == 0);
}

TEST_CASE("an MCAP file that cannot be written is an error") {
  CHECK_THROWS_WITH(McapWriter("/nowhere/a.mcap", "a", "A", "{}"), "cannot write /nowhere/a.mcap");
}

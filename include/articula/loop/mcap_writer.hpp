// SPDX-License-Identifier: Apache-2.0
/// @file Timed JSON messages in an MCAP file.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>

namespace articula {

/// Writes JSON messages of one topic to an MCAP file, which PlotJuggler and Foxglove open.
/// Source: [MCAP], the records Header, Schema, Channel, Message, Data End, Statistics, Summary
/// Offset and Footer. There are no chunks, so that all messages of a file that was never closed can
/// still be read, and no checksums.
class McapWriter {
 public:
  /// @param path         the file
  /// @param topic        name of the topic
  /// @param schema_name  name of the messages' type
  /// @param schema       of the messages, as JSON Schema
  /// @throws std::runtime_error if the file cannot be written
  McapWriter(const std::filesystem::path& path, std::string_view topic,
             std::string_view schema_name, std::string_view schema)
      : path_(path.string()), file_(path, std::ios::binary) {
    Bytes header;
    header.text("").text("articula");
    schema_.number(id, 2).text(schema_name).text("jsonschema").text(schema);
    channel_.number(id, 2).number(id, 2).text(topic).text("json").number(0, 4);
    put(magic);
    put(0x01, header);
    put(0x03, schema_);
    put(0x04, channel_);
    check();
  }

  /// Appends a message.
  /// @param time     since any moment, >= 0
  /// @param message  JSON
  /// @throws std::runtime_error if it cannot be written
  void write(std::chrono::nanoseconds time, std::string_view message) {
    const auto stamp = static_cast<std::uint64_t>(time.count());
    first_ = std::min(first_, stamp);
    last_ = std::max(last_, stamp);
    Bytes content;
    content.number(id, 2).number(count_++, 4).number(stamp, 8).number(stamp, 8);
    content.data += message;
    put(0x05, content);
    check();
  }

  /// Completes the file with its summary, which readers use as a table of contents.
  /// @throws std::runtime_error if not all could be written
  void close() {
    put(0x0f, Bytes().number(0, 4));
    struct Group {
      unsigned char opcode;
      std::uint64_t start, length;
    };
    Bytes statistics;
    statistics.number(count_, 8).number(1, 2).number(1, 4).number(0, 4).number(0, 4).number(0, 4);
    statistics.number(count_ == 0 ? 0 : first_, 8).number(last_, 8);
    statistics.number(10, 4).number(id, 2).number(count_, 8);
    const std::uint64_t summary = size_;
    std::array<Group, 3> groups{{{0x03, 0, 0}, {0x04, 0, 0}, {0x0b, 0, 0}}};
    const std::array<const Bytes*, 3> contents{&schema_, &channel_, &statistics};
    for (std::size_t i = 0; i < groups.size(); ++i) {
      groups[i].start = size_;
      put(groups[i].opcode, *contents[i]);
      groups[i].length = size_ - groups[i].start;
    }
    const std::uint64_t offsets = size_;
    for (const Group& group : groups) {
      put(0x0e, Bytes().number(group.opcode, 1).number(group.start, 8).number(group.length, 8));
    }
    put(0x02, Bytes().number(summary, 8).number(offsets, 8).number(0, 4));
    put(magic);
    file_.close();
    check();
  }

 private:
  static constexpr std::string_view magic{"\x89MCAP0\r\n", 8};
  static constexpr std::uint64_t id = 1;  ///< of the one schema and the one channel

  /// The content of a record: numbers with the least significant byte first, texts after their
  /// length.
  struct Bytes {
    std::string data;

    Bytes& number(std::uint64_t value, int bytes) {
      for (int i = 0; i < bytes; ++i, value >>= 8) data += static_cast<char>(value & 0xff);
      return *this;
    }
    Bytes& text(std::string_view characters) {
      number(characters.size(), 4);
      data += characters;
      return *this;
    }
  };

  void put(std::string_view bytes) {
    file_ << bytes;
    size_ += bytes.size();
  }
  void put(unsigned char opcode, const Bytes& content) {
    put(Bytes().number(opcode, 1).number(content.data.size(), 8).data);
    put(content.data);
  }
  void check() const {
    if (!file_) throw std::runtime_error("cannot write " + path_);
  }

  std::string path_;
  std::ofstream file_;
  Bytes schema_;
  Bytes channel_;
  std::uint64_t size_ = 0;   ///< of what was written [bytes]
  std::uint64_t count_ = 0;  ///< messages
  std::uint64_t first_ = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t last_ = 0;
};

}  // namespace articula

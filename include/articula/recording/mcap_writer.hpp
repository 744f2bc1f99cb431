// SPDX-License-Identifier: Apache-2.0
/// @file Writes timed JSON messages to an MCAP file.
#pragma once

#include "articula/recording/output_file.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace articula {

/// Writes JSON messages of one topic to an MCAP file, which PlotJuggler and Foxglove open.
/// Source: [MCAP], the records Header, Schema, Channel, Chunk, Message, Message Index, Data End,
/// Statistics, Chunk Index, Summary Offset and Footer. There is no compression and no checksum.
///
/// Readers with random access need chunks and their index. Readers of a file that was never closed
/// need messages outside of unfinished chunks. So a chunk is written empty, its messages follow it,
/// and when they fill it, its length is set to contain them. A file that was never closed has all
/// messages that were written. A truncated file has those of all chunks before the truncated one.
class McapWriter {
 public:
  /// Size of the messages at which a chunk is complete [bytes]. Readers load whole chunks.
  static constexpr std::uint64_t chunk_size = 1 << 16;

  /// @param path         the file; not a pipe, since it must be seekable
  /// @param topic        name of the topic
  /// @param schema_name  name of the messages' type
  /// @param schema       of the messages, as JSON Schema
  /// @throws std::runtime_error if the file cannot be written
  McapWriter(const std::filesystem::path& path, std::string_view topic,
             std::string_view schema_name, std::string_view schema)
      : file_(path) {
    Bytes header;
    header.text("").text("articula");
    schema_.number(id, 2).text(schema_name).text("jsonschema").text(schema);
    channel_.number(id, 2).number(id, 2).text(topic).text("json").number(0, 4);
    put(magic);
    put(0x01, header);
    put(0x03, schema_);
    put(0x04, channel_);
    file_.check();
  }
  /// Completes the file if it is open. Call close() to get its errors.
  ~McapWriter() {
    try {
      close();
    } catch (...) {  // NOLINT(bugprone-empty-catch): a destructor does not throw
    }
  }
  McapWriter(McapWriter&&) noexcept = default;
  McapWriter& operator=(McapWriter&&) = delete;

  /// Appends a message.
  /// @param time     since any moment, >= 0
  /// @param message  JSON
  /// @throws std::runtime_error if it cannot be written
  void write(std::chrono::nanoseconds time, std::string_view message) {
    const auto stamp = static_cast<std::uint64_t>(time.count());
    if (chunk_.index.data.empty()) {
      chunk_.start = size_;
      put(0x06, chunk_header({0, 0}, 0));
    }
    chunk_.index.number(stamp, 8).number(size_ - content_start(), 8);
    chunk_.times.add(stamp);
    times_.add(stamp);
    Bytes content;
    content.number(id, 2).number(count_++, 4).number(stamp, 8).number(stamp, 8);
    content.data += message;
    put(0x05, content);
    if (size_ - content_start() >= chunk_size) complete_chunk();
    file_.check();
  }

  /// Completes the file with its summary, the table of contents for readers. Does nothing if the file
  /// is closed already.
  /// @throws std::runtime_error if not all could be written
  void close() {
    if (!file_.is_open()) return;
    complete_chunk();
    put(0x0f, Bytes().number(0, 4));
    Bytes statistics;
    statistics.number(count_, 8).number(1, 2).number(1, 4).number(0, 4).number(0, 4);
    statistics.number(chunk_indexes_.size(), 4);
    statistics.number(count_ == 0 ? 0 : times_.first, 8).number(times_.last, 8);
    statistics.number(10, 4).number(id, 2).number(count_, 8);
    const std::uint64_t summary = size_;
    Bytes offsets;
    const auto put_group = [&](unsigned char opcode, std::span<const Bytes> contents) {
      if (contents.empty()) return;
      const std::uint64_t start = size_;
      for (const Bytes& content : contents) put(opcode, content);
      offsets.number(0x0e, 1).number(1 + 8 + 8, 8);
      offsets.number(opcode, 1).number(start, 8).number(size_ - start, 8);
    };
    put_group(0x03, {&schema_, 1});
    put_group(0x04, {&channel_, 1});
    put_group(0x0b, {&statistics, 1});
    put_group(0x08, chunk_indexes_);
    const std::uint64_t summary_offsets = size_;
    put(offsets.data);
    put(0x02, Bytes().number(summary, 8).number(summary_offsets, 8).number(0, 4));
    put(magic);
    file_.close();
    file_.check();
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

  /// Bytes of a Chunk record before its messages: opcode, length, two times, size, checksum,
  /// compression (an empty text) and the messages' length.
  static constexpr std::uint64_t chunk_prefix = 1 + 8 + 8 + 8 + 8 + 4 + 4 + 8;

  /// The earliest and the latest time of messages.
  struct Times {
    std::uint64_t first = std::numeric_limits<std::uint64_t>::max(), last = 0;

    void add(std::uint64_t time) {
      first = std::min(first, time);
      last = std::max(last, time);
    }
  };

  /// The chunk that is being filled.
  struct OpenChunk {
    std::uint64_t start = 0;  ///< of its record in the file
    Times times{};
    Bytes index{};  ///< time and position of each message
  };

  [[nodiscard]] std::uint64_t content_start() const { return chunk_.start + chunk_prefix; }

  /// The fields of a Chunk record before its messages.
  /// @param length  of the messages that belong to it [bytes]
  [[nodiscard]] static Bytes chunk_header(const Times& times, std::uint64_t length) {
    Bytes header;
    header.number(times.first, 8).number(times.last, 8).number(length, 8).number(0, 4).text("");
    return header.number(length, 8);
  }

  /// Sets the length of the chunk to contain the messages after it, and adds its index.
  void complete_chunk() {
    if (chunk_.index.data.empty()) return;
    const std::uint64_t content = size_ - content_start(), length = size_ - chunk_.start;
    const auto& [first, last] = chunk_.times;
    const Bytes header = chunk_header(chunk_.times, content);
    file_.replace(length - 1, Bytes().number(length - 9, 8).data + header.data);

    const std::uint64_t message_index = size_;
    put(0x07, Bytes().number(id, 2).text(chunk_.index.data));
    Bytes index;
    index.number(first, 8).number(last, 8).number(chunk_.start, 8).number(length, 8);
    index.number(2 + 8, 4).number(id, 2).number(message_index, 8);
    index.number(size_ - message_index, 8).text("").number(content, 8).number(content, 8);
    chunk_indexes_.push_back(index);
    chunk_ = {};
  }

  void put(std::string_view bytes) {
    file_.write(bytes);
    size_ += bytes.size();
  }
  void put(unsigned char opcode, const Bytes& content) {
    put(Bytes().number(opcode, 1).number(content.data.size(), 8).data);
    put(content.data);
  }

  detail::OutputFile file_;
  Bytes schema_;
  Bytes channel_;
  OpenChunk chunk_;
  std::vector<Bytes> chunk_indexes_;
  std::uint64_t size_ = 0;   ///< of what was written [bytes]
  std::uint64_t count_ = 0;  ///< messages
  Times times_;
};

}  // namespace articula

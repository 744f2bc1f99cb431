// SPDX-License-Identifier: Apache-2.0
/// @file Writes timed messages to an MCAP file.
#pragma once

#include "articula/recording/output_file.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace articula {

/// A topic of an MCAP file, and what its messages are.
struct McapTopic {
  std::string name{};
  std::string type{};                          ///< name of the messages' type
  std::string schema{};                        ///< of that type
  std::string schema_encoding = "jsonschema";  ///< or "ros2msg"
  std::string encoding = "json";               ///< of the messages, or "cdr"
};

/// Writes messages to an MCAP file, which PlotJuggler and Foxglove open.
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

  /// @param path     the file; not a pipe, since it must be seekable
  /// @param topics   at least one
  /// @param profile  of all topics: "ros2", or none
  /// @throws std::runtime_error if the file cannot be written
  McapWriter(const std::filesystem::path& path, const std::vector<McapTopic>& topics,
             std::string_view profile = {})
      : file_(path), channels_(topics.size()) {
    put(magic);
    put(0x01, Bytes().text(profile).text("articula"));
    for (std::size_t i = 0; i < topics.size(); ++i) {
      const McapTopic& topic = topics[i];
      Channel& channel = channels_[i];
      channel.schema.number(id_of(i), 2).text(topic.type);
      channel.schema.text(topic.schema_encoding).text(topic.schema);
      channel.record.number(id_of(i), 2).number(id_of(i), 2);
      channel.record.text(topic.name).text(topic.encoding).number(0, 4);
      put(0x03, channel.schema);
      put(0x04, channel.record);
    }
    file_.check();
  }
  /// With one topic, whose messages are JSON.
  /// @param path         of the file
  /// @param topic        name of the topic
  /// @param schema_name  name of the messages' type
  /// @param schema       of the messages, as JSON Schema
  /// @throws std::runtime_error if the file cannot be written
  McapWriter(const std::filesystem::path& path, std::string_view topic,
             std::string_view schema_name, std::string_view schema)
      : McapWriter(path, {{.name = std::string(topic),
                           .type = std::string(schema_name),
                           .schema = std::string(schema)}}) {}
  /// Completes the file if it is open. Call close() to get its errors.
  ~McapWriter() {
    try {
      close();
    } catch (...) {  // NOLINT(bugprone-empty-catch): a destructor does not throw
    }
  }
  McapWriter(McapWriter&&) noexcept = default;
  McapWriter& operator=(McapWriter&&) = delete;

  /// Appends a message of the first topic.
  /// @param time     since any moment, >= 0
  /// @param message  its bytes
  /// @throws std::runtime_error if it cannot be written
  void write(std::chrono::nanoseconds time, std::string_view message) { write(0, time, message); }
  /// Appends a message.
  /// @param topic  index in the topics of the constructor
  void write(std::size_t topic, std::chrono::nanoseconds time, std::string_view message) {
    const auto stamp = static_cast<std::uint64_t>(time.count());
    if (!is_chunk_open_) {
      is_chunk_open_ = true;
      chunk_start_ = size_;
      put(0x06, chunk_header({0, 0}, 0));
    }
    Channel& channel = channels_[topic];
    channel.index.number(stamp, 8).number(size_ - content_start(), 8);
    chunk_times_.add(stamp);
    times_.add(stamp);
    Bytes content;
    content.number(id_of(topic), 2).number(channel.count++, 4).number(stamp, 8).number(stamp, 8);
    content.data += message;
    put(0x05, content);
    ++count_;
    if (size_ - content_start() >= chunk_size) complete_chunk();
    file_.check();
  }

  /// Completes the file with its summary, the table of contents for readers. Does nothing if the
  /// file is closed already.
  /// @throws std::runtime_error if not all could be written
  void close() {
    if (!file_.is_open()) return;
    complete_chunk();
    put(0x0f, Bytes().number(0, 4));
    Bytes statistics;
    statistics.number(count_, 8).number(channels_.size(), 2).number(channels_.size(), 4);
    statistics.number(0, 4).number(0, 4);
    statistics.number(chunk_indexes_.size(), 4);
    statistics.number(count_ == 0 ? 0 : times_.first, 8).number(times_.last, 8);
    statistics.number(10 * channels_.size(), 4);
    std::vector<Bytes> schemas, channels;
    for (std::size_t i = 0; i < channels_.size(); ++i) {
      statistics.number(id_of(i), 2).number(channels_[i].count, 8);
      schemas.push_back(channels_[i].schema);
      channels.push_back(channels_[i].record);
    }
    const std::uint64_t summary = size_;
    Bytes offsets;
    const auto put_group = [&](unsigned char opcode, std::span<const Bytes> contents) {
      if (contents.empty()) return;
      const std::uint64_t start = size_;
      for (const Bytes& content : contents) put(opcode, content);
      offsets.number(0x0e, 1).number(1 + 8 + 8, 8);
      offsets.number(opcode, 1).number(start, 8).number(size_ - start, 8);
    };
    put_group(0x03, schemas);
    put_group(0x04, channels);
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

  /// The number of a topic's channel and schema. 0 means none.
  [[nodiscard]] static std::uint64_t id_of(std::uint64_t index) { return index + 1; }

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

  /// A topic, and its messages in the chunk that is being filled.
  struct Channel {
    Bytes schema{}, record{};
    std::uint64_t count = 0;  ///< messages in the file
    Bytes index{};            ///< time and position of each message of the chunk
  };

  [[nodiscard]] std::uint64_t content_start() const { return chunk_start_ + chunk_prefix; }

  /// The fields of a Chunk record before its messages.
  /// @param length  of the messages that belong to it [bytes]
  [[nodiscard]] static Bytes chunk_header(const Times& times, std::uint64_t length) {
    Bytes header;
    header.number(times.first, 8).number(times.last, 8).number(length, 8).number(0, 4).text("");
    return header.number(length, 8);
  }

  /// Sets the length of the chunk to contain the messages after it, and adds its index.
  void complete_chunk() {
    if (!is_chunk_open_) return;
    const std::uint64_t content = size_ - content_start(), length = size_ - chunk_start_;
    const auto& [first, last] = chunk_times_;
    const Bytes header = chunk_header(chunk_times_, content);
    file_.replace(length - 1, Bytes().number(length - 9, 8).data + header.data);

    const std::uint64_t message_indexes = size_;
    Bytes places;  // of the index of each channel
    for (std::size_t i = 0; i < channels_.size(); ++i) {
      if (channels_[i].index.data.empty()) continue;
      places.number(id_of(i), 2).number(size_, 8);
      put(0x07, Bytes().number(id_of(i), 2).text(channels_[i].index.data));
      channels_[i].index = {};
    }
    Bytes index;
    index.number(first, 8).number(last, 8).number(chunk_start_, 8).number(length, 8);
    index.text(places.data).number(size_ - message_indexes, 8).text("");
    index.number(content, 8).number(content, 8);
    chunk_indexes_.push_back(index);
    chunk_times_ = {};
    is_chunk_open_ = false;
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
  std::vector<Channel> channels_;
  bool is_chunk_open_ = false;
  std::uint64_t chunk_start_ = 0;  ///< of its record in the file
  Times chunk_times_{};
  std::vector<Bytes> chunk_indexes_{};
  std::uint64_t size_ = 0;   ///< of what was written [bytes]
  std::uint64_t count_ = 0;  ///< messages
  Times times_;
};

}  // namespace articula

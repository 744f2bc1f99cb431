// SPDX-License-Identifier: Apache-2.0
/// @file Reads timed messages of an MCAP file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

namespace articula {

/// Reads what McapWriter wrote: the messages of all channels, in the order of the file, in chunks
/// and outside of them. A file that was never closed, or that lacks its end, is read as far as it
/// goes. Source: [MCAP].
///
/// Of other writers' files it reads those whose chunks are not compressed. Checksums are not
/// compared.
class McapReader {
 public:
  /// Called with the time [ns] and the bytes of each message, which are valid during the call.
  using Sink = std::function<void(std::uint64_t time, std::string_view message)>;

  /// @throws std::runtime_error naming the file, if it cannot be read or is no MCAP file
  /// Real-time: no (allocates, calls the system).
  explicit McapReader(const std::filesystem::path& path) : path_(path.string()) {
    const std::unique_ptr<std::FILE, Close> file(std::fopen(path_.c_str(), "rb"));
    if (!file) throw std::runtime_error("cannot read " + path_);
    char block[1 << 16];
    for (std::size_t size = 0; (size = std::fread(block, 1, sizeof block, file.get())) > 0;) {
      bytes_.append(block, size);
    }
    if (!bytes_.starts_with(magic)) refuse("is no MCAP file");
  }

  /// Calls a function with each message.
  /// @throws std::runtime_error naming the file, if a chunk is compressed or a record is broken;
  ///         and what the sink throws
  /// Real-time: no (throws).
  void read(const Sink& sink) const { read(std::string_view(bytes_).substr(magic.size()), sink); }

 private:
  static constexpr std::string_view magic{"\x89MCAP0\r\n", 8};
  static constexpr std::size_t record_head = 1 + 8;           ///< opcode, length
  static constexpr std::size_t chunk_head = 8 + 8 + 8 + 4;    ///< times, size, checksum
  static constexpr std::size_t message_head = 2 + 4 + 8 + 8;  ///< channel, number, two times

  struct Close {
    void operator()(std::FILE* file) const noexcept { static_cast<void>(std::fclose(file)); }
  };

  [[noreturn]] void refuse(std::string_view what) const {
    throw std::runtime_error(path_ + " " + std::string(what));
  }

  /// A number whose least significant byte comes first.
  [[nodiscard]] static std::uint64_t number(std::string_view bytes) noexcept {
    std::uint64_t value = 0;
    for (std::size_t i = bytes.size(); i-- > 0;) {
      value = value << 8 | static_cast<unsigned char>(bytes[i]);
    }
    return value;
  }

  void read(std::string_view records, const Sink& sink) const {
    while (records.size() >= record_head) {
      const auto opcode = static_cast<unsigned char>(records[0]);
      const std::uint64_t length = number(records.substr(1, 8));
      records.remove_prefix(record_head);
      if (opcode == 0x0f || opcode == 0x02) return;  // the end of the data; the summary repeats
      const std::string_view content = records.substr(0, length);
      const bool is_cut = content.size() < length;
      if (opcode == 0x06) read_chunk(content, sink);
      if (is_cut) return;
      if (opcode == 0x05) {
        if (content.size() < message_head) refuse("has a message without its head");
        sink(number(content.substr(6, 8)), content.substr(message_head));
      }
      records.remove_prefix(length);
    }
  }

  void read_chunk(std::string_view content, const Sink& sink) const {
    if (content.size() < chunk_head + 4) return;  // the file ends here
    content.remove_prefix(chunk_head);
    const std::uint64_t name_length = number(content.substr(0, 4));
    if (name_length > 0) refuse("has compressed chunks, which this reader does not unpack");
    if (content.size() < 4 + 8) return;
    const std::uint64_t length = number(content.substr(4, 8));
    read(content.substr(4 + 8, length), sink);
  }

  std::string path_;
  std::string bytes_{};
};

}  // namespace articula

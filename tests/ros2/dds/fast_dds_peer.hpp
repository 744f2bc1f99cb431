// SPDX-License-Identifier: Apache-2.0
/// @file A peer in tests that uses Fast DDS as rmw_fastrtps does, with messages as bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

using Bytes = std::vector<std::byte>;

/// A participant of Fast DDS on loopback, with the classes of DDS. Messages within the process take
/// the way over UDP, too.
class FastDdsPeer {
 public:
  struct Options {
    bool poses_as_cyclone = false;  ///< its identifier begins as those of Cyclone DDS
    int depth = 100;                ///< of the histories of writers and readers
    bool joins_group = false;       ///< readers listen to an address of a group, too
    /// Whether a message of a writer is lost on its way, or a fragment of it. Called each time it is
    /// sent. Fragments are numbered from 1; 0 is a whole message.
    std::function<bool(std::uint32_t message, std::uint32_t fragment)> loses{};
  };
  explicit FastDdsPeer(unsigned domain) : FastDdsPeer(domain, Options{}) {}
  FastDdsPeer(unsigned domain, const Options& options);
  FastDdsPeer(const FastDdsPeer&) = delete;
  FastDdsPeer& operator=(const FastDdsPeer&) = delete;
  ~FastDdsPeer();

  /// A writer or reader in the names of DDS, reliable by default. Returns its index.
  std::size_t make_writer(const std::string& topic, const std::string& type,
                          bool transient_local = false, bool best_effort = false);
  std::size_t make_reader(const std::string& topic, const std::string& type,
                          bool transient_local = false);
  void write(std::size_t writer, std::span<const std::byte> bytes);
  std::vector<Bytes> take(std::size_t reader);
  [[nodiscard]] std::size_t matches_of_writer(std::size_t writer) const;
  [[nodiscard]] std::size_t matches_of_reader(std::size_t reader) const;

  /// Sends a request for which a reader waits.
  /// @return its number
  std::int64_t request(std::size_t writer, std::size_t reader, std::span<const std::byte> bytes);
  struct Reply {
    std::int64_t sequence;
    bool is_mine;  ///< the reply names the reader
    Bytes bytes;
  };
  std::vector<Reply> take_replies(std::size_t reader);

 private:
  struct Entities;
  std::unique_ptr<Entities> entities_;
};

/// Lets no message pass by within a process. Before the first participant.
void talk_over_udp_only();

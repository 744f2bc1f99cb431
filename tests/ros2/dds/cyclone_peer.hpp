// SPDX-License-Identifier: Apache-2.0
/// @file Another vendor's DDS as peer in tests: Cyclone DDS, with the types of ROS.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// A participant of Cyclone DDS on loopback. Functions that wait do so for 10 s at most, and throw
/// std::runtime_error then.
class CyclonePeer {
 public:
  explicit CyclonePeer(unsigned domain);
  CyclonePeer(const CyclonePeer&) = delete;
  CyclonePeer& operator=(const CyclonePeer&) = delete;
  ~CyclonePeer();

  /// std_msgs/msg/String on a DDS topic. Returns a number for the functions below.
  /// @param user_data  bytes that its announcement has beside all else
  int make_writer(const std::string& topic, bool transient_local, std::size_t user_data = 0);
  int make_reader(const std::string& topic, bool transient_local);
  void write(int writer, const std::string& text);
  /// The texts that have come.
  std::vector<std::string> take(int reader);
  /// Peers that match a writer or a reader.
  std::size_t matches_of_writer(int writer);
  std::size_t matches_of_reader(int reader);

  /// sensor_msgs/msg/JointState on a DDS topic. Returns a number for the functions below.
  int make_states_reader(const std::string& topic);
  struct JointStates {
    std::vector<std::string> names;
    std::vector<double> positions;
  };
  /// The states that have come.
  std::vector<JointStates> take_states(int reader);

  /// A client of std_srvs/srv/Trigger in the dialect of rmw_cyclonedds. Reader and writer of a
  /// client come one by one.
  void make_request_writer(const std::string& service);
  void make_reply_reader(const std::string& service);
  /// In place of it, a client of controller_manager_msgs/srv/SwitchController of Jazzy.
  void make_switch_client(const std::string& service);
  /// Asks for a strict switch. The reply is that of `take_reply`.
  void request_switch(std::int64_t sequence, const std::vector<std::string>& activate,
                      const std::vector<std::string>& deactivate);
  /// Whether what there is of the client has its counterpart.
  [[nodiscard]] bool finds_service();
  /// Sends a request.
  void request(std::int64_t sequence);
  struct Reply {
    std::uint64_t client;
    std::int64_t sequence;
    bool success;
    std::string message;
  };
  std::optional<Reply> take_reply();
  [[nodiscard]] std::uint64_t client() const;

  /// A participant, reader or writer as this peer has discovered it.
  struct Discovered {
    std::array<std::uint8_t, 16> guid{};
    std::string user_data{};
  };
  std::vector<Discovered> participants();
  std::vector<Discovered> writers(const std::string& topic);
  std::vector<Discovered> readers(const std::string& topic);

 private:
  struct Entities;
  std::unique_ptr<Entities> entities_;
};

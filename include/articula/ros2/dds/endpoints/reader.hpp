// SPDX-License-Identifier: Apache-2.0
/// @file One reader of DDS, whose messages go to an inbox.
#pragma once

#include "articula/ros2/dds/endpoints/endpoint.hpp"
#include "articula/ros2/dds/endpoints/inbox.hpp"
#include "articula/ros2/dds/endpoints/waiting_messages.hpp"
#include "articula/ros2/dds/packets/packet_guard.hpp"

#include <fastdds/rtps/reader/RTPSReader.h>
#include <fastdds/rtps/reader/ReaderListener.h>

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace articula::ros2::dds {

/// A reliable reader. Each message leaves the history of Fast DDS as soon as it has come, so slow
/// users do not keep the peers' writers waiting.
class Reader final : public eprosima::fastrtps::rtps::ReaderListener {
 public:
  /// @param guard  of the participant's packets
  /// @throws std::runtime_error if Fast DDS refuses
  Reader(eprosima::fastrtps::rtps::RTPSParticipant& participant, std::shared_ptr<PacketGuard> guard,
         Inbox& inbox, const Endpoint& endpoint, std::function<void(Arrival&)> deliver);
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader() override;

  [[nodiscard]] const Matched& writers() const { return writers_; }
  [[nodiscard]] const eprosima::fastrtps::rtps::GUID_t& guid() const { return reader_->getGuid(); }

  /// That a writer is not heard which has come since the last call.
  [[nodiscard]] std::optional<std::string> warning();

  // Called by threads of Fast DDS.
  void onReaderMatched(eprosima::fastrtps::rtps::RTPSReader* reader,
                       eprosima::fastrtps::rtps::MatchingInfo& info) override;
  void onNewCacheChangeAdded(eprosima::fastrtps::rtps::RTPSReader* reader,
                             const eprosima::fastrtps::rtps::CacheChange_t* change) override;
  void on_requested_incompatible_qos(eprosima::fastrtps::rtps::RTPSReader* reader,
                                     eprosima::fastdds::dds::PolicyMask policies) override;
  using ReaderListener::onReaderMatched;

 private:
  std::shared_ptr<PacketGuard> guard_;
  Inbox* inbox_;
  std::string topic_;
  std::atomic<bool> is_unreliable_ = false, is_volatile_ = false;  ///< some writer that has come
  Inbox::Queue queue_;
  Matched writers_{};
  WaitingMessages history_;
  eprosima::fastrtps::rtps::RTPSReader* reader_;
};

}  // namespace articula::ros2::dds

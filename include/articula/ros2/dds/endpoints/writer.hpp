// SPDX-License-Identifier: Apache-2.0
/// @file One writer of DDS.
#pragma once

#include "articula/ros2/dds/endpoints/endpoint.hpp"
#include "articula/ros2/dds/endpoints/inbox.hpp"
#include "articula/ros2/dds/endpoints/payload_pool.hpp"
#include "articula/ros2/transport.hpp"

#include <fastdds/rtps/common/WriteParams.h>
#include <fastdds/rtps/history/WriterHistory.h>
#include <fastdds/rtps/writer/RTPSWriter.h>
#include <fastdds/rtps/writer/WriterListener.h>
#include <fastdds/rtps/writer/IReaderDataFilter.hpp>

#include <memory>
#include <string>

namespace articula::ros2::dds {

/// A reliable writer that keeps the last messages until all readers have them, and, if it is
/// transient local, for later readers.
class Writer final : public eprosima::fastrtps::rtps::WriterListener {
 public:
  /// @param filter  chooses the readers of each reply; nullptr: a topic's messages go to all
  /// @throws std::runtime_error if Fast DDS refuses
  Writer(eprosima::fastrtps::rtps::RTPSParticipant& participant, Inbox& inbox, Endpoint endpoint,
         eprosima::fastdds::rtps::IReaderDataFilter* filter = nullptr);
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  ~Writer() override;

  /// Sends a message. A volatile writer without readers sends nothing.
  /// @param related  the request that a reply belongs to
  /// @throws std::invalid_argument if the message is too large
  void write(Sample sample, const eprosima::fastrtps::rtps::SampleIdentity& related =
                                eprosima::fastrtps::rtps::SampleIdentity::unknown());

  /// Forgets messages whose lifespan is over.
  void forget_old();
  /// Asks the readers to say which messages they have.
  void request_acknowledgements();
  /// Waits until all readers have said that they have all messages, or until a time.
  /// @return whether they have
  bool await_acknowledgements(Inbox::Clock::time_point end);

  [[nodiscard]] const Matched& readers() const { return readers_; }
  [[nodiscard]] const eprosima::fastrtps::rtps::GUID_t& guid() const { return writer_->getGuid(); }

  // Called by threads of Fast DDS.
  void onWriterMatched(eprosima::fastrtps::rtps::RTPSWriter* writer,
                       eprosima::fastrtps::rtps::MatchingInfo& info) override;
  void onWriterChangeReceivedByAll(eprosima::fastrtps::rtps::RTPSWriter* writer,
                                   eprosima::fastrtps::rtps::CacheChange_t* change) override;
  using WriterListener::onWriterMatched;

 private:
  // Readers of Cyclone DDS that are volatile begin at the first heartbeat. A reply that comes
  // before it, behind replies to others, is lost to them. So is a message of which fragments come
  // before and after it. A heartbeat before the message prevents both.
  void send_heartbeat();

  Inbox* inbox_;
  Endpoint endpoint_;
  bool sends_replies_;
  Matched readers_{};
  std::shared_ptr<PayloadPool> pool_;
  eprosima::fastrtps::rtps::WriterHistory history_;
  eprosima::fastrtps::rtps::RTPSWriter* writer_;
};

}  // namespace articula::ros2::dds

// SPDX-License-Identifier: Apache-2.0
#include "articula/ros2/dds/fast_dds_transport.hpp"

#include "articula/ros2/dds/participant.hpp"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace articula::ros2 {

namespace {

// A topic's writer for the user, who may keep it longer than the transport.
class TopicWriter final : public SampleWriter {
 public:
  TopicWriter(const std::shared_ptr<dds::Participant>& participant, dds::Writer& writer)
      : participant_(participant), writer_(&writer) {}
  TopicWriter(const TopicWriter&) = delete;
  TopicWriter& operator=(const TopicWriter&) = delete;
  ~TopicWriter() override {
    if (const auto participant = participant_.lock()) participant->remove(*writer_);
  }

  void write(Sample sample) override {
    if (const auto participant = participant_.lock()) writer_->write(sample);
  }

  [[nodiscard]] std::size_t readers() const override {
    const auto participant = participant_.lock();
    return participant == nullptr ? 0 : writer_->readers().count();
  }

 private:
  std::weak_ptr<dds::Participant> participant_;
  dds::Writer* writer_;
};

}  // namespace

FastDdsTransport::FastDdsTransport(const FastDdsOptions& options, Distribution distribution)
    : participant_(std::make_shared<dds::Participant>(options, distribution)) {}

FastDdsTransport::~FastDdsTransport() = default;

std::unique_ptr<SampleWriter> FastDdsTransport::advertise(const TopicEndpoint& topic) {
  return std::make_unique<TopicWriter>(participant_, participant_->advertise(topic));
}

void FastDdsTransport::subscribe(const TopicEndpoint& topic, OnSample on_sample) {
  participant_->subscribe(topic, std::move(on_sample));
}

void FastDdsTransport::serve(const ServiceEndpoint& service, OnRequest on_request) {
  participant_->serve(service, std::move(on_request));
}

void FastDdsTransport::poll(std::chrono::microseconds longest) { participant_->poll(longest); }

std::vector<std::string> FastDdsTransport::warnings() { return participant_->warnings(); }

}  // namespace articula::ros2

// SPDX-License-Identifier: Apache-2.0
/// @file The last records of a loop, for any number of readers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace articula::remote {

/// The last records, numbered from 0. Each reader keeps the number of its next one. Not for several
/// threads at a time.
template <class Record>
class RecordHistory {
 public:
  /// @param capacity  records that are kept, > 0
  explicit RecordHistory(std::size_t capacity) : capacity_(capacity) {}

  void add(const Record& record) {
    if (records_.size() < capacity_) {
      records_.push_back(record);
    } else {
      records_[static_cast<std::size_t>(end_ % capacity_)] = record;
    }
    ++end_;
  }

  /// The number of the next record.
  [[nodiscard]] std::uint64_t end() const { return end_; }

  /// The record of a number, or the oldest one if that is not kept any more.
  /// @param[in,out] number  is moved on to the next one
  /// @return                nullptr if there is none yet; valid until the next `add`
  [[nodiscard]] const Record* take(std::uint64_t& number) const {
    if (number >= end_) return nullptr;
    const std::uint64_t oldest = end_ - records_.size();
    if (number < oldest) number = oldest;
    return &records_[static_cast<std::size_t>(number++ % capacity_)];
  }

 private:
  std::size_t capacity_;
  std::vector<Record> records_{};
  std::uint64_t end_ = 0;
};

}  // namespace articula::remote

// SPDX-License-Identifier: Apache-2.0
/// @file The set-up of one process data object of a CANopen node.
#pragma once

#include "articula/hardware/canopen/canopen_pdo_task.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace articula::canopen {

/// Configures one PDO by requests, one after the other: switches it off, makes it synchronous, maps
/// the objects, and switches it on [CiA 301, 7.5.2.35 to 38]. All functions are real-time.
///
/// - Identifiers are read, then modified. Bit 30 (no remote requests) keeps the node's value.
/// - A mapping that the node does not let change is used as it is, if it has the objects.
/// - A value that the node does not let change is accepted if it is right.
class PdoSetUp {
 public:
  /// Begins with a PDO.
  constexpr void begin(const PdoTask& task) noexcept {
    *this = {};
    task_ = task;
    fixed_ = !task.may_map;
    stage_ = fixed_ ? Stage::read_count : Stage::read_identifier;
  }

  [[nodiscard]] constexpr bool done() const noexcept { return stage_ == Stage::done; }
  /// The node has refused something necessary.
  [[nodiscard]] constexpr bool failed() const noexcept { return stage_ == Stage::failed; }
  /// The node has refused the deadline.
  [[nodiscard]] constexpr bool lacks_deadline() const noexcept { return lacks_deadline_; }
  /// The object that the node has refused, with its abort code.
  [[nodiscard]] constexpr const Sdo& refusal() const noexcept { return refusal_; }
  /// The node does not let the mapping change.
  [[nodiscard]] constexpr bool fixed() const noexcept { return fixed_; }
  /// The objects of the PDO; empty if the PDO is not used.
  [[nodiscard]] constexpr const PdoMapping& mapping() const noexcept { return mapping_; }

  /// The next request.
  [[nodiscard]] constexpr Sdo request() const noexcept {
    constexpr std::uint32_t synchronous = 1;
    switch (stage_) {
      case Stage::read_identifier:
        return read_request(task_.parameter(1));
      case Stage::switch_off:
        return write_request(task_.parameter(1), off | identifier(), 4);
      case Stage::make_synchronous:
        return write_request(task_.parameter(2), synchronous, 1);
      case Stage::check_synchronous:
        return read_request(task_.parameter(2));
      case Stage::set_deadline:
        return write_request(task_.parameter(5), task_.deadline, 2);
      case Stage::clear:
        return write_request(task_.mapping(0), 0, 1);
      case Stage::map:
        return write_request(task_.mapping(mapping_.size() + 1),
                             task_.entries[next_].object.entry(), 4);
      case Stage::count:
        return write_request(task_.mapping(0), static_cast<std::uint32_t>(mapping_.size()), 1);
      case Stage::read_count:
        return read_request(task_.mapping(0));
      case Stage::read_entry:
        return read_request(task_.mapping(next_ + 1));
      case Stage::switch_on:
        return write_request(task_.parameter(1), identifier(), 4);
      case Stage::done:
      case Stage::failed:
        break;
    }
    return {};
  }

  /// Processes the answer to the request.
  constexpr void take(const Sdo& answer) noexcept {
    if (answer.kind == SdoKind::abort) return take_abort(answer);
    switch (stage_) {
      case Stage::read_identifier:
        identifier_ = answer.value;
        stage_ = Stage::switch_off;
        return;
      case Stage::switch_off:
        stage_ = Stage::make_synchronous;
        return;
      case Stage::check_synchronous:
        if (!task_.is_synchronous(answer.value & 0xff)) return fail();
        [[fallthrough]];
      case Stage::make_synchronous:
        return task_.is_receive() ? void(stage_ = Stage::set_deadline) : end_parameters();
      case Stage::set_deadline:
        return end_parameters();
      case Stage::clear:
        mapping_.clear();
        next_ = 0;
        return map_next();
      case Stage::map:
        if (!mapping_.push_back(task_.entries[next_].object)) return fail();
        ++next_;
        return map_next();
      case Stage::count:
        stage_ = mapping_.empty() ? Stage::done : Stage::switch_on;
        return;
      case Stage::read_count:
        count_ = std::min(answer.value & 0xff, std::uint32_t{PdoMapping::capacity});
        next_ = 0;
        mapping_.clear();
        return read_next();
      case Stage::read_entry:
        ++next_;
        if (!mapping_.push_back(MappedObject::of_entry(answer.value))) {
          mapping_.clear();  // parts of bytes, or groups of PDOs, are not supported
          next_ = count_;
        }
        return read_next();
      case Stage::switch_on:
        stage_ = Stage::done;
        return;
      case Stage::done:
      case Stage::failed:
        return;
    }
  }

 private:
  enum class Stage : unsigned char {
    read_identifier,
    switch_off,
    make_synchronous,
    check_synchronous,
    set_deadline,
    clear,
    map,
    count,
    read_count,
    read_entry,
    switch_on,
    done,
    failed,
  };
  static constexpr std::uint32_t off = 0x8000'0000U;
  static constexpr std::uint32_t no_remote_requests = 0x4000'0000U;

  [[nodiscard]] constexpr std::uint32_t identifier() const noexcept {
    return (identifier_ & no_remote_requests) | task_.identifier();
  }

  constexpr void end_parameters() noexcept {
    has_parameters_ = true;
    stage_ = fixed_ ? Stage::switch_on : Stage::clear;
  }
  [[nodiscard]] constexpr bool is_left_out(const PdoTask::Entry& entry) const noexcept {
    return !entry.required && (!maps_optional_ || mapping_.length() + entry.object.bits / 8U > 8);
  }
  constexpr void map_next() noexcept {
    while (next_ < task_.entry_count && is_left_out(task_.entries[next_])) ++next_;
    stage_ = next_ < task_.entry_count ? Stage::map : Stage::count;
  }
  constexpr void read_next() noexcept {
    if (next_ < count_) {
      stage_ = Stage::read_entry;
      return;
    }
    const auto has = [&](const PdoTask::Entry& entry) { return mapping_.contains(entry.object); };
    const auto entries = std::span(task_.entries).first(task_.entry_count);
    const bool of_use =
        task_.is_receive() ? std::ranges::all_of(entries, has) : std::ranges::any_of(entries, has);
    if (!of_use) mapping_.clear();
    stage_ = !of_use ? Stage::done : has_parameters_ ? Stage::switch_on : Stage::read_identifier;
  }
  constexpr void fail() noexcept { stage_ = Stage::failed; }

  constexpr void take_abort(const Sdo& answer) noexcept {
    const bool tolerated = stage_ == Stage::set_deadline && task_.deadline == 0;
    const bool first = refusal_.kind != SdoKind::abort;
    if (!tolerated && (first || !fixed_)) refusal_ = answer;
    const bool is_on = (identifier_ & (off | 0x7ff)) == (identifier() & 0x7ff);
    switch (stage_) {
      case Stage::switch_off:  // right as it is, if it has the identifier and is on
        return is_on ? void(stage_ = Stage::make_synchronous) : fail();
      case Stage::make_synchronous:
        stage_ = Stage::check_synchronous;
        return;
      case Stage::set_deadline:
        lacks_deadline_ = task_.deadline > 0;
        return lacks_deadline_ ? fail() : end_parameters();
      case Stage::clear:
        fixed_ = true;
        stage_ = Stage::read_count;
        return;
      case Stage::map:
        if (task_.entries[next_].required) return fail();
        ++next_;
        return map_next();
      case Stage::count:  // some nodes check the entries only here
        if (!maps_optional_) return fail();
        maps_optional_ = false;
        stage_ = Stage::clear;
        return;
      case Stage::read_identifier:  // there is no such PDO
      case Stage::read_count:
      case Stage::read_entry:
        mapping_.clear();
        stage_ = Stage::done;
        return;
      case Stage::switch_on:
        return is_on ? void(stage_ = Stage::done) : fail();
      case Stage::check_synchronous:
      case Stage::done:
      case Stage::failed:
        return fail();
    }
  }

  PdoTask task_{};
  Stage stage_ = Stage::done;
  PdoMapping mapping_{};
  Sdo refusal_{};
  std::uint32_t identifier_ = 0;
  std::size_t next_ = 0;   ///< entry of the task to be mapped, or of the node to be read
  std::size_t count_ = 0;  ///< entries that the node has
  bool maps_optional_ = true;
  bool fixed_ = false;
  bool has_parameters_ = false;  ///< the communication parameters are set
  bool lacks_deadline_ = false;
};

}  // namespace articula::canopen

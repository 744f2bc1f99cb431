// SPDX-License-Identifier: Apache-2.0
/// @file The set-up of one process data object of a CANopen node.
#pragma once

#include "articula/core/inline_sequence.hpp"
#include "articula/hardware/canopen/canopen_pdo_mapping.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace articula::canopen {

/// The desired configuration of one process data object (PDO), and the addresses of its objects
/// [CiA 301, 7.5.2.35 to 38].
struct PdoTask {
  enum class Direction : unsigned char { receive, transmit };
  struct Entry {
    MappedObject object{};
    bool required = true;  ///< Else the PDO may lack it, if the node cannot map it.
  };

  Direction direction = Direction::receive;
  std::uint8_t number = 0;  ///< 0 for PDO 1
  std::uint8_t node = 0;
  bool may_map = true;         ///< Else the mapping is only read.
  std::uint16_t deadline = 0;  ///< of an RPDO [ms]; 0: none
  InlineSequence<Entry, 5> entries{};

  /// Adds an object; at most five. Real-time: yes.
  constexpr void add(const MappedObject& object, bool required) noexcept {
    entries.push_back({object, required});
  }

  [[nodiscard]] constexpr bool is_receive() const noexcept {
    return direction == Direction::receive;
  }
  /// The address of a communication parameter. Real-time: yes.
  [[nodiscard]] constexpr ObjectAddress parameter(std::uint8_t subindex) const noexcept {
    return {static_cast<std::uint16_t>((is_receive() ? 0x1400 : 0x1800) + number), subindex};
  }
  /// The address of an entry of the mapping, or with 0 of their number. Real-time: yes.
  [[nodiscard]] constexpr ObjectAddress mapping(std::size_t subindex) const noexcept {
    return {static_cast<std::uint16_t>(parameter(0).index + 0x200),
            static_cast<std::uint8_t>(subindex)};
  }
  /// The predefined identifier. Real-time: yes.
  [[nodiscard]] constexpr std::uint32_t identifier() const noexcept {
    return (is_receive() ? receive_pdo_1_base : transmit_pdo_1_base) + pdo_spacing * number + node;
  }
  /// Whether a transmission type is synchronous: 0 .. 240 puts an RPDO into force at SYNC, and 1
  /// sends a TPDO at each SYNC. Real-time: yes.
  [[nodiscard]] constexpr bool is_synchronous(std::uint32_t type) const noexcept {
    return is_receive() ? type <= 240 : type == 1;
  }
};

/// Configures one PDO by requests, one after the other. It switches the PDO off, makes it
/// synchronous, maps the objects, and switches it on [CiA 301, 7.5.2.35 to 38]. All functions are
/// real-time.
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
    if (fixed_) {
      read(Stage::read_count, task_.mapping(0));
    } else {
      read(Stage::read_identifier, task_.parameter(1));
    }
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

  [[nodiscard]] constexpr const Sdo& request() const noexcept { return request_; }

  /// Processes the answer to the request.
  constexpr void take(const Sdo& answer) noexcept {
    const bool ok = answer.kind != SdoKind::abort;
    if (!ok) note_refusal(answer);
    switch (stage_) {
      case Stage::read_identifier:
        if (!ok) return end(false);  // there is no such PDO
        identifier_ = answer.value;
        return write(Stage::switch_off, task_.parameter(1), off | identifier(), 4);
      case Stage::switch_off:
        return ok || is_on() ? write(Stage::make_synchronous, task_.parameter(2), 1, 1) : fail();
      case Stage::make_synchronous:
        return ok ? set_deadline() : read(Stage::check_synchronous, task_.parameter(2));
      case Stage::check_synchronous:
        return ok && task_.is_synchronous(answer.value & 0xff) ? set_deadline() : fail();
      case Stage::set_deadline:
        lacks_deadline_ = !ok && task_.deadline > 0;
        return lacks_deadline_ ? fail() : end_parameters();
      case Stage::clear:
        next_ = 0;
        mapping_.clear();
        if (ok) return map_next();
        fixed_ = true;
        return read(Stage::read_count, task_.mapping(0));
      case Stage::map:
        if (ok ? !mapping_.push_back(task_.entries[next_].object) : task_.entries[next_].required) {
          return fail();
        }
        ++next_;
        return map_next();
      case Stage::count:
        if (ok) return mapping_.empty() ? end(true) : switch_on();
        if (!maps_optional_) return fail();
        maps_optional_ = false;  // some nodes check the entries only here
        return write(Stage::clear, task_.mapping(0), 0, 1);
      case Stage::read_count:
        if (!ok) return end(false);
        count_ = std::min(answer.value & 0xff, std::uint32_t{PdoMapping::capacity});
        next_ = 0;
        mapping_.clear();
        return read_next();
      case Stage::read_entry:
        if (!ok) return end(false);
        ++next_;
        if (!mapping_.push_back(MappedObject::of_entry(answer.value))) {
          mapping_.clear();  // parts of bytes, or groups of PDOs, are not supported
          next_ = count_;
        }
        return read_next();
      case Stage::switch_on:
        return ok || is_on() ? end(true) : fail();
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

  /// Whether the PDO is right as it is: it has the identifier and is on.
  [[nodiscard]] constexpr bool is_on() const noexcept {
    return (identifier_ & (off | 0x7ff)) == (identifier() & 0x7ff);
  }

  constexpr void read(Stage stage, const ObjectAddress& address) noexcept {
    stage_ = stage;
    request_ = read_request(address);
  }
  constexpr void write(Stage stage, const ObjectAddress& address, std::uint32_t value,
                       std::uint8_t size) noexcept {
    stage_ = stage;
    request_ = write_request(address, value, size);
  }
  constexpr void set_deadline() noexcept {
    if (!task_.is_receive()) return end_parameters();
    write(Stage::set_deadline, task_.parameter(5), task_.deadline, 2);
  }
  constexpr void end_parameters() noexcept {
    has_parameters_ = true;
    fixed_ ? switch_on() : write(Stage::clear, task_.mapping(0), 0, 1);
  }
  constexpr void switch_on() noexcept {
    write(Stage::switch_on, task_.parameter(1), identifier(), 4);
  }
  constexpr void end(bool is_used) noexcept {
    if (!is_used) mapping_.clear();
    stage_ = Stage::done;
  }
  constexpr void fail() noexcept { stage_ = Stage::failed; }

  [[nodiscard]] constexpr bool is_left_out(const PdoTask::Entry& entry) const noexcept {
    return !entry.required && (!maps_optional_ || mapping_.length() + entry.object.bits / 8U > 8);
  }
  constexpr void map_next() noexcept {
    while (next_ < task_.entries.size() && is_left_out(task_.entries[next_])) ++next_;
    const auto mapped = static_cast<std::uint32_t>(mapping_.size());
    if (next_ == task_.entries.size()) return write(Stage::count, task_.mapping(0), mapped, 1);
    write(Stage::map, task_.mapping(mapped + 1), task_.entries[next_].object.entry(), 4);
  }
  constexpr void read_next() noexcept {
    if (next_ < count_) return read(Stage::read_entry, task_.mapping(next_ + 1));
    const auto has = [&](const PdoTask::Entry& entry) { return mapping_.contains(entry.object); };
    const auto& entries = task_.entries;
    const bool of_use =
        task_.is_receive() ? std::ranges::all_of(entries, has) : std::ranges::any_of(entries, has);
    if (!of_use) return end(false);
    has_parameters_ ? switch_on() : read(Stage::read_identifier, task_.parameter(1));
  }

  constexpr void note_refusal(const Sdo& answer) noexcept {
    const bool tolerated = stage_ == Stage::set_deadline && task_.deadline == 0;
    const bool first = refusal_.kind != SdoKind::abort;
    if (!tolerated && (first || !fixed_)) refusal_ = answer;
  }

  PdoTask task_{};
  Stage stage_ = Stage::done;
  Sdo request_{};
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

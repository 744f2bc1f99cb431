// SPDX-License-Identifier: Apache-2.0
/// @file How one process data object of a CANopen node is set up.
#pragma once

#include "articula/hardware/canopen/canopen_pdo_task.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace articula::canopen {

/// Sets up one PDO by requests, one after the other: switches it off, makes it synchronous, maps
/// the objects that are wished for, and switches it on [CiA 301, 7.5.2.35 to 38].
///
/// - Identifiers are read, then modified: bit 30 (no remote requests) stays as the node has it.
/// - A mapping that the node does not let change is used as it is, if it has what is wished for.
/// - What cannot be written is right if it has the value already.
class PdoSetUp {
 public:
  /// Begins with a PDO. Real-time: yes.
  constexpr void begin(const PdoTask& task) noexcept {
    task_ = task;
    mapping_.clear();
    optional_ = true;
    fixed_ = !task.may_map;
    ready_ = lacks_deadline_ = false;
    refusal_ = {};
    stage_ = fixed_ ? Stage::read_count : Stage::read_identifier;
  }

  [[nodiscard]] constexpr bool done() const noexcept { return stage_ == Stage::done; }
  /// The node refuses what is necessary. Real-time: yes.
  [[nodiscard]] constexpr bool failed() const noexcept { return stage_ == Stage::failed; }
  /// It was the deadline that the node refuses. Real-time: yes.
  [[nodiscard]] constexpr bool lacks_deadline() const noexcept { return lacks_deadline_; }
  /// The object that the node has refused, and its abort code. Real-time: yes.
  [[nodiscard]] constexpr const Sdo& refusal() const noexcept { return refusal_; }
  /// The node does not let the mapping change. Real-time: yes.
  [[nodiscard]] constexpr bool fixed() const noexcept { return fixed_; }
  /// What the PDO is made of; empty if it is not used. Real-time: yes.
  [[nodiscard]] constexpr const PdoMapping& mapping() const noexcept { return mapping_; }

  /// The next request. Real-time: yes.
  [[nodiscard]] constexpr Sdo request() const noexcept {
    constexpr std::uint32_t synchronous = 1;
    switch (stage_) {
      case Stage::read_identifier:
        return read(parameter(1));
      case Stage::switch_off:
        return write(parameter(1), off | identifier(), 4);
      case Stage::make_synchronous:
        return write(parameter(2), synchronous, 1);
      case Stage::check_synchronous:
        return read(parameter(2));
      case Stage::set_deadline:
        return write(parameter(5), task_.deadline, 2);
      case Stage::clear:
        return write(entry(0), 0, 1);
      case Stage::map:
        return write(entry(mapping_.size() + 1), task_.wishes[wish_].object.entry(), 4);
      case Stage::count:
        return write(entry(0), static_cast<std::uint32_t>(mapping_.size()), 1);
      case Stage::read_count:
        return read(entry(0));
      case Stage::read_entry:
        return read(entry(entries_read_ + 1));
      case Stage::switch_on:
        return write(parameter(1), identifier(), 4);
      case Stage::done:
      case Stage::failed:
        break;
    }
    return {};
  }

  /// Takes in the answer to the request. Real-time: yes.
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
        if (!is_synchronous(answer.value & 0xff)) return fail();
        [[fallthrough]];
      case Stage::make_synchronous:
        stage_ = is_receive() ? Stage::set_deadline : after_parameters();
        return;
      case Stage::set_deadline:
        stage_ = after_parameters();
        return;
      case Stage::clear:
        mapping_.clear();
        wish_ = 0;
        return next_wish();
      case Stage::map:
        if (!mapping_.push_back(task_.wishes[wish_].object)) return fail();
        ++wish_;
        return next_wish();
      case Stage::count:
        stage_ = mapping_.empty() ? Stage::done : Stage::switch_on;
        return;
      case Stage::read_count:
        count_ = std::min(answer.value & 0xff, std::uint32_t{PdoMapping::capacity});
        entries_read_ = 0;
        mapping_.clear();
        return next_entry();
      case Stage::read_entry:
        if (!mapping_.push_back(MappedObject::of_entry(answer.value))) {
          mapping_.clear();  // parts of bytes, or groups of PDOs
          entries_read_ = count_;
          return next_entry();
        }
        ++entries_read_;
        return next_entry();
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

  [[nodiscard]] static constexpr Sdo read(const ObjectAddress& address) noexcept {
    return {SdoKind::upload, address, 0, 0};
  }
  [[nodiscard]] static constexpr Sdo write(const ObjectAddress& address, std::uint32_t value,
                                           std::uint8_t size) noexcept {
    return {SdoKind::download, address, value, size};
  }
  [[nodiscard]] constexpr bool is_receive() const noexcept {
    return task_.direction == PdoTask::Direction::receive;
  }
  [[nodiscard]] constexpr ObjectAddress parameter(std::uint8_t subindex) const noexcept {
    const int base = is_receive() ? 0x1400 : 0x1800;
    return {static_cast<std::uint16_t>(base + task_.number), subindex};
  }
  [[nodiscard]] constexpr ObjectAddress entry(std::size_t subindex) const noexcept {
    return {static_cast<std::uint16_t>(parameter(0).index + 0x200),
            static_cast<std::uint8_t>(subindex)};
  }
  [[nodiscard]] constexpr std::uint32_t identifier() const noexcept {
    const std::uint32_t base = is_receive() ? receive_pdo_1_base : transmit_pdo_1_base;
    return (identifier_ & no_remote_requests) | (base + pdo_spacing * task_.number + task_.node);
  }
  /// An RPDO is put into force at SYNC by each of the types 0 .. 240, a TPDO sent at each by 1.
  [[nodiscard]] constexpr bool is_synchronous(std::uint32_t type) const noexcept {
    return is_receive() ? type <= 240 : type == 1;
  }

  constexpr Stage after_parameters() noexcept {
    ready_ = true;
    return fixed_ ? Stage::switch_on : Stage::clear;
  }
  [[nodiscard]] constexpr bool is_left_out(const PdoTask::Wish& wish) const noexcept {
    return !wish.required && (!optional_ || mapping_.length() + wish.object.bits / 8U > 8);
  }
  constexpr void next_wish() noexcept {
    while (wish_ < task_.wish_count && is_left_out(task_.wishes[wish_])) ++wish_;
    stage_ = wish_ < task_.wish_count ? Stage::map : Stage::count;
  }
  constexpr void next_entry() noexcept {
    if (entries_read_ < count_) {
      stage_ = Stage::read_entry;
      return;
    }
    const auto has = [&](const PdoTask::Wish& wish) { return mapping_.contains(wish.object); };
    const auto wishes = std::span(task_.wishes).first(task_.wish_count);
    const bool of_use =
        is_receive() ? std::ranges::all_of(wishes, has) : std::ranges::any_of(wishes, has);
    if (!of_use) mapping_.clear();
    stage_ = Stage::done;
    if (of_use) stage_ = ready_ ? Stage::switch_on : Stage::read_identifier;
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
        return lacks_deadline_ ? fail() : void(stage_ = after_parameters());
      case Stage::clear:
        fixed_ = true;
        stage_ = Stage::read_count;
        return;
      case Stage::map:
        if (task_.wishes[wish_].required) return fail();
        ++wish_;
        return next_wish();
      case Stage::count:  // some nodes look at the entries only then
        if (!optional_) return fail();
        optional_ = false;
        stage_ = Stage::clear;
        return;
      case Stage::read_identifier:  // no such PDO
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
  std::size_t wish_ = 0;
  std::uint32_t count_ = 0;
  std::uint32_t entries_read_ = 0;
  bool optional_ = true;  ///< The optional wishes are mapped, too.
  bool fixed_ = false;
  bool ready_ = false;  ///< The parameters are set.
  bool lacks_deadline_ = false;
};

}  // namespace articula::canopen

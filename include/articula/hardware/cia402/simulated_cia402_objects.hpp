// SPDX-License-Identifier: Apache-2.0
/// @file The objects of a simulated CiA 402 drive, and the rules for writing them.
#pragma once

#include "articula/hardware/canopen/simulated_object_dictionary.hpp"
#include "articula/hardware/cia402/cia402.hpp"
#include "articula/hardware/cia402/simulated_cia402_quirks.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace articula {

/// The objects of a simulated CiA 402 drive, the rules for writing them, and the process data
/// objects that are mapped from them. All functions are real-time.
class SimulatedCia402Objects : public SimulatedObjectDictionary {
 public:
  static constexpr std::uint32_t off = 0x8000'0000U;  ///< in the identifier of a PDO
  static constexpr std::uint32_t no_remote_requests = 0x4000'0000U;
  static constexpr std::uint8_t pdo_count = 4;

  /// Sets the values after switching on.
  void restart(std::uint8_t node, const SimulatedCia402Quirks& quirks) noexcept {
    quirks_ = quirks;
    clear();
    for (const SimulatedObject& object : factory_objects) {
      const bool missing =
          (object.address == cia402::error_code && !quirks.has_error_code) ||
          (object.address == cia402::torque_actual && !quirks.has_torque) ||
          (object.address == cia402::velocity_actual && !quirks.has_velocity) ||
          (object.address == heartbeat_consumer && !quirks.has_heartbeat_consumer) ||
          (object.address == cia402::abort_connection && !quirks.has_abort_connection);
      if (!missing) add(object);
    }
    set(cia402::abort_connection, quirks.abort_connection);
    set(sync_counter, quirks.sync_counter);
    if (quirks.sync_counter != 0) set(sync_period, 1000);
    if (!quirks.has_fixed_mappings()) {
      for (const std::uint16_t index : std::array<std::uint16_t, 3>{0x1600, 0x1a00, 0x1a01}) {
        add_pdo(node, index, nullptr);
      }
    }
    for (const auto& fixed : quirks.fixed_mappings) {
      if (fixed.index != 0) add_pdo(node, fixed.index, &fixed);
    }
  }

  /// The answer to a request; abort codes of [CiA 301, table 22].
  /// @param is_operational  the node is in the state operational
  [[nodiscard]] canopen::Sdo serve(const canopen::Sdo& request, bool is_operational) noexcept {
    const auto abort = [&](std::uint32_t code) {
      return canopen::Sdo{canopen::SdoKind::abort, request.address, code, 4};
    };
    SimulatedObject* const object = find(request.address);
    if (!object) return abort(0x0602'0000);  // object does not exist
    if (request.kind == canopen::SdoKind::upload) {
      const std::uint8_t size = quirks_.indicates_size ? object->size : std::uint8_t{0};
      return {request.kind, request.address, object->value, size};
    }
    const bool is_fixed =
        quirks_.abort_connection_is_fixed && request.address == cia402::abort_connection;
    if (!object->writable || is_fixed) return abort(0x0601'0002);  // read only
    const bool fits = request.size == object->size || request.size == 0;
    if (!fits) return abort(0x0607'0010);                               // length does not match
    if (is_locked(request, is_operational)) return abort(0x0800'0022);  // present device state
    if (const std::uint32_t code = refusal(request); code != 0) return abort(code);
    object->value = request.value & ~std::uint32_t{0} >> (8 * (4 - object->size));
    return {request.kind, request.address, 0, 0};
  }

  /// Writes the objects that a frame of a process data object carries.
  /// @param mapping  index of the mapping object
  /// @return         false if the frame is too short [CiA 301, 7.2.2]
  [[nodiscard]] bool unpack(std::uint16_t mapping, const CanFrame& frame) noexcept {
    std::size_t length = 0;
    for_each_mapped(mapping, [&](const auto& object) { length += object.size; });
    if (frame.length < length) return false;
    std::size_t offset = 0;
    for_each_mapped(mapping, [&](auto& object) {
      object.value = 0;
      for (std::size_t k = 0; k < object.size; ++k) {
        object.value |= std::uint32_t{frame.data[offset++]} << (8 * k);
      }
    });
    return true;
  }
  /// The frame of a process data object.
  [[nodiscard]] CanFrame pack(std::uint16_t mapping, std::uint32_t identifier) noexcept {
    CanFrame frame{.identifier = identifier};
    for_each_mapped(mapping, [&](const auto& object) {
      for (std::size_t byte = 0; byte < object.size && frame.length < 8; ++byte) {
        frame.data[frame.length++] = static_cast<std::uint8_t>(object.value >> (8 * byte) & 0xff);
      }
    });
    return frame;
  }

  /// Whether a heartbeat is from the node in object 1016h.
  [[nodiscard]] bool is_heartbeat_of_host(const CanFrame& frame) const noexcept {
    const std::uint32_t consumer = value(heartbeat_consumer);
    return (consumer & 0xffff) != 0 &&
           frame.identifier == canopen::heartbeat_base + (consumer >> 16 & 0x7f);
  }

  /// The address of a parameter of a process data object.
  [[nodiscard]] static canopen::ObjectAddress parameter(std::uint16_t base, std::uint16_t number,
                                                        std::uint8_t subindex = 1) noexcept {
    return {static_cast<std::uint16_t>(base + number), subindex};
  }
  static constexpr canopen::ObjectAddress heartbeat_consumer{0x1016, 1};
  static constexpr canopen::ObjectAddress sync_period{0x1006, 0};
  static constexpr canopen::ObjectAddress sync_counter{0x1019, 0};

 private:
  static constexpr auto factory_objects = std::to_array<SimulatedObject>({
      {{0x1000, 0}, 4, false, 0x0002'0192},  // servo drive of the profile 402
      {sync_period, 4, true, 0},
      {heartbeat_consumer, 4, true, 0},
      {{0x1017, 0}, 2, true, 0},
      {sync_counter, 1, true, 0},
      {cia402::abort_connection, 2, true, 0},
      {cia402::error_code, 2, false, 0},
      {cia402::controlword, 2, true, 0},
      {cia402::statusword, 2, false, 0x40},
      {{0x605a, 0}, 2, true, 2},  // quick stop option
      {cia402::mode_of_operation, 1, true, 0},
      {cia402::mode_display, 1, false, 0},
      {cia402::position_actual, 4, false, 0},
      {cia402::velocity_actual, 4, false, 0},
      {cia402::target_torque, 2, true, 0},
      {{0x6072, 0}, 2, true, 1000},  // maximum torque
      {cia402::torque_actual, 2, false, 0},
      {cia402::target_position, 4, true, 0},
      {cia402::interpolation_period, 1, true, 1},
      {cia402::interpolation_exponent, 1, true, 0xfd},
      {cia402::target_velocity, 4, true, 0},
  });

  template <class Function>
  void for_each_mapped(std::uint16_t mapping, Function function) noexcept {
    const auto count = static_cast<std::uint8_t>(std::min(value({mapping, 0}), std::uint32_t{8}));
    for (std::uint8_t k = 1; k <= count; ++k) {
      SimulatedObject* const object = find(mapped(value({mapping, k})));
      if (object) function(*object);
    }
  }
  [[nodiscard]] static canopen::ObjectAddress mapped(std::uint32_t entry) noexcept {
    return {static_cast<std::uint16_t>(entry >> 16), static_cast<std::uint8_t>(entry >> 8 & 0xff)};
  }
  [[nodiscard]] static bool is_transmit(std::uint16_t index) noexcept { return index >= 0x1800; }

  void add_pdo(std::uint8_t node, std::uint16_t mapping,
               const SimulatedCia402Quirks::FixedMapping* fixed) noexcept {
    const auto parameters = static_cast<std::uint16_t>(mapping - 0x200);
    const std::uint32_t base =
        is_transmit(mapping) ? canopen::transmit_pdo_1_base : canopen::receive_pdo_1_base;
    std::uint32_t identifier = base + canopen::pdo_spacing * (mapping & 0xffU) + node;
    if (is_transmit(mapping) && !quirks_.allows_remote_requests) identifier |= no_remote_requests;
    add({{parameters, 1}, 4, true, off | identifier});
    add({{parameters, 2}, 1, true, 255});
    if (!is_transmit(mapping) && quirks_.has_deadline) add({{parameters, 5}, 2, true, 0});
    std::uint32_t count = 0;
    for (std::uint8_t k = 1; k <= 8; ++k) {
      const std::uint32_t entry = fixed ? fixed->entries[k - 1U] : 0;
      if (entry != 0) ++count;
      add({{mapping, k}, 4, fixed == nullptr, entry});
    }
    add({{mapping, 0}, 1, fixed == nullptr, count});
  }

  /// Mapping objects are locked while their process data object is on. Entries are locked while
  /// their number is not 0. The counter of SYNC is locked while SYNC has a period.
  [[nodiscard]] bool is_locked(const canopen::Sdo& request, bool is_operational) const noexcept {
    const std::uint16_t index = request.address.index;
    if (request.address == sync_counter) return value(sync_period) != 0;
    const bool is_pdo = index >= 0x1400 && index < 0x1c00;
    if (is_pdo && is_operational && !quirks_.is_open_in_operation) return true;
    const bool is_mapping = is_pdo && (index & 0x0200) != 0;
    if (!is_mapping) return false;
    const auto parameters = static_cast<std::uint16_t>(index - 0x0200);
    const bool on = (value({parameters, 1}) & off) == 0;
    return on || (request.address.subindex > 0 && value({index, 0}) != 0);
  }

  /// The abort code for an invalid value; 0 for a valid one.
  [[nodiscard]] std::uint32_t refusal(const canopen::Sdo& request) const noexcept {
    const std::uint16_t index = request.address.index;
    const std::uint8_t subindex = request.address.subindex;
    const bool is_identifier = index >= 0x1800 && index < 0x1a00 && subindex == 1;
    if (is_identifier && !quirks_.allows_remote_requests &&
        (request.value & no_remote_requests) == 0) {
      return 0x0609'0030;  // value range
    }
    const bool is_mapping = index >= 0x1600 && index < 0x1c00 && (index & 0x0200) != 0;
    if (is_mapping && subindex > 0 && !find(mapped(request.value))) {
      return 0x0604'0041;  // cannot be mapped
    }
    return 0;
  }

  SimulatedCia402Quirks quirks_{};
};

}  // namespace articula

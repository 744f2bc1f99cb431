// SPDX-License-Identifier: Apache-2.0
/// @file The deviations of a simulated CiA 402 drive from the standard.
#pragma once

#include <array>
#include <cstdint>

namespace articula {

/// The deviations of a simulated CiA 402 drive from the standard. Many real drives have some.
struct SimulatedCia402Quirks {
  /// A mapping that cannot be changed: the index of its object, 1600h .. 1603h or 1a00h .. 1a03h,
  /// and its entries, with zero after the last.
  struct FixedMapping {
    std::uint16_t index = 0;
    std::array<std::uint32_t, 8> entries{};
  };

  bool has_error_code = true;              ///< object 603Fh
  bool has_torque = true;                  ///< object 6077h
  bool has_velocity = true;                ///< object 606Ch
  bool has_deadline = true;                ///< object 1400h,5
  bool has_heartbeat_consumer = true;      ///< object 1016h
  bool has_abort_connection = true;        ///< object 6007h
  bool abort_connection_is_fixed = false;  ///< It cannot be written.
  std::uint16_t abort_connection = 0;      ///< initial value of object 6007h
  bool allows_remote_requests = true;      ///< Else identifiers of TPDOs must have bit 30.
  bool indicates_size = true;              ///< of a value that is read (43h .. 4fh, else 42h)
  bool shows_mode_at_once = true;          ///< Else object 6061h follows only in operation enabled.
  bool shows_following = true;             ///< bit 12 of the statusword
  bool is_open_in_operation = true;        ///< Else 1400h .. 1BFFh are locked in operation.
  std::uint8_t sync_counter = 0;  ///< initial value of object 1019h; other SYNCs are ignored
  double boot_time = 0;           ///< [s]
  double transition_time = 0;     ///< of each transition towards operation enabled [s]
  std::array<FixedMapping, 8> fixed_mappings{};  ///< If there is one, there are no changeable ones.

  [[nodiscard]] constexpr bool has_fixed_mappings() const noexcept {
    return fixed_mappings[0].index != 0;
  }
};

}  // namespace articula

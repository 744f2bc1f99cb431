// SPDX-License-Identifier: Apache-2.0
/// @file Frames made of any bytes, for both ends of the bus: what random tests and the fuzzer
/// share.
#pragma once

#include <articula/hardware/can/can_error_frame.hpp>
#include <articula/hardware/can/can_hardware.hpp>
#include <articula/hardware/cia402/cia402_codec.hpp>
#include <articula/hardware/cia402/simulated_cia402_drives.hpp>
#include <articula/hardware/quanser/quanser_codec.hpp>
#include <articula/hardware/quanser/simulated_quanser_drives.hpp>
#include <articula/robots/q2d.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace support {

inline constexpr std::size_t bytes_per_frame = 13;  ///< 3 of identifier, flags, length, 8 of data

inline constexpr articula::QuanserModules<2> any_modules{{{.node = 1}, {.node = 2}}};
inline constexpr articula::Cia402DriveList<2> any_drives{
    {{.node = 1, .rated_effort = 30}, {.node = 2, .rated_effort = 30}}};

/// Gives the frame that starts here an identifier that some codec or drive listens to.
inline void aim(std::uint8_t* bytes, int choice) {
  static constexpr std::uint32_t bases[] = {0x000, 0x040, 0x080, 0x100, 0x180,
                                            0x200, 0x280, 0x580, 0x600, 0x700};
  const auto n = static_cast<std::uint32_t>(choice);
  const std::uint32_t identifier = bases[n % 10] + n / 10 % 3;
  bytes[0] = static_cast<std::uint8_t>(identifier & 0xff);
  bytes[1] = static_cast<std::uint8_t>(identifier >> 8);
  bytes[2] = 0;
  bytes[3] = 0;
  bytes[4] = static_cast<std::uint8_t>(n / 30 % 9);
}

inline articula::CanFrame frame_at(const std::uint8_t* bytes) {
  articula::CanFrame frame;
  frame.extended = (bytes[3] & 1) != 0;
  frame.identifier = bytes[0] | std::uint32_t{bytes[1]} << 8 | std::uint32_t{bytes[2]} << 16;
  frame.identifier &= frame.extended ? 0x1fff'ffffU : 0x7ffU;
  frame.length = bytes[4] % 9;
  std::copy_n(bytes + 5, frame.length, frame.data.begin());
  return frame;
}

template <class Codec>
bool codec_survives(Codec codec, const std::uint8_t* bytes, std::size_t size) {
  codec.restart();
  bool sane = true;
  std::chrono::nanoseconds elapsed{};
  for (std::size_t at = 0; at + bytes_per_frame <= size; at += bytes_per_frame) {
    articula::CanBatch batch;
    elapsed += std::chrono::milliseconds(7);
    if (at / bytes_per_frame % 2 == 0) {
      static_cast<void>(codec.set_up(elapsed, batch));
    } else {
      codec.encode({}, batch);
    }
    sane = sane && std::all_of(batch.begin(), batch.end(), articula::is_valid);
    static_cast<void>(codec.decode(frame_at(bytes + at)));
    for (const articula::DriveReport& report : codec.reports()) {
      sane = sane && articula::is_finite(report.position) && articula::is_finite(report.velocity) &&
             articula::is_finite(report.effort);
    }
  }
  return sane;
}

template <class Drives>
bool drives_survive(Drives drives, const std::uint8_t* bytes, std::size_t size) {
  bool sane = true;
  const articula::JointVector<2> limits = articula::effort_limits(articula::Q2d());
  for (std::size_t at = 0; at + bytes_per_frame <= size; at += bytes_per_frame) {
    articula::CanBatch answers;
    drives.receive(frame_at(bytes + at), answers);
    sane = sane && std::all_of(answers.begin(), answers.end(), articula::is_valid) &&
           articula::is_finite(drives.effort()) &&
           (drives.effort().cwiseAbs().array() <= limits.array()).all() &&
           articula::is_finite(drives.simulator().true_state());
  }
  return sane;
}

/// True if codecs and drives take the frames with finite results, efforts within their limits, and
/// frames of their own that can be on a bus.
inline bool survives(const std::uint8_t* bytes, std::size_t size) {
  using namespace articula;
  for (std::size_t at = 0; at + bytes_per_frame <= size; at += bytes_per_frame) {
    const CanFrame frame = frame_at(bytes + at);
    static_cast<void>(decode_error_frame(frame.identifier, frame.data));
  }
  return codec_survives(QuanserCodec<Q2d>(any_modules), bytes, size) &&
         codec_survives(Cia402Codec<Q2d>(any_drives), bytes, size) &&
         codec_survives(Cia402Codec<Q2d, PositionCommand<2>>(any_drives), bytes, size) &&
         codec_survives(Cia402Codec<Q2d, VelocityCommand<2>>(any_drives), bytes, size) &&
         drives_survive(SimulatedQuanserDrives<Q2d>(any_modules), bytes, size) &&
         drives_survive(SimulatedCia402Drives<Q2d>(any_drives), bytes, size);
}

}  // namespace support

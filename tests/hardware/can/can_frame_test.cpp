// SPDX-License-Identifier: Apache-2.0
#include <articula/hardware/can/can_batch.hpp>
#include <articula/hardware/can/can_error_frame.hpp>
#include <articula/hardware/can/can_frame.hpp>

#include "catch.hpp"

using namespace articula;

namespace {

constexpr CanFrame frame(std::uint32_t identifier, std::uint8_t length, bool extended = false) {
  CanFrame made;
  made.identifier = identifier;
  made.length = length;
  made.extended = extended;
  return made;
}

}  // namespace

static_assert(is_valid(frame(0x7ff, 8)));
static_assert(!is_valid(frame(0x800, 8)));
static_assert(is_valid(frame(0x800, 8, true)));
static_assert(is_valid(frame(0x1fff'ffff, 0, true)));
static_assert(!is_valid(frame(0x2000'0000, 0, true)));
static_assert(!is_valid(frame(1, 9)));

// Published maxima: 55 + 10 n bits and, extended, 80 + 10 n [Davis et al. 2007, section 3.1].
static_assert(worst_case_bits(frame(1, 0)) == 55);
static_assert(worst_case_bits(frame(1, 8)) == 135);
static_assert(worst_case_bits(frame(1, 0, true)) == 80);
static_assert(worst_case_bits(frame(1, 8, true)) == 160);

TEST_CASE("integers of any width come back from a payload") {
  std::array<std::uint8_t, 8> data{};
  store_little_endian<0, 2>(data, std::int16_t{-2});
  store_little_endian<2, 3>(data, std::int32_t{-8388608});
  store_little_endian<5, 3>(data, std::int32_t{8388607});
  CHECK(data == std::array<std::uint8_t, 8>{0xfe, 0xff, 0x00, 0x00, 0x80, 0xff, 0xff, 0x7f});
  CHECK(load_little_endian<std::int16_t, 0>(data) == -2);
  CHECK(load_little_endian<std::uint16_t, 0>(data) == 0xfffe);
  CHECK(load_little_endian<std::int32_t, 2, 3>(data) == -8388608);
  CHECK(load_little_endian<std::int32_t, 5, 3>(data) == 8388607);
  store_little_endian<4, 4>(data, std::int32_t{-2147483647 - 1});
  CHECK(load_little_endian<std::int32_t, 4>(data) == -2147483647 - 1);
  CHECK(load_little_endian<std::uint32_t, 4>(data) == 0x8000'0000U);
}

TEST_CASE("a batch keeps order and refuses what it has no room for") {
  CanBatch batch;
  CHECK(batch.empty());
  for (std::uint32_t i = 0; i < CanBatch::capacity; ++i) CHECK(batch.push_back(frame(i, 0)));
  CHECK_FALSE(batch.push_back(frame(1, 0)));
  CHECK(batch.size() == CanBatch::capacity);
  std::uint32_t expected = 0;
  for (const CanFrame& one : batch) CHECK(one.identifier == expected++);
  batch.clear();
  CHECK(batch.begin() == batch.end());
}

TEST_CASE("reports of the controller are told apart") {
  CHECK(decode_error_frame(0x040, {}).bus_off);
  CHECK(decode_error_frame(0x100, {}).restarted);
  CHECK(decode_error_frame(0x004, {0, 0x20}).passive);
  CHECK(decode_error_frame(0x004, {0, 0x01}).overflow);
  CHECK(decode_error_frame(0x004, {0, 0x40}).recovered);
  CHECK(decode_error_frame(0x020, {}).no_answer);
  CHECK(decode_error_frame(0x001, {}).no_answer);
  const CanErrorReport calm = decode_error_frame(0x008, {0, 0xff});  // a bit error, no state
  CHECK_FALSE((calm.bus_off || calm.restarted || calm.passive || calm.recovered || calm.overflow ||
               calm.no_answer));
}

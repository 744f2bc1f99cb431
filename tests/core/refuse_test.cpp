// SPDX-License-Identifier: Apache-2.0
#include "catch.hpp"

#include <articula/core/name.hpp>
#include <articula/core/refuse.hpp>

#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <locale>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

using namespace articula;
using detail::message_of;
using detail::MessagePart;
using detail::MessageParts;

namespace {

/// As a stream writes it that nobody has told otherwise.
std::string streamed(const auto& value) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << value;
  return out.str();
}

template <class T>
void check_as_streamed() {
  using Limits = std::numeric_limits<T>;
  for (const T value : {Limits::lowest(), Limits::max(), T{0}, T{1}, T{42}, T{127}}) {
    CHECK(message_of({value}) == streamed(value));
  }
}

// What a message cannot be made of is told by the compiler, and not by an odd number.
static_assert(!std::convertible_to<bool, MessagePart>);
static_assert(!std::convertible_to<char, MessagePart>);
static_assert(
    !std::convertible_to<std::uint8_t, MessagePart>);  // a stream takes it for a character
static_assert(!std::convertible_to<std::int8_t, MessagePart>);
static_assert(!std::convertible_to<const int*, MessagePart>);
enum class Colour { red };
static_assert(!std::convertible_to<Colour, MessagePart>);

}  // namespace

TEST_CASE("texts of any kind are parts of a message") {
  const char array[] = "an array";
  const char* pointer = "a pointer";
  const std::string text = "a string";
  const std::string_view view = std::string_view("a view of more").substr(0, 6);
  const Name name = "a name";
  CHECK(message_of({array, ", ", pointer, ", ", text, ", ", view, " and ", name.view()}) ==
        "an array, a pointer, a string, a view and a name");
  CHECK(message_of({text + " made on the spot"}) == "a string made on the spot");
  CHECK(message_of({text}) == text);
  CHECK(message_of({"", std::string(), std::string_view(), "x", ""}) == "x");
  CHECK(message_of({}).empty());
  const std::string with_nul("a\0b", 3);
  CHECK(message_of({with_nul}) == with_nul);
  const std::string longer(10'000, 'x');
  CHECK(message_of({longer, longer}) == longer + longer);
}

TEST_CASE("numbers are written as streams write them") {
  for (const double value : {0.0,
                             -0.0,
                             0.1,
                             -0.1,
                             1.0,
                             2.5,
                             1.0 / 3,
                             1e-4,
                             1e-5,
                             1e-9,
                             99999.9,
                             999999.0,
                             999999.5,
                             1000000.0,
                             123456.0,
                             1234567.0,
                             1e15,
                             1e100,
                             1e300,
                             -1e300,
                             std::numeric_limits<double>::max(),
                             std::numeric_limits<double>::lowest(),
                             std::numeric_limits<double>::min(),
                             std::numeric_limits<double>::denorm_min(),
                             std::numeric_limits<double>::epsilon(),
                             std::numeric_limits<double>::infinity(),
                             -std::numeric_limits<double>::infinity(),
                             std::numeric_limits<double>::quiet_NaN(),
                             -std::numeric_limits<double>::quiet_NaN()}) {
    CHECK(message_of({value}) == streamed(value));
  }
  check_as_streamed<short>();
  check_as_streamed<unsigned short>();
  check_as_streamed<int>();
  check_as_streamed<unsigned>();
  check_as_streamed<long>();
  check_as_streamed<unsigned long>();
  check_as_streamed<long long>();
  check_as_streamed<unsigned long long>();
  CHECK(message_of({std::numeric_limits<std::uint64_t>::max()}) == "18446744073709551615");
  CHECK(message_of({std::numeric_limits<std::int64_t>::min()}) == "-9223372036854775808");
  CHECK(message_of({-0.0}) == "-0");
}

TEST_CASE("so are numbers of any bits") {
  const std::uint64_t seed = 20260711;
  INFO("seed " << seed);
  std::mt19937_64 bits(seed);
  for (int k = 0; k < 100'000; ++k) {
    const auto value = std::bit_cast<double>(bits());
    if (message_of({value}) == streamed(value)) continue;
    FAIL(message_of({value}) << " instead of " << streamed(value));
  }
  // Of the size of what joints do, where more digits are written without an exponent.
  std::uniform_real_distribution<double> exponent(-7, 8);
  for (int k = 0; k < 100'000; ++k) {
    const double value = std::pow(10, exponent(bits));
    if (message_of({value}) == streamed(value)) continue;
    FAIL(message_of({value}) << " instead of " << streamed(value));
  }
}

TEST_CASE("a part that is copied says the same") {
  MessagePart number = 0.125, text = "text";
  const MessagePart copy = number;
  number = text;
  text = copy;
  CHECK(copy.view() == "0.125");
  CHECK(number.view() == "text");
  CHECK(text.view() == "0.125");
}

TEST_CASE("what is refused throws its message") {
  CHECK_THROWS_WITH(detail::refuse({"period ", -0.5, " s of joint '", Name("elbow").view(),
                                    "' is not a number > 0, nor is ", 7u}),
                    "period -0.5 s of joint 'elbow' is not a number > 0, nor is 7");
  CHECK_THROWS_AS(detail::refuse({"no"}), std::invalid_argument);
  const auto refuse = [](MessageParts parts) {
    detail::refuse({"simulator: ", message_of(parts)});
  };
  CHECK_THROWS_WITH(refuse({"substeps ", 0, " is less than 1"}),
                    "simulator: substeps 0 is less than 1");
}

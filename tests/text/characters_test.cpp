// SPDX-License-Identifier: Apache-2.0
// Texts from outside in messages.
#include <articula/text/characters.hpp>

#include "catch.hpp"

#include <string>

using namespace articula::detail;

TEST_CASE("a text from outside cannot command the terminal that shows it") {
  CHECK(shown("shoulder_joint") == "shoulder_joint");
  CHECK(shown("Schultergelenk für \xe6\xa9\x9f") == "Schultergelenk für \xe6\xa9\x9f");
  CHECK(shown("a\nb\tc") == "a?b?c");
  CHECK(shown("\x1b[31m\x07\x7f") == "?[31m??");
  CHECK(shown("\xc2\x9b"
              "31m") == "?31m");  // the same command as one C1 character
  CHECK(shown("a\x9b\xff\xc3"
              "b") == "a???b");  // not UTF-8
  CHECK(shown("a\xc2\xa0"
              "b\xc2\x85") == "a<U+00A0>b<U+0085>");
  CHECK(shown(std::string(100, 'x')) == std::string(60, 'x') + "...");
}

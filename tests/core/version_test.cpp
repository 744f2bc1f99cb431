// SPDX-License-Identifier: Apache-2.0
#include <articula/version.hpp>

#include <string>

#include "catch.hpp"

TEST_CASE("the version of the headers is that of the CMake project") {
  CHECK(articula::library_version == ARTICULA_PROJECT_VERSION);
}

TEST_CASE("the version is a text and a number for the preprocessor, which agree") {
#if ARTICULA_VERSION < 100
  FAIL("ARTICULA_VERSION is " << ARTICULA_VERSION);
#endif
  const int number = ARTICULA_VERSION;
  CHECK(std::to_string(number / 10000) + "." + std::to_string(number / 100 % 100) + "." +
            std::to_string(number % 100) ==
        articula::library_version);
}

// SPDX-License-Identifier: Apache-2.0
#include "catch.hpp"

#include <articula/core/status.hpp>

#include <set>
#include <string_view>

using namespace articula;

static_assert(to_string(Status::ok) == "ok");
static_assert(Status{} == Status::ok);

TEST_CASE("every status has words of its own") {
  std::set<std::string_view> texts;
  int count = 0;
  for (; to_string(static_cast<Status>(count)) != "unknown status"; ++count) {
    texts.insert(to_string(static_cast<Status>(count)));
  }
  CHECK(count == 10);
  CHECK(texts.size() == 10);
  CHECK(texts.count("") == 0);
  CHECK(to_string(Status::non_finite_state) == "non-finite state");
  CHECK(to_string(Status::non_finite_reference) == "non-finite reference");
  CHECK(to_string(Status::non_finite_command) == "non-finite command");
  CHECK(to_string(Status::hardware_fault) == "hardware fault");
  CHECK(to_string(Status::stale_state) == "stale state");
  CHECK(to_string(Status::stale_reference) == "stale reference");
  CHECK(to_string(Status::limit_exceeded) == "limit exceeded");
  CHECK(to_string(Status::overrun) == "overrun");
  CHECK(to_string(Status::inactive) == "inactive");
  CHECK(to_string(static_cast<Status>(255)) == "unknown status");
}

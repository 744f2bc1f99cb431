// SPDX-License-Identifier: Apache-2.0
#include "catch.hpp"

#include <articula/core/name.hpp>

#include <sstream>
#include <string>

using namespace articula;

namespace {

/// A type per name: compiles only if a name can be a template argument.
template <Name Text>
struct Tag {
  static constexpr Name name = Text;
};

// The compiler knows all of it.
static_assert(Tag<"elbow">::name == Name("elbow"));
static_assert(Name().empty() && !Name("a").empty());
static_assert(Name("ab") < Name("b") && !(Name("b") < Name("ab")) && !(Name("a") < Name("a")));

}  // namespace

TEST_CASE("a name gives back its text") {
  CHECK(Name().view().empty());
  CHECK(Name("").view().empty());
  CHECK(Name("elbow_active_joint").view() == "elbow_active_joint");
  CHECK(std::string_view(Name(std::string("elbow"))) == "elbow");
  CHECK(Name(std::string_view("elbow").substr(0, 3)).view() == "elb");
}

TEST_CASE("a text of any kind is a name where one is asked for") {
  const auto length = [](const Name& name) { return name.view().size(); };
  const std::string text = "elbow";
  CHECK(length(text) == 5);
  CHECK(length(std::string_view(text)) == 5);
  CHECK(length("elbow") == 5);
  const std::initializer_list<Name> names{text, "shoulder", text.substr(1)};
  CHECK(names.begin()[2] == "lbow");
}

TEST_CASE("a name is printed as its text") {
  std::ostringstream out;
  out << std::left;
  out.width(6);
  out << Name("elbow") << '|' << Name() << '|' << Name("knee");
  CHECK(out.str() == "elbow ||knee");
}

TEST_CASE("a name holds 63 characters and refuses more, saying which") {
  const std::string longest(Name::capacity, 'x');
  CHECK(Name::capacity == 63);
  CHECK(Name(longest).view() == longest);
  CHECK_THROWS_AS(Name(longest + 'x'), std::length_error);
  CHECK_THROWS_WITH(Name(longest + 'x'), "a name has at most 63 characters: " + longest + 'x');
  CHECK_THROWS_AS(Name(std::string(100'000, 'x')), std::length_error);
}

TEST_CASE("names are equal and ordered as their texts are") {
  const std::string_view texts[] = {"", "A", "a", "a_b", "aa", "ab", "b", "b1", "b10", "b2"};
  for (std::string_view a : texts) {
    for (std::string_view b : texts) {
      CAPTURE(a, b);
      CHECK((Name(a) == Name(b)) == (a == b));
      CHECK((Name(a) < Name(b)) == (a < b));
    }
  }
}

TEST_CASE("a name owns its text") {
  std::string text = "shoulder";
  const Name name(text);
  text.assign(text.size(), '?');
  CHECK(name.view() == "shoulder");
  const Name copy = name;  // NOLINT: the copy is what is tested
  CHECK(copy.view().data() != name.view().data());
  CHECK(copy == name);
}

TEST_CASE("a name refuses a NUL, which C strings would end at") {
  const std::string hidden("elbow\0_2", 8);
  CHECK_THROWS_AS(Name(hidden), std::invalid_argument);
  CHECK_THROWS_WITH(Name(hidden), "a name has no NUL in it: elbow\\0...");
}

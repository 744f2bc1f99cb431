// SPDX-License-Identifier: Apache-2.0
#include <articula/text/file_error.hpp>
#include <articula/text/number_hint.hpp>
#include <articula/text/placeholder.hpp>
#include <articula/text/similar_word.hpp>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "catch.hpp"

using namespace articula;
using namespace articula::detail;

TEST_CASE("an error states place, reason and expectation in one line") {
  const FileError error({"pid.yaml", 9, 10, "arm.p"}, "the word 'many'", "a number");
  CHECK(error.what() == std::string("pid.yaml:9:10: arm.p: the word 'many', expected a number"));
  CHECK(error.line() == 9);
  CHECK(error.expected() == "a number");
  const std::string file = "arm.urdf";
  CHECK(FileError(file, "it is empty").what() == std::string("arm.urdf: it is empty"));
  CHECK(FilePlace{.file = file, .line = 3}.text() == "arm.urdf:3: ");
  CHECK(FileError(error, "; or 1").what() == error.what() + std::string("; or 1"));
}

TEST_CASE("edit distances count swapped letters once and no capital letters") {
  CHECK(edit_distance("", "abc") == 3);
  CHECK(edit_distance("forearm", "foreram") == 1);
  CHECK(edit_distance("Kp", "kP") == 0);
  CHECK(edit_distance("kitten", "sitting") == 3);
  CHECK(edit_distance(std::string(1000, 'a'), "a") == 1000);  // longer than any name
}

TEST_CASE("the meant word is the nearest one, if there is one") {
  const std::vector<std::string> words = {"p", "i", "d", "i_clamp", "joints"};
  for (const auto& [unknown, meant] : {std::pair<std::string, std::string>{"kp", "p"},
                                       {"joinst", "joints"},
                                       {"ICLAMP", "i_clamp"},
                                       {"x", ""},
                                       {"damping", ""},
                                       {"", ""}}) {
    CAPTURE(unknown);
    CHECK(similar_word(unknown, words) == meant);
  }
  CHECK(similar_word("ac", std::vector<std::string>{"ab", "ad"}).empty());  // equally near
  CHECK(one_of_words("kp", words) == "one of p, i, d, i_clamp, joints; did you mean 'p'?");
  CHECK(one_of_words("iclamp", words, 2) == "one of i_clamp, p, ...; did you mean 'i_clamp'?");
  CHECK(choice_of("x", "keys", words) == "; keys: p, i, d, i_clamp, joints");
}

TEST_CASE("hints on texts that are no numbers") {
  for (const auto& [text, hint] : {std::pair<std::string, std::string>{"1.5", ""},
                                   {"many", ""},
                                   {"${kp}", ""},
                                   {"1,5", "; write 1.5 if the comma is a decimal one"},
                                   {"5,", "; write the number alone, 5"},
                                   {"30deg", "; write a number in SI units, and no unit"},
                                   {"2*3", "; expressions are not computed"}}) {
    CHECK(number_hint(text) == hint);
  }
}

TEST_CASE("placeholders and their names") {
  for (const auto& [text, placeholder, name] :
       {std::array<std::string, 3>{"a $(var tf_prefix)b", "$(var tf_prefix)", "tf_prefix"},
        {"{{ kp }}", "{{ kp }}", "kp"},
        {"<%= kp %>", "<%= kp %>", "kp"},
        {"x@kp@", "@kp@", "kp"},
        {"$kp", "$kp", "kp"},
        {"a@b", "", ""}}) {
    CHECK(placeholder_in(text) == placeholder);
    CHECK(placeholder_name(placeholder_in(text)) == name);
  }
  CHECK(bracketed_placeholder_in("@kp@ ${e}") == "${e}");
}

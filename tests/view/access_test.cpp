// SPDX-License-Identifier: Apache-2.0
#include "articula/view/server/access.hpp"

#include "catch.hpp"

#include <stdexcept>
#include <string>

using articula::ViewOptions;
using articula::view::Access;
using articula::view::parse_target;

namespace {

const std::string good_token = "0123456789abcdef";

}  // namespace

TEST_CASE("a target has a decoded path and a token") {
  CHECK(parse_target("/")->path == "/");
  CHECK(parse_target("/")->token.empty());
  CHECK(parse_target("/?token=abc")->token == "abc");
  CHECK(parse_target("/?a=b&token=abc&c")->token == "abc");
  CHECK(parse_target("/?tokens=abc")->token.empty());
  CHECK(parse_target("/?&&")->token.empty());
  CHECK(parse_target("/meshes/a%20b/%c3%a9.stl")->path == "/meshes/a b/\xc3\xa9.stl");
  CHECK(parse_target("/%2e%2e/x")->path == "/../x");  // files_test.cpp refuses it
  for (const char* target : {"", "x", "*", "http://a/", "/%", "/%4", "/%zz", "/%-1"}) {
    INFO(target);
    CHECK_FALSE(parse_target(target));
  }
}

TEST_CASE("names of other machines are refused on loopback, whatever they resolve to") {
  const Access access({}, true);
  for (const char* host :
       {"127.0.0.1", "127.0.0.1:8765", "localhost", "localhost:1", "[::1]:8765", "[::1]"}) {
    INFO(host);
    CHECK(access.host_fault(host).empty());
  }
  for (const char* host : {"", "evil.example", "evil.example:8765", "localhost.evil.example",
                           "127.0.0.1.evil.example:8765", "::1", "[::1", "0.0.0.0:8765"}) {
    INFO(host);
    CHECK_FALSE(access.host_fault(host).empty());
  }
  const Access named({.address = "127.0.0.5"}, true);
  CHECK(named.host_fault("127.0.0.5:8765").empty());
}

TEST_CASE("pages of the server's own origin may connect, and those that are declared") {
  const Access access({.origins = {"https://app.foxglove.dev"}}, true);
  const std::string host = "localhost:8765";
  CHECK(access.origin_fault(std::nullopt, host).empty());  // no browser
  CHECK(access.origin_fault("http://localhost:8765", host).empty());
  CHECK(access.origin_fault("https://localhost:8765", host).empty());  // behind a proxy
  CHECK(access.origin_fault("https://app.foxglove.dev", host).empty());
  for (const char* origin :
       {"", "null", "http://localhost", "http://localhost:8766", "http://localhost:87650",
        "https://evil.example", "https://app.foxglove.dev.evil.example", "file://"}) {
    INFO(origin);
    CHECK_FALSE(access.origin_fault(origin, host).empty());
  }
  CHECK(access.origin_fault("https://evil.example", host) ==
        "pages of the origin 'https://evil.example' may not connect; add it to "
        "ViewOptions::origins if they shall");
}

TEST_CASE("a token is compared as a whole") {
  const Access open({}, true);
  CHECK(open.token_fault("").empty());
  CHECK(open.token_fault("anything").empty());
  const Access closed({.token = good_token}, false);
  CHECK(closed.token_fault(good_token).empty());
  for (const std::string& token : {std::string(), good_token.substr(1), good_token + "0",
                                   std::string("0123456789abcdeF"), std::string(16, '\0')}) {
    INFO(token);
    CHECK_FALSE(closed.token_fault(token).empty());
  }
}

TEST_CASE("an address that other machines reach needs a token") {
  CHECK_THROWS_WITH(Access({.address = "0.0.0.0"}, false),
                    "view: other machines reach the address 0.0.0.0, so a token of at least 16 "
                    "characters is needed; set ViewOptions::token, for example to the output of "
                    "`openssl rand -hex 16`");
  CHECK_THROWS_AS(Access({.token = "short"}, false), std::invalid_argument);
  CHECK_NOTHROW(Access({.token = "short"}, true));
  CHECK_THROWS_AS(Access({.token = "with a space and more"}, true), std::invalid_argument);
  CHECK_THROWS_AS(Access({.origins = {"app.foxglove.dev"}}, true), std::invalid_argument);
  CHECK_THROWS_AS(Access({.origins = {"https://app.foxglove.dev/"}}, true), std::invalid_argument);
}

// SPDX-License-Identifier: Apache-2.0
#include "articula/view/view.hpp"

#include "catch.hpp"
#include "fake_port.hpp"
#include "web_client.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

using articula::View;
using articula::ViewOptions;
using support::FakePort;
using support::Json;
using support::RawClient;
using support::WebClient;

namespace {

/// Waits for what other threads bring about. A minute means never.
bool comes_true(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

ViewOptions operating() { return {.port = 0, .operates = true}; }

}  // namespace

TEST_CASE("both subprotocols are spoken, the first one that is offered") {
  FakePort port;
  ViewOptions options = operating();
  options.warn = [](const std::string&) {};
  const View view(port, options);
  for (const auto& [offered, chosen] :
       {std::pair{"foxglove.websocket.v1", "foxglove.websocket.v1"},
        std::pair{"foxglove.sdk.v1", "foxglove.sdk.v1"},
        std::pair{"other, foxglove.sdk.v1, foxglove.websocket.v1", "foxglove.sdk.v1"}}) {
    WebClient client(view.port(), offered);
    REQUIRE(client.is_connected());
    CHECK(client.response()["Sec-WebSocket-Protocol"] == chosen);
    CHECK(client.text("serverInfo")["metadata"]["robot"] == "fake arm");
  }
  for (const char* offered : {"", "mqtt"}) {
    WebClient client(view.port(), offered);
    CHECK_FALSE(client.is_connected());
    CHECK(client.response().result_int() == 400);
  }
}

TEST_CASE("a client reads all topics, operates, sets parameters and publishes") {
  FakePort port;
  const View view(port, operating());
  WebClient client(view.port());
  CHECK(client.text("advertise")["channels"].size() == 10);
  for (const int channel : {1, 2, 3, 5, 6, 7}) {
    client.subscribe(channel);
    CHECK(client.message(static_cast<std::uint32_t>(channel)).is_object());
  }
  client.subscribe(4);
  std::uint64_t next = 0;
  for (int i = 0; i < 10; ++i) {
    const Json cycles = client.message(4);
    for (const Json& number : cycles["number"]) {
      if (next > 0) CHECK(number == next);
      next = number.get<std::uint64_t>() + 1;
    }
  }
  WebClient other(view.port());
  CHECK(other.call("/go", {{"positions", {{"elbow", 0.5}}}})["success"] == true);
  CHECK(other.call("/go", {{"positions", {{"knee", 0.5}}}})["success"] == false);
  other.send(R"({"op":"setParameters","parameters":[{"name":"pid.elbow.p","value":44}],"id":"s"})");
  CHECK(other.text("parameterValues")["parameters"][0]["value"] == 44.0);
  other.send(R"({"op":"advertise","channels":[{"id":1,"topic":"/reference","encoding":"json"}]})");
  other.send("\x01" + WebClient::number(1) + R"({"name":["elbow"],"position":[-0.25]})", false);
  while (client.message(1)["position"][1] != -0.25) {
  }
}

TEST_CASE("who answers pings is known to be there") {
  FakePort port;
  const View view(port, operating());
  WebClient client(view.port());
  client.subscribe(1);  // reading answers pings
  while (port.signs_of_life() < 2) (void)client.message(1);
  CHECK(client.is_connected());
}

TEST_CASE("who only reads is not taken for gone") {
  FakePort port;
  ViewOptions options = operating();
  options.patience = 1;
  const View view(port, options);
  WebClient client(view.port());
  client.subscribe(4);
  const auto newest = [&] { return client.message(4)["number"].back().get<std::uint64_t>(); };
  const std::uint64_t begin = newest();
  while (newest() < begin + 3500) {  // cycles of a millisecond: three times the patience
  }
  CHECK(client.is_connected());
}

// --- hostile clients ---------------------------------------------------------------------------

TEST_CASE("pages of other origins are refused") {
  FakePort port;
  int warnings = 0;
  ViewOptions options = operating();
  options.origins = {"https://app.foxglove.dev"};
  options.warn = [&](const std::string& text) {
    CHECK(text.starts_with("view: refused: "));
    ++warnings;
  };
  {
    const View view(port, options);
    const std::string own = "http://127.0.0.1:" + std::to_string(view.port());
    const char* const protocol = "foxglove.websocket.v1";
    CHECK(WebClient(view.port(), protocol, own).is_connected());
    CHECK(WebClient(view.port(), protocol, "https://app.foxglove.dev").is_connected());
    for (const std::string& origin :
         {std::string("https://evil.example"), std::string("null"), own + "0"}) {
      WebClient client(view.port(), protocol, origin);
      CHECK_FALSE(client.is_connected());
      CHECK(client.response().result_int() == 403);
    }
  }
  CHECK(warnings >= 1);  // at most one a second
}

TEST_CASE("a name that was bound to this machine's address is refused") {
  FakePort port;
  const View view(port, {.port = 0, .warn = [](const std::string&) {}});
  CHECK(support::get(view.port(), "/").result_int() == 200);
  CHECK(support::get(view.port(), "/", "Host: evil.example\r\n").result_int() == 421);
  const auto upgrade = support::get(
      view.port(), "/",
      "Host: evil.example\r\nOrigin: http://evil.example\r\nUpgrade: websocket\r\nConnection: "
      "upgrade\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n"
      "Sec-WebSocket-Protocol: foxglove.sdk.v1\r\n");
  CHECK(upgrade.result_int() == 421);
}

TEST_CASE("what a client sends cannot command the terminal that prints a warning") {
  FakePort port;
  std::promise<std::string> warned;
  auto warning = warned.get_future();
  const View view(port,
                  {.port = 0, .warn = [&](const std::string& text) { warned.set_value(text); }});
  // C1 characters command terminals as ESC [ does, which HTTP forbids. 9Bh alone is not UTF-8.
  CHECK(support::get(view.port(), "/",
                     "Host: a\xc2\x9b\x9b"
                     "31m\xc3\xa9\r\n")
            .result_int() == 421);
  CHECK(warning.get() ==
        "view: refused: the host 'a??31m\xc3\xa9' is not a name of this server; use 127.0.0.1");
}

TEST_CASE("who does not know the token gets nothing but the code of the page") {
  FakePort port;
  const std::string token = "0123456789abcdef";
  const View view(port, {.address = "0.0.0.0",
                         .port = 0,
                         .operates = true,
                         .token = token,
                         .warn = [](const std::string&) {}});
  CHECK(view.url().ends_with("/?token=" + token));
  const char* const protocol = "foxglove.websocket.v1";
  for (const std::string& target : {std::string("/"), std::string("/?token="),
                                    "/?token=" + token + "0", "/?token=" + token.substr(1)}) {
    INFO(target);
    CHECK(support::get(view.port(), target).result_int() == 401);
    CHECK(support::get(view.port(), "/meshes/a/b" + target.substr(1)).result_int() == 401);
    WebClient client(view.port(), protocol, {}, target);
    CHECK_FALSE(client.is_connected());
    CHECK(client.response().result_int() == 401);
  }
  CHECK(support::get(view.port(), "/?token=" + token).result_int() == 200);
  CHECK(WebClient(view.port(), protocol, {}, "/?token=" + token).is_connected());
}

TEST_CASE("requests that are not HTTP, or too long, end their connection alone") {
  FakePort port;
  const View view(port, {.port = 0, .warn = [](const std::string&) {}});
  for (const std::string& bytes :
       {std::string("\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", 11), std::string("x\r\n\r\n"),
        "GET / HTTP/1.1\r\nHost: localhost\r\nX: " + std::string(10000, 'x') + "\r\n\r\n",
        "GET /" + std::string(100000, 'x') + " HTTP/1.1\r\n\r\n",
        std::string("GET / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 99999999\r\n\r\nx"),
        std::string("GET / HTTP/1.1\r\nHost: localhost\r\nContent-Length: -1\r\n\r\n")}) {
    RawClient client(view.port());
    client.send(bytes);
    client.wait_for_end();
  }
  RawClient client(view.port());
  client.send("POST / HTTP/1.1\r\nHost: localhost\r\n\r\n");
  CHECK(client.response()->result_int() == 405);
  for (const char* target : {"*", "/%zz", "http://localhost/"}) {
    CHECK(support::get(view.port(), target).result_int() == 400);
  }
  CHECK(support::get(view.port(), "/").result_int() == 200);
}

TEST_CASE("a message that is too long ends its connection alone") {
  FakePort port;
  ViewOptions options = operating();
  options.message_limit = 10'000;
  const View view(port, options);
  WebClient watcher(view.port());
  watcher.subscribe(1);
  WebClient client(view.port());
  client.send(std::string(9'000, ' '));
  CHECK(client.text("status")["message"] == "a text must be a JSON object");
  client.send(std::string(20'000, ' '));
  client.wait_for_end();
  CHECK_FALSE(client.is_connected());  // the reason may be lost with what was not read
  (void)watcher.message(1);
}

TEST_CASE("frames that break the protocol of WebSockets end their connection alone") {
  FakePort port;
  const View view(port, operating());
  for (const std::string& bytes :
       {std::string("\x81\x02{}", 4),            // not masked
        std::string("\xf1\x82\0\0\0\0{}", 8),    // reserved bits
        std::string("\x83\x82\0\0\0\0{}", 8),    // an opcode that does not exist
        std::string("\x81\x81\0\0\0\0\xff", 7),  // not UTF-8
        std::string("\x82\xff\x7f\xff\xff\xff\xff\xff\xff\xff", 10)}) {  // 2^63 - 1 bytes
    WebClient client(view.port());
    client.send_raw(bytes);
    client.wait_for_end();
  }
  CHECK(WebClient(view.port()).call("/situation", Json::object())["success"] == true);
}

TEST_CASE("no more clients are let in than the limit") {
  FakePort port;
  const View view(port, {.port = 0, .client_limit = 2, .warn = [](const std::string&) {}});
  WebClient first(view.port());
  {
    WebClient second(view.port()), third(view.port());
    CHECK(second.is_connected());
    CHECK_FALSE(third.is_connected());
    CHECK(third.response().result_int() == 503);
    CHECK(view.clients() == 2);
  }
  REQUIRE(comes_true([&] { return view.clients() == 1; }));
  CHECK(WebClient(view.port()).is_connected());
  CHECK(first.text("serverInfo")["op"] == "serverInfo");
}

TEST_CASE("connections that say nothing do not keep others out for ever") {
  FakePort port;
  const View view(port, {.port = 0, .client_limit = 1});
  std::vector<std::unique_ptr<RawClient>> silent;
  for (int i = 0; i < 100; ++i) silent.push_back(std::make_unique<RawClient>(view.port()));
  CHECK(support::get(view.port(), "/").result_int() == 200);  // the oldest one made room
  CHECK(WebClient(view.port()).is_connected());
  silent.front()->wait_for_end();
}

TEST_CASE("connections that ask again and again end, and one that is refused ends at once") {
  FakePort port;
  const View view(port, {.port = 0, .warn = [](const std::string&) {}});
  RawClient refused(view.port());
  refused.send("GET /nothing HTTP/1.1\r\nHost: localhost\r\n\r\n");
  const auto response = refused.response();
  REQUIRE(response);
  CHECK(response->result_int() == 404);
  CHECK_FALSE(response->keep_alive());
  refused.wait_for_end();
  RawClient busy(view.port());
  CHECK(comes_true([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    busy.send("GET / HTTP/1.1\r\nHost: localhost\r\n\r\n");
    const auto answer = busy.response();
    return !answer || !answer->keep_alive();
  }));
}

// --- clients that fail -------------------------------------------------------------------------

TEST_CASE("a client that reads nothing is dropped, and the others feel nothing") {
  FakePort port;
  ViewOptions options = operating();
  options.patience = 3;
  std::string warning;
  options.warn = [&](const std::string& text) { warning = text; };
  {
    const View view(port, options);
    WebClient watcher(view.port());
    watcher.subscribe(4);
    std::atomic<bool> ends = false, has_gap = false;
    std::atomic<int> messages = 0;
    std::thread watching([&] {
      std::uint64_t next = 0;
      while (!ends) {
        const Json cycles = watcher.message(4);
        ++messages;
        for (const Json& number : cycles["number"]) {
          if (next > 0 && number != next) has_gap = true;
          next = number.get<std::uint64_t>() + 1;
        }
      }
    });
    WebClient stalled(view.port(), "foxglove.websocket.v1", {}, "/", 4096);
    CHECK(comes_true([&] { return view.clients() == 2; }));
    // It asks for megabytes, and reads none of them.
    for (int i = 0; i < 1000 && view.clients() == 2; ++i) {
      stalled.send(R"({"op":"getParameters","parameterNames":[],"id":")" + std::string(1000, 'x') +
                   "\"}");
    }
    CHECK(comes_true([&] { return view.clients() == 1; }));
    const int before = messages;
    CHECK(comes_true([&] { return messages > before + 10; }));
    CHECK_FALSE(has_gap);
    ends = true;
    watching.join();
  }
  CHECK(warning.starts_with("view: a client was dropped: "));
}

TEST_CASE("a client that asks too fast is read slower, and the others feel nothing") {
  FakePort port;
  ViewOptions options = operating();
  options.messages_per_second = 100;
  const View view(port, options);
  WebClient watcher(view.port()), hasty(view.port());
  watcher.subscribe(4);
  const auto newest = [&] { return watcher.message(4)["number"].back().get<std::uint64_t>(); };
  const std::uint64_t begin = newest();
  std::atomic<bool> is_served = false;
  std::thread asking([&] {
    for (int i = 0; i < 250; ++i) hasty.send_call("/statistics", Json::object());
    for (int i = 0; i < 250; ++i) (void)hasty.answer();
    is_served = true;
  });
  int messages = 0;  // that reach the watcher while the other one asks
  std::uint64_t last = begin;
  bool has_gap = false;
  while (!is_served) {
    const Json cycles = watcher.message(4);
    if (!is_served) ++messages;
    for (const Json& number : cycles["number"]) {
      if (number != last + 1) has_gap = true;
      last = number.get<std::uint64_t>();
    }
  }
  asking.join();
  CHECK(messages > 10);
  CHECK_FALSE(has_gap);
  // 150 messages beyond the first hundred take 1.5 s, and the port makes a thousand cycles a
  // second.
  CHECK(hasty.call("/statistics", Json::object())["cycles"] > begin + 1400);
}

TEST_CASE("a long message counts once for each kilobyte") {
  FakePort port;
  ViewOptions options = operating();
  options.messages_per_second = 100;
  const View view(port, options);
  WebClient client(view.port());
  const auto cycles = [&] {
    return client.call("/statistics", Json::object())["cycles"].get<std::uint64_t>();
  };
  const std::uint64_t begin = cycles();
  client.send(std::string(400 << 10, ' '));
  CHECK(cycles() > begin + 2900);  // 300 messages beyond the first hundred take 3 s
}

TEST_CASE("a connection that is cut anywhere ends its session and gives the controls back") {
  FakePort port;
  const View view(port, operating());
  const int sessions = port.sessions();
  const auto is_free = [&] { return port.situation().operator_name.empty(); };
  for (int i = 0; i < 20; ++i) {
    WebClient client(view.port());
    CHECK(client.call("/take_controls", Json::object())["success"] == true);
    CHECK_FALSE(is_free());
    if (i % 4 == 1) client.send_call("/robot", Json::object());       // before its answer
    if (i % 4 == 2) client.send_raw(std::string("\x82\xfe\x10", 3));  // in the middle of a frame
    if (i % 4 == 3) client.subscribe(4);                              // in the middle of a stream
    client.cut();
    REQUIRE(comes_true([&] { return port.sessions() == sessions && is_free(); }));
  }
  // In the middle of a handshake.
  const std::string upgrade =
      "GET / HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: upgrade\r\n"
      "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n"
      "Sec-WebSocket-Protocol: foxglove.sdk.v1\r\n\r\n";
  for (std::size_t size = 0; size <= upgrade.size(); size += 7) {
    RawClient(view.port()).send(upgrade.substr(0, size));
  }
  REQUIRE(comes_true([&] { return port.sessions() == sessions; }));
  CHECK(WebClient(view.port()).is_connected());
}

TEST_CASE("a port that fails for a while costs no connection") {
  FakePort port;
  std::atomic<int> warnings = 0;
  ViewOptions options = operating();
  options.warn = [&](const std::string& text) {
    CHECK(text == "view: a port that fails");
    ++warnings;
  };
  const View view(port, options);
  WebClient client(view.port());
  client.subscribe(1);
  (void)client.message(1);
  port.fail(true);
  REQUIRE(comes_true([&] { return warnings > 0; }));
  port.fail(false);
  (void)client.message(1);
  (void)client.message(1);
}

// --- the view itself ---------------------------------------------------------------------------

TEST_CASE("the end of a view says good-bye to its clients") {
  FakePort port;
  auto view = std::make_unique<View>(port, operating());
  WebClient client(view->port());
  REQUIRE(comes_true([&] { return port.sessions() == 2; }));  // the client's, and the view's own
  std::thread end([&] { view.reset(); });
  client.wait_for_end();
  end.join();
  CHECK(client.close_code() == support::beast::websocket::close_code::going_away);
  CHECK(port.sessions() == 0);
}

TEST_CASE("views begin and end while clients come and go") {
  FakePort port;
  for (int i = 0; i < 20; ++i) {
    auto view = std::make_unique<View>(port, operating());
    WebClient client(view->port());
    client.subscribe(4);
    if (i % 2 == 0) (void)client.message(4);
    if (i % 3 == 0) client.cut();
    view.reset();
    CHECK(port.sessions() == 0);
  }
}

TEST_CASE("a port in use, and options that make no sense, are refused with the cure") {
  FakePort port;
  const View view(port, {.port = 0});
  CHECK(view.url() == "http://127.0.0.1:" + std::to_string(view.port()) + "/");
  try {
    const View second(port, {.port = view.port()});
    FAIL("two views on one port");
  } catch (const std::system_error& error) {
    CHECK(std::string(error.what()).find("choose another port") != std::string::npos);
  }
  CHECK_THROWS_WITH(
      View(port, {.address = "localhost", .port = 0}),
      "view: 'localhost' is not an address; expected one as \"127.0.0.1\" or \"::1\"");
  CHECK_THROWS_AS(View(port, {.address = "0.0.0.0", .port = 0}), std::invalid_argument);
  CHECK_THROWS_AS(View(port, {.port = 0, .page_folder = "/no/such"}), std::invalid_argument);
  CHECK_THROWS_AS(View(port, {.port = 0, .mesh_folders = {{"a", "/no/such"}}}),
                  std::invalid_argument);
  CHECK_THROWS_AS(View(port, {.port = 0, .client_limit = 0}), std::invalid_argument);
  CHECK_THROWS_AS(View(port, {.port = 0, .message_limit = 1}), std::invalid_argument);
  CHECK_THROWS_AS(View(port, {.port = 0, .messages_per_second = 0}), std::invalid_argument);
  CHECK_THROWS_AS(View(port, {.port = 0, .queue_limit = 0}), std::invalid_argument);
  CHECK_THROWS_AS(View(port, {.port = 0, .patience = 0}), std::invalid_argument);
  CHECK(port.sessions() == 1);  // of the one view
}

// SPDX-License-Identifier: Apache-2.0
/// @file Command lines that make no sense, servers that are none, and completion.
#include "catch.hpp"
#include "completion.hpp"
#include "scratch_file.hpp"
#include "terminal.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>

#include <algorithm>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

using support::offered;
using support::Result;
using support::run_articula;

namespace {

using Words = std::vector<std::string>;
using boost::asio::ip::tcp;

std::string joined(const Words& words) {
  std::string text;
  for (const std::string& word : words) text += word + " ";
  return text;
}

/// A server that answers every connection by a text, and closes it.
class OddServer {
 public:
  explicit OddServer(std::string answer)
      : acceptor_(context_, {boost::asio::ip::address_v4::loopback(), 0}),
        thread_([this, text = std::move(answer)] {
          for (;;) {
            boost::system::error_code error;
            tcp::socket client(context_);
            acceptor_.accept(client, error);
            if (error || ends_) return;
            boost::asio::write(client, boost::asio::buffer(text), error);
          }
        }) {}
  ~OddServer() {
    ends_ = true;
    boost::system::error_code ignored;
    tcp::socket last(context_);
    last.connect(acceptor_.local_endpoint(), ignored);  // wakes it up
    thread_.join();
  }
  OddServer(const OddServer&) = delete;
  OddServer& operator=(const OddServer&) = delete;
  [[nodiscard]] std::string port() const {
    return std::to_string(acceptor_.local_endpoint().port());
  }

 private:
  boost::asio::io_context context_;
  tcp::acceptor acceptor_;
  std::atomic<bool> ends_ = false;
  std::thread thread_;
};

}  // namespace

TEST_CASE("what a command lacks, or has too much, is named") {
  const auto says = [](const Words& words, const std::string& text) {
    CAPTURE(joined(words));
    CHECK_THAT(run_articula(words).errors, Catch::Contains(text));
  };
  says({"gains", "set"}, "values is required, see: articula gains set --help");
  says({"status", "--jsn"}, "status takes no '--jsn'; did you mean '--json'?");
  says({"fault", "ack", "now"}, "fault ack takes no 'now'; options: --help, ");
  says({"play", "/"}, "/: it is a folder, expected a file");
}

TEST_CASE("a command line that makes no sense gets one line and exit status 2") {
  for (const Words& words : std::vector<Words>{{},
                                               {"nonsense"},
                                               {"status", "nonsense"},
                                               {"status", "--nonsense"},
                                               {"--port", "70000", "status"},
                                               {"--port", "-1", "status"},
                                               {"--port", "x", "status"},
                                               {"--address"},
                                               {"go"},
                                               {"go", "elbow"},
                                               {"go", "=1"},
                                               {"go", "elbow="},
                                               {"go", "elbow=x"},
                                               {"go", "elbow=nan"},
                                               {"go", "elbow=inf"},
                                               {"go", "elbow=1e999"},
                                               {"go", "elbow=1,5"},
                                               {"go", "elbow=0.1", "elbow=0.2"},
                                               {"go", "elbow=0.1", "--speed", "2"},
                                               {"go", "elbow=0.1", "--speed", "0"},
                                               {"go", "elbow=0.1", "--speed", "nan"},
                                               {"step", "1.5"},
                                               {"run", "a.urdf", "b.yaml", "--rate", "nan"},
                                               {"publish"},
                                               {"publish", "elbow=0.1", "--rate", "0"},
                                               {"publish", "elbow=0.1", "--seconds", "1"},
                                               {"publish", "--effort", "elbow=x"},
                                               {"play"},
                                               {"switch"},
                                               {"fault"},
                                               {"fault", "nonsense"},
                                               {"gains"},
                                               {"gains", "set"},
                                               {"gains", "set", "p"},
                                               {"gains", "set", "p=0x10"},
                                               {"gains", "set", "p=none"},
                                               {"go", "elbow=inf"},
                                               {"gains", "set", "p=1", "p=2"},
                                               {"speed"},
                                               {"speed", "0"},
                                               {"speed", "1000"},
                                               {"step", "0"},
                                               {"step", "-1"},
                                               {"step", "99999999999999999999"},
                                               {"reset", "elbow"},
                                               {"pull"},
                                               {"pull", "tool_link"},
                                               {"pull", "tool_link", "--force", "1", "2"},
                                               {"watch", "--rate", "0"},
                                               {"watch", "--seconds", "-1"},
                                               {"record"},
                                               {"joints"},
                                               {"run"},
                                               {"run", "arm.urdf"},
                                               {"run", "a", "b", "--ros2", "--domain", "233"},
                                               {"run", "a", "b", "--ros2", "--distribution", "k"},
                                               {"run", "a", "b", "--namespace", "/left"},
                                               {"simulate"},
                                               {"simulate", "arm.urdf", "--command", "jerk"},
                                               {"new", "arm.urdf"},
                                               {"completion"},
                                               {"completion", "powershell"},
                                               {std::string(100000, 'x')}}) {
    CAPTURE(joined(words).substr(0, 200));
    const Result result = run_articula(words);
    CHECK(result.exit_code == 2);
    CHECK(result.output.empty());
    CHECK(std::ranges::count(result.errors, '\n') == 1);
    CHECK(result.errors.starts_with("articula: "));
  }
}

TEST_CASE("a command that is missing or misspelt gets an example and the nearest one") {
  struct Row {
    Words words;
    Words told;
  };
  const std::string example = "articula go shoulder_active_joint=0.5";
  for (const Row& row :
       std::vector<Row>{{{}, {"a command is missing", example, "status", "completion"}},
                        {{"--json", "statsu"}, {"'statsu'", example, "did you mean 'status'?"}},
                        {{"goo", "elbow=0.5"}, {"'goo'", "did you mean 'go'?"}},
                        {{"--port", "1", "nonsense"}, {"'nonsense'", example, "controllers"}},
                        {{"gains", "sett", "p=1"}, {"'sett'", "gains get", "did you mean 'set'?"}},
                        {{"fault"}, {"a command is missing", "articula fault ack"}},
                        {{"go"}, {"go: ", "positions", example}}}) {
    CAPTURE(joined(row.words));
    const Result result = run_articula(row.words);
    CHECK(result.exit_code == 2);
    const std::string text = result.output + result.errors;
    CAPTURE(text);
    for (const std::string& word : row.told) CHECK(text.find(word) != std::string::npos);
    CHECK(text.find("names") == std::string::npos);  // a hidden command
  }
}

TEST_CASE("the refusal of a command line is JSON where JSON is asked for") {
  const auto json = run_articula({"--json", "go", "elbow=x"}).json();
  CHECK(json.at("success") == false);
  CHECK(json.at("exit_code") == 2);
  CHECK(json.at("message").get<std::string>().find("'x'") != std::string::npos);
}

TEST_CASE("help and version are no errors") {
  for (const Words& words : std::vector<Words>{
           {"--help"}, {"--version"}, {"go", "--help"}, {"gains", "set", "--help"}}) {
    CAPTURE(joined(words));
    const Result result = run_articula(words);
    CHECK(result.exit_code == 0);
    CHECK(result.output.find("articula") != std::string::npos);
  }
}

TEST_CASE("where no loop can be reached, the message says so and what to do") {
  const Result nobody = run_articula({"--port", "1", "status"});
  CHECK(nobody.exit_code == 3);
  CHECK(nobody.errors.find("--port") != std::string::npos);
  CHECK(run_articula({"--address", "no such host", "status"}).exit_code == 3);
  for (const std::string answer :
       {"", "nonsense", "HTTP/1.1 200 OK\r\nContent-Length: 2\r\n\r\nok",
        "HTTP/1.1 404 Not Found\r\nContent-Length: 0\r\n\r\n",
        "HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
        "Sec-WebSocket-Accept: bm9uc2Vuc2U=\r\n\r\n"}) {
    CAPTURE(answer);
    const OddServer server(answer);
    for (const char* command : {"status", "stop", "controllers"}) {
      const Result result = run_articula({"--port", server.port(), command});
      CHECK(result.exit_code == 3);
      CHECK(std::ranges::count(result.errors, '\n') == 1);
    }
  }
}

TEST_CASE("a bad file is refused before a loop is looked for") {
  const support::ScratchFile file("bad.yaml");
  std::ofstream(file.path()) << "points: 1";
  CHECK(run_articula({"--port", "1", "play", file.path().string()}).exit_code == 1);
}

TEST_CASE("bash completes commands and options") {
  const auto has = [](const Words& words, const std::string& word) {
    return std::ranges::find(words, word) != words.end();
  };
  CHECK(has(offered({""}), "status"));
  CHECK(offered({"contr"}) == Words{"controllers"});
  CHECK(has(offered({"gains", ""}), "set"));
  CHECK_FALSE(has(offered({"gains", ""}), "status"));
  CHECK(has(offered({"--port", "1", "switch", "--st"}), "--start"));
  CHECK(has(offered({"fault", "a"}), "ack"));
}

TEST_CASE("the other shells get scripts of the same commands") {
  for (const std::string shell : {"zsh", "fish"}) {
    const Result result = run_articula({"completion", shell});
    CAPTURE(shell);
    CHECK(result.exit_code == 0);
    for (const char* word : {"controllers", "ack", "best-effort"}) {
      CHECK(result.output.find(word) != std::string::npos);
    }
  }
}

// SPDX-License-Identifier: Apache-2.0
// Reads requests to the loop of a page and prints all cycles and answers, as live_requests.mjs does
// of the same loop in WebAssembly.
#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <string>

extern "C" {
std::size_t articula_open();
char* articula_incoming(std::size_t size);
void articula_receive(int is_text);
void articula_advance(double seconds, double wall);
int articula_take();
const char* articula_outgoing();
std::size_t articula_outgoing_size();
}

namespace {

std::map<std::string, std::uint32_t> services;

void send(bool is_text, const std::string& bytes) {
  bytes.copy(articula_incoming(bytes.size()), bytes.size());
  articula_receive(is_text ? 1 : 0);
}

std::string number(std::uint32_t value) {
  std::string bytes;
  for (int i = 0; i < 4; ++i, value >>= 8) bytes += static_cast<char>(value & 0xff);
  return bytes;
}

/// Reads what the loop sends: learns its services, subscribes to its cycles, prints them and
/// answers.
void receive() {
  while (const int kind = articula_take()) {
    const std::string frame(articula_outgoing(), articula_outgoing_size());
    if (kind == 1) {
      std::cout << frame.substr(frame[0] == 1 ? 13 : 17) << '\n';  // of a message, of an answer
      continue;
    }
    const auto json = nlohmann::json::parse(frame);
    if (json["op"] == "advertiseServices") {
      for (const auto& service : json["services"]) services[service["name"]] = service["id"];
    }
    if (json["op"] != "advertise") continue;
    for (const auto& channel : json["channels"]) {
      if (channel["topic"] != "/cycles") continue;
      const nlohmann::json subscription = {{"id", 1}, {"channelId", channel["id"]}};
      send(true, nlohmann::json{{"op", "subscribe"}, {"subscriptions", {subscription}}}.dump());
    }
  }
}

}  // namespace

int main(int, char** arguments) {
  if (articula_open() != 0) return 1;
  receive();
  std::ifstream file(arguments[1]);
  std::uint32_t call = 0;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string what, service;
    words >> what;
    if (what == "call") {
      words >> service >> std::ws;
      std::string request;
      std::getline(words, request);
      send(false,
           "\2" + number(services.at(service)) + number(++call) + number(4) + "json" + request);
      continue;
    }
    double seconds = 0;
    int count = 0;
    words >> seconds >> count;
    for (int k = 0; k < count; ++k) {
      articula_advance(seconds, 0);
      receive();
    }
  }
}

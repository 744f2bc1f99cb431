// SPDX-License-Identifier: Apache-2.0
/// @file Runs the program articula as a user does.
#pragma once

#include <nlohmann/json.hpp>

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

extern char** environ;  // NOLINT: POSIX

namespace support {

/// What a program has left.
struct Result {
  int exit_code = -1;  ///< -1: ended by a signal
  std::string output{};
  std::string errors{};

  /// The JSON document of the output.
  [[nodiscard]] nlohmann::json json() const { return nlohmann::json::parse(output); }
};

/// A program that runs beside the test.
class Process {
 public:
  explicit Process(std::vector<std::string> words) {
    if (pipe(output_.data()) != 0 || pipe(errors_.data()) != 0) throw std::runtime_error("pipe");
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, output_[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, errors_[1], STDERR_FILENO);
    for (const int end : {output_[0], output_[1], errors_[0], errors_[1]}) {
      posix_spawn_file_actions_addclose(&actions, end);
    }
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const int error =
        posix_spawnp(&process_, words[0].c_str(), &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(output_[1]);
    close(errors_[1]);
    if (error != 0) throw std::runtime_error("cannot start " + words[0]);
  }
  ~Process() {
    if (process_ > 0) {
      kill(process_, SIGKILL);
      waitpid(process_, nullptr, 0);
    }
    close(output_[0]);
    close(errors_[0]);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// The next line of its output or of its errors; empty at the end.
  [[nodiscard]] std::string line() { return line_of(output_[0]); }
  [[nodiscard]] std::string error_line() { return line_of(errors_[0]); }
  void interrupt() const { kill(process_, SIGINT); }

  /// Waits for its end.
  [[nodiscard]] Result end() {
    Result result;
    // What a command writes to its errors is far less than a pipe takes.
    result.output = all(output_[0]);
    result.errors = all(errors_[0]);
    int status = 0;
    while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = 0;
    if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
    return result;
  }

 private:
  [[nodiscard]] static std::string line_of(int end) {
    std::string text;
    for (char c = 0; read(end, &c, 1) == 1 && c != '\n';) text += c;
    return text;
  }
  [[nodiscard]] static std::string all(int end) {
    std::string text;
    std::array<char, 4096> buffer{};
    for (ssize_t size = 1; size != 0;) {
      size = read(end, buffer.data(), buffer.size());
      if (size < 0 && errno != EINTR) break;
      if (size > 0) text.append(buffer.data(), static_cast<std::size_t>(size));
    }
    return text;
  }

  pid_t process_ = 0;
  std::array<int, 2> output_{}, errors_{};
};

/// Runs articula with arguments and waits for its end.
[[nodiscard]] inline Result run_articula(std::vector<std::string> words) {
  words.insert(words.begin(), ARTICULA_PROGRAM);
  return Process(std::move(words)).end();
}

}  // namespace support

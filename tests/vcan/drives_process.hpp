// SPDX-License-Identifier: Apache-2.0
/// @file The program can_drives, as a process of its own.
#pragma once

#include "catch.hpp"

#include <csignal>
#include <string>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

namespace support {

/// can_drives from this folder, running and listening. Killed at the end.
class DrivesProcess {
 public:
  explicit DrivesProcess(std::vector<std::string> arguments = {"--lockstep"}) {
    int ends[2] = {-1, -1};
    REQUIRE(::pipe(ends) == 0);
    arguments.insert(arguments.begin(), "./can_drives");
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    process_ = ::fork();
    REQUIRE(process_ >= 0);
    if (process_ == 0) {
      ::dup2(ends[1], STDOUT_FILENO);
      ::close(ends[0]);
      ::close(ends[1]);
      ::execv(pointers[0], pointers.data());
      ::_exit(127);
    }
    ::close(ends[1]);
    output_ = ends[0];
    char c = 0;  // its first line says that it listens
    while (c != '\n') REQUIRE(::read(output_, &c, 1) == 1);
  }
  DrivesProcess(const DrivesProcess&) = delete;
  DrivesProcess& operator=(const DrivesProcess&) = delete;
  ~DrivesProcess() {
    kill();
    ::close(output_);
  }

  void kill() {
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
    process_ = -1;
  }

 private:
  pid_t process_ = -1;
  int output_ = -1;
};

}  // namespace support

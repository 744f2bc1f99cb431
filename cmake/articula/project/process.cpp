// SPDX-License-Identifier: Apache-2.0
#include "project/process.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <array>
#include <cerrno>
#include <cstddef>

extern char** environ;  // NOLINT: POSIX

namespace terminal {

ProcessEnd run_process(std::vector<std::string> words, bool with_errors) {
  ProcessEnd end;
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) return end;
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  if (with_errors) posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
  posix_spawn_file_actions_addclose(&actions, ends[0]);
  posix_spawn_file_actions_addclose(&actions, ends[1]);
  pid_t process = 0;
  const int error =
      posix_spawnp(&process, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  end.is_found = error == 0;
  std::array<char, 65536> buffer{};
  for (ssize_t size = 1; end.is_found && size != 0;) {
    size = ::read(ends[0], buffer.data(), buffer.size());
    if (size < 0 && errno == EINTR) continue;
    if (size < 0) break;
    end.output.append(buffer.data(), static_cast<std::size_t>(size));
  }
  close(ends[0]);
  if (!end.is_found) return end;
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  end.is_done = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  return end;
}

}  // namespace terminal

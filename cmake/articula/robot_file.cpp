// SPDX-License-Identifier: Apache-2.0
#include "robot_file.hpp"

#include "program.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <array>
#include <cerrno>
#include <filesystem>

extern char** environ;  // NOLINT: POSIX

namespace terminal {

namespace {

/// What a program writes to its standard output.
/// @return whether it could be started and ended well
bool read_output(std::array<char*, 4> words, std::string& output) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) return false;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_addclose(&actions, ends[0]);
  posix_spawn_file_actions_addclose(&actions, ends[1]);
  pid_t process = 0;
  const int error = posix_spawnp(&process, words[0], &actions, nullptr, words.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  std::array<char, 65536> buffer{};
  for (ssize_t size = 1; error == 0 && size != 0;) {
    size = ::read(ends[0], buffer.data(), buffer.size());
    if (size < 0 && errno == EINTR) continue;
    if (size < 0) break;
    output.append(buffer.data(), static_cast<std::size_t>(size));
  }
  close(ends[0]);
  if (error != 0) {
    errno = error;
    return false;
  }
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  errno = 0;
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

articula::UrdfSource robot_source(const std::string& file) {
  if (!file.ends_with(".xacro")) return {std::filesystem::path(file)};
  std::string program = "xacro", path = file, text;
  if (!read_output({program.data(), path.data(), nullptr}, text)) {
    throw Refusal(errno == ENOENT
                      ? file +
                            ": the program xacro is not installed; install it (Debian and ROS: "
                            "xacro), or expand the file elsewhere and give the URDF"
                      : file + ": xacro cannot expand it, see above");
  }
  return {std::string_view(text)};
}

}  // namespace terminal

// SPDX-License-Identifier: Apache-2.0
#include "files/folder_lock.hpp"

#include "program.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>

namespace terminal {

FolderLock::FolderLock(const std::filesystem::path& folder, IfTaken if_taken)
    : file_(open((folder / "lock").c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0644)) {
  const std::string name = (folder / "lock").string();
  if (file_ < 0) throw Refusal("cannot write " + name + ": " + std::strerror(errno));
  if (flock(file_, if_taken == IfTaken::wait ? LOCK_EX : LOCK_EX | LOCK_NB) == 0) return;
  const int error = errno;
  if (error == EWOULDBLOCK) {
    close(file_);
    throw Refusal(folder.string() + ": another process works in this folder");
  }
  // Some file systems of clusters have no locks.
  std::fprintf(stderr, "note: %s is not locked: %s\n", name.c_str(), std::strerror(error));
}

FolderLock::~FolderLock() { close(file_); }

}  // namespace terminal

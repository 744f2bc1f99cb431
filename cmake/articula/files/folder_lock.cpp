// SPDX-License-Identifier: Apache-2.0
#include "files/folder_lock.hpp"

#include "program.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

namespace terminal {

FolderLock::FolderLock(const std::filesystem::path& folder, IfTaken if_taken)
    : file_(open((folder / "lock").c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0644)) {
  const int mode = if_taken == IfTaken::wait ? LOCK_EX : LOCK_EX | LOCK_NB;
  if (file_ >= 0 && flock(file_, mode) == 0) return;
  const int error = errno;
  if (file_ >= 0) close(file_);
  if (error == EWOULDBLOCK)
    throw Refusal(folder.string() + ": another process works in this folder");
  throw Refusal("cannot lock " + (folder / "lock").string() + ": " + std::strerror(error));
}

FolderLock::~FolderLock() { close(file_); }

}  // namespace terminal

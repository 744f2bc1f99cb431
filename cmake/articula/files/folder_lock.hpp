// SPDX-License-Identifier: Apache-2.0
/// @file A folder that one process has for itself.
#pragma once

#include <filesystem>

namespace terminal {

/// Locks a folder for other processes that lock it, until the end of the object or the process.
class FolderLock {
 public:
  enum class IfTaken : unsigned char { wait, refuse };

  /// @param folder  must be there; gets the file `lock`
  /// @throws Refusal if another process has the folder and `if_taken` is `refuse`, or if the file
  ///         cannot be written
  FolderLock(const std::filesystem::path& folder, IfTaken if_taken);
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  ~FolderLock();

 private:
  int file_;
};

}  // namespace terminal

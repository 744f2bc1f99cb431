// SPDX-License-Identifier: Apache-2.0
/// @file A file that a test leaves nothing of.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>

namespace support {

/// A path in the temporary folder, of this process alone; the file is removed with it.
class ScratchFile {
 public:
  explicit ScratchFile(const std::string& name)
      : path_(std::filesystem::temp_directory_path() /
              ("articula-" + std::to_string(::getpid()) + "-" + name)) {}
  ~ScratchFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace support

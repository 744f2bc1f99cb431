// SPDX-License-Identifier: Apache-2.0
/// @file A file that is written from its beginning to its end.
#pragma once

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

namespace articula::detail {

/// The file of a recording. Its functions keep the first error, which `check` throws. It is a
/// stream of the C library because WebAssembly's C++ library has no file streams.
class OutputFile {
 public:
  /// Creates the file, or empties it.
  explicit OutputFile(const std::filesystem::path& path)
      : path_(path.string()), file_(std::fopen(path_.c_str(), "wb")) {
    keep_error(file_ != nullptr);
  }

  void write(std::string_view bytes) {
    errno = EBADF;  // of a closed file
    keep_error(file_ && std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) == bytes.size());
  }

  /// Replaces bytes that were written before.
  /// @param back  distance of the first one from the end of the file [bytes]
  void replace(std::uint64_t back, std::string_view bytes) {
    keep_error(file_ && std::fseek(file_.get(), -static_cast<long>(back), SEEK_CUR) == 0);
    write(bytes);
    keep_error(file_ && std::fseek(file_.get(), 0, SEEK_END) == 0);
  }

  [[nodiscard]] bool is_open() const noexcept { return file_ != nullptr; }

  /// Writes what is left in the buffer.
  void close() { keep_error(std::fclose(file_.release()) == 0); }

  /// @throws std::runtime_error naming the file and the reason, if anything could not be written
  void check() const {
    if (error_ == 0) return;
    throw std::runtime_error("cannot write " + path_ + ": " +
                             std::generic_category().message(error_));
  }

 private:
  struct Close {
    void operator()(std::FILE* file) const noexcept { static_cast<void>(std::fclose(file)); }
  };

  void keep_error(bool good) noexcept {
    if (!good && error_ == 0) error_ = errno != 0 ? errno : EIO;
  }

  std::string path_;
  std::unique_ptr<std::FILE, Close> file_;
  int error_ = 0;  ///< errno of the first failure; 0: none
};

}  // namespace articula::detail

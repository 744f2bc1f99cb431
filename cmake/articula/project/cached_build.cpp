// SPDX-License-Identifier: Apache-2.0
#include "project/cached_build.hpp"

#include "project/process.hpp"

#include <articula/version.hpp>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace terminal {

namespace {

namespace fs = std::filesystem;

/// A variable of the environment; empty if there is none.
std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

/// FNV-1a of a text, in 16 digits.
std::string hash_of(const std::string& text) {
  std::uint64_t hash = 14695981039346656037U;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211U;
  char digits[17];  // NOLINT: for snprintf
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash));
  return digits;
}

/// Where projects are kept: XDG_CACHE_HOME/articula, by default ~/.cache/articula.
fs::path cache_folder() {
  std::string cache = variable("XDG_CACHE_HOME");
  if (cache.empty()) {
    const std::string home = variable("HOME");
    if (home.empty()) {
      throw Refusal("--compile keeps its programs below XDG_CACHE_HOME or HOME; set one of them");
    }
    cache = home + "/.cache";
  }
  return fs::path(cache) / "articula";
}

/// Runs a step of the build, whose output goes to a file.
/// @throws Refusal with what to do
void build_step(std::vector<std::string> words, const fs::path& log, const std::string& advice) {
  const ProcessEnd end = run_process(std::move(words), true);
  std::ofstream(log, std::ios::app | std::ios::binary) << end.output;
  if (!end.is_found) {
    throw Refusal("--compile needs CMake, which is not installed (Debian: cmake)");
  }
  if (!end.is_done) throw Refusal(advice + "; " + log.string() + " has the reason");
}

/// A lock on a folder, which other processes wait for.
class FolderLock {
 public:
  explicit FolderLock(const fs::path& folder)
      : file_(open((folder / "lock").c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0644)) {
    if (file_ >= 0 && flock(file_, LOCK_EX) == 0) return;
    const std::string reason = std::strerror(errno);
    if (file_ >= 0) close(file_);
    throw Refusal("cannot lock " + (folder / "lock").string() + ": " + reason);
  }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  ~FolderLock() { close(file_); }

 private:
  int file_;
};

}  // namespace

fs::path cached_build(const Project& project, const std::string& product,
                      const std::string& components) {
  const std::string compiler = variable("CXX").empty() ? "c++" : variable("CXX");
  const ProcessEnd version = run_process({compiler, "--version"}, true);
  if (!version.is_done) {
    throw Refusal("--compile needs a C++ compiler, and '" + compiler +
                  "' is none; install one (Debian: g++), or name it by the variable CXX");
  }
  std::string all = std::string(articula::library_version) + version.output;
  for (const auto& [name, text] : project.files) all += name + '\0' + text + '\0';
  const fs::path folder = cache_folder() / hash_of(all);
  const fs::path build = folder / "build", made = build / product;
  const fs::path log = folder / "build.log";
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw Refusal(folder.string() + ": " + error.message());
  const FolderLock lock(folder);
  const bool is_new = !fs::exists(made, error);
  write_project(project, folder.string());  // the same files: nothing is compiled again for them
  fs::remove(log, error);
  if (is_new) {
    std::fprintf(stderr,
                 "note: compiles the robot and its controllers in %s, once; a minute or two\n",
                 folder.c_str());
    std::vector<std::string> configure{"cmake", "-S", folder.string(), "-B", build.string()};
    // The package beside this program, if it is installed; or one that CMake finds itself.
    const fs::path prefix = fs::read_symlink("/proc/self/exe", error).parent_path().parent_path();
    if (!error && fs::exists(prefix / "include/articula", error)) {
      configure.push_back("-Darticula_ROOT=" + prefix.string());
    }
    build_step(std::move(configure), log,
               "--compile needs the installed package articula with its components " + components +
                   "; install it (docs/installation.md), or name its place by the variable "
                   "CMAKE_PREFIX_PATH");
  }
  build_step({"cmake", "--build", build.string()}, log, "the robot cannot be compiled");
  return made;
}

void run_compiled(const Project& project, std::vector<std::string> arguments) {
  const fs::path program = cached_build(project, project.name, "urdf, view and config");
  arguments.insert(arguments.begin(), program.string());
  std::vector<char*> words;
  for (std::string& argument : arguments) words.push_back(argument.data());
  words.push_back(nullptr);
  execv(program.c_str(), words.data());
  throw Refusal(program.string() + ": " + std::strerror(errno));
}

}  // namespace terminal

// SPDX-License-Identifier: Apache-2.0
#include "project/cached_build.hpp"

#include "files/folder_lock.hpp"
#include "project/process.hpp"

#include <articula/version.hpp>

#include <unistd.h>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
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

/// The words of a command such as "ccache g++".
std::vector<std::string> words_of(const std::string& command) {
  std::istringstream stream(command);
  return {std::istream_iterator<std::string>(stream), {}};
}

}  // namespace

fs::path cached_build(const Project& project, const std::string& product,
                      const std::string& components) {
  const std::string compiler = variable("CXX").empty() ? "c++" : variable("CXX");
  std::vector<std::string> ask_version = words_of(compiler);
  ask_version.emplace_back("--version");
  const ProcessEnd version = run_process(std::move(ask_version), true);
  if (!version.is_done) {
    throw Refusal("--compile needs a C++ compiler, and '" + compiler +
                  "' is none; install one (Debian: g++), or name it by the variable CXX");
  }
  // The package beside this program, if it is installed; or one that CMake finds itself.
  std::error_code error;
  fs::path prefix = fs::read_symlink("/proc/self/exe", error).parent_path().parent_path();
  if (error || !fs::exists(prefix / "include/articula", error)) prefix.clear();
  std::string all =
      std::string(articula::library_version) + version.output + prefix.string() + '\0';
  for (const auto& [name, text] : project.files) all += name + '\0' + text + '\0';
  const fs::path folder = cache_folder() / hash_of(all);
  const fs::path build = folder / "build", made = build / product;
  const fs::path log = folder / "build.log", complete = folder / "complete";
  fs::create_directories(folder, error);
  if (error) throw Refusal(folder.string() + ": " + error.message());
  const FolderLock lock(folder, FolderLock::IfTaken::wait);
  // A build that was interrupted may have left half a file that looks finished.
  const bool is_new = !fs::exists(complete, error) || !fs::exists(made, error);
  if (is_new) fs::remove_all(build, error);
  write_project(project, folder.string());  // the same files: nothing is compiled again for them
  fs::remove(log, error);
  if (is_new) {
    std::fprintf(stderr,
                 "note: compiles the robot and its controllers in %s, once; a minute or two\n",
                 folder.c_str());
    std::vector<std::string> configure{"cmake", "-S", folder.string(), "-B", build.string()};
    if (!prefix.empty()) configure.push_back("-Darticula_ROOT=" + prefix.string());
    build_step(std::move(configure), log,
               "--compile needs the installed package articula with its components " + components +
                   "; install it (docs/installation.md), or name its place by the variable "
                   "CMAKE_PREFIX_PATH");
  }
  fs::remove(complete, error);
  build_step({"cmake", "--build", build.string()}, log, "the robot cannot be compiled");
  std::ofstream(complete) << made.string() << '\n';
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

// SPDX-License-Identifier: Apache-2.0
#include "files/mesh_folders.hpp"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <set>
#include <string_view>
#include <system_error>

namespace terminal {

namespace {

namespace fs = std::filesystem;

/// The folder of a ROS package around a file: a folder of its name with a package.xml, which holds
/// the file or is beside a folder that does. Empty if there is none. The name comes from a URDF, so
/// without these rules a file could have any folder of the machine served.
std::string package_folder(const std::string& package, const std::string& file) {
  const auto belongs_to_a_name = [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-';
  };
  if (package.empty() || !std::ranges::all_of(package, belongs_to_a_name)) return {};
  std::error_code error;
  for (fs::path folder = fs::weakly_canonical(fs::path(file), error).parent_path();
       folder != folder.parent_path(); folder = folder.parent_path()) {
    const fs::path found = folder.filename() == package ? folder : folder / package;
    if (fs::exists(found / "package.xml", error)) return found.string();
  }
  return {};
}

}  // namespace

std::map<std::string, std::string> mesh_folders(const std::string& urdf, const std::string& file) {
  constexpr std::string_view scheme = "package://";
  std::map<std::string, std::string> folders;
  std::set<std::string> seen;
  for (std::size_t at = urdf.find(scheme); at != std::string::npos; at = urdf.find(scheme, at)) {
    at += scheme.size();
    const std::string package = urdf.substr(at, urdf.find_first_of("/\"' ", at) - at);
    if (!seen.insert(package).second) continue;
    const std::string folder = package_folder(package, file);
    if (folder.empty()) {
      std::fprintf(stderr,
                   "note: no meshes of package '%s': no folder of its name with a package.xml "
                   "is above the URDF or beside a folder above it\n",
                   package.c_str());
    } else {
      folders[package] = folder;
    }
  }
  return folders;
}

}  // namespace terminal

// SPDX-License-Identifier: Apache-2.0
#include "articula/view/server/clients/files.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <ios>
#include <system_error>
#include <utility>

namespace articula::view {

namespace {

bool is_plain(std::string_view part) {
  return !part.empty() && part.front() != '.' && std::all_of(part.begin(), part.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte >= 0x20 && byte != 0x7f && c != '\\' && c != ':';
  });
}

/// Whether no part leads upwards, is hidden, or has a character that a file system may take for
/// something else.
bool are_plain(std::string_view relative) {
  while (true) {
    const std::size_t slash = relative.find('/');
    if (!is_plain(relative.substr(0, slash))) return false;
    if (slash == std::string_view::npos) return true;
    relative.remove_prefix(slash + 1);
  }
}

}  // namespace

std::optional<std::filesystem::path> file_in(const std::filesystem::path& folder,
                                             std::string_view relative) {
  namespace fs = std::filesystem;
  if (folder.empty() || !are_plain(relative)) return std::nullopt;
  std::error_code error;
  const fs::path root = fs::canonical(folder, error);
  if (error) return std::nullopt;
  const fs::path file = fs::canonical(root / fs::path(relative), error);
  if (error || !fs::is_regular_file(file, error) || error) return std::nullopt;
  // Symbolic links are resolved now, so the file is inside if its path begins with the folder's.
  const auto [end, other] = std::mismatch(root.begin(), root.end(), file.begin(), file.end());
  if (end != root.end()) return std::nullopt;
  return file;
}

std::string page_folder() {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  for (const fs::path& folder :
       {fs::path(ARTICULA_VIEW_PAGE), program.parent_path() / "../share/articula/page"}) {
    if (fs::exists(folder / "index.html", error)) return folder.string();
  }
  return {};
}

SharedText contents_of(const std::filesystem::path& file) {
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  if (error || size > file_limit) return nullptr;
  std::ifstream stream(file, std::ios::binary);
  std::string text(static_cast<std::size_t>(size), '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!stream) return nullptr;
  return std::make_shared<const std::string>(std::move(text));
}

std::string_view media_type_of(const std::filesystem::path& file) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 14> types{{
      {".html", "text/html; charset=utf-8"},
      {".js", "text/javascript; charset=utf-8"},
      {".css", "text/css; charset=utf-8"},
      {".json", "application/json"},
      {".svg", "image/svg+xml"},
      {".png", "image/png"},
      {".jpg", "image/jpeg"},
      {".ico", "image/x-icon"},
      {".wasm", "application/wasm"},
      {".stl", "model/stl"},
      {".obj", "model/obj"},
      {".dae", "model/vnd.collada+xml"},
      {".gltf", "model/gltf+json"},
      {".glb", "model/gltf-binary"},
  }};
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  const auto found = std::find_if(types.begin(), types.end(),
                                  [&](const auto& type) { return type.first == extension; });
  return found == types.end() ? "application/octet-stream" : found->second;
}

std::optional<std::filesystem::path> mesh_file(const ViewOptions& options, std::string_view mesh) {
  const std::size_t slash = mesh.find('/');
  if (slash == std::string_view::npos) return std::nullopt;
  const auto folder = options.mesh_folders.find(std::string(mesh.substr(0, slash)));
  if (folder == options.mesh_folders.end()) return std::nullopt;
  return file_in(folder->second, mesh.substr(slash + 1));
}

}  // namespace articula::view

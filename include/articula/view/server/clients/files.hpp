// SPDX-License-Identifier: Apache-2.0
/// @file The files that a view serves: those of the page and of the declared mesh folders.
#pragma once

#include "articula/view/protocol/messages/frame.hpp"
#include "articula/view/view_options.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace articula::view {

/// The largest file that is served [bytes].
inline constexpr std::size_t file_limit = 64 << 20;

/// A regular file in a folder or its subfolders.
/// @param relative  parts separated by '/', as a client sent them
/// @return          nothing if there is no such file, or if it is outside of the folder, also by
///                  a symbolic link
[[nodiscard]] std::optional<std::filesystem::path> file_in(const std::filesystem::path& folder,
                                                           std::string_view relative);

/// The folder of the page: where the build made it, or beside the installed program. Empty if there
/// is none.
[[nodiscard]] std::string page_folder();

/// The contents of a file; null if it cannot be read or is larger than `file_limit`.
[[nodiscard]] SharedText contents_of(const std::filesystem::path& file);

/// The media type of a file by the end of its name.
[[nodiscard]] std::string_view media_type_of(const std::filesystem::path& file);

/// The file of a mesh in the declared folders.
/// @param mesh  `<package>/<path>`
[[nodiscard]] std::optional<std::filesystem::path> mesh_file(const ViewOptions& options,
                                                             std::string_view mesh);

}  // namespace articula::view

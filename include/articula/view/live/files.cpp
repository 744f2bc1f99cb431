// SPDX-License-Identifier: Apache-2.0
/// @file The files of a view in a page: there are none. In place of server/files.cpp.
#include "articula/view/server/clients/files.hpp"

namespace articula::view {

std::optional<std::filesystem::path> mesh_file(const ViewOptions&, std::string_view) {
  return std::nullopt;
}
SharedText contents_of(const std::filesystem::path&) { return nullptr; }

}  // namespace articula::view

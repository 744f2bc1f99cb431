// SPDX-License-Identifier: Apache-2.0
/// @file The version of articula. CMakeLists.txt reads it from here.
#pragma once

#include <string_view>

#define ARTICULA_VERSION_MAJOR 0
#define ARTICULA_VERSION_MINOR 1
#define ARTICULA_VERSION_PATCH 0

/// The version as one number that grows from release to release: 10000 major + 100 minor + patch.
///
///     #if ARTICULA_VERSION >= 200  // 0.2.0 and later
#define ARTICULA_VERSION \
  (10000 * ARTICULA_VERSION_MAJOR + 100 * ARTICULA_VERSION_MINOR + ARTICULA_VERSION_PATCH)

#define ARTICULA_DETAIL_TEXT(number) #number
#define ARTICULA_DETAIL_DOTTED(major, minor, patch) \
  ARTICULA_DETAIL_TEXT(major) "." ARTICULA_DETAIL_TEXT(minor) "." ARTICULA_DETAIL_TEXT(patch)

namespace articula {

/// The version as text, "major.minor.patch" [Semantic Versioning 2.0.0].
inline constexpr std::string_view library_version =
    ARTICULA_DETAIL_DOTTED(ARTICULA_VERSION_MAJOR, ARTICULA_VERSION_MINOR, ARTICULA_VERSION_PATCH);

}  // namespace articula

#undef ARTICULA_DETAIL_DOTTED
#undef ARTICULA_DETAIL_TEXT

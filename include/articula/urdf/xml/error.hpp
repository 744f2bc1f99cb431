// SPDX-License-Identifier: Apache-2.0
/// @file The error of URDF files.
#pragma once

#include "articula/text/file_error.hpp"

namespace articula {

using UrdfError = FileError;

}  // namespace articula

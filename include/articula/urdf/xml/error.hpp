// SPDX-License-Identifier: Apache-2.0
/// @file What is thrown where a robot cannot be read from URDF.
#pragma once

#include <stdexcept>
#include <string>

namespace articula {

/// A URDF that is broken, not physical or not of the size that was asked for. `what()` is one line
/// with file, element (link or joint), reason and figures, such as `arm.urdf: link 'elbow': the
/// mass is negative (-0.3 kg)`.
class UrdfError : public std::runtime_error {
 public:
  /// @param file    where the text comes from
  /// @param reason  what is wrong, beginning with the element
  UrdfError(const std::string& file, const std::string& reason)
      : std::runtime_error(file + ": " + reason) {}
  /// The same with something added to it.
  UrdfError(const UrdfError& error, const std::string& addition)
      : std::runtime_error(error.what() + addition) {}
};

}  // namespace articula

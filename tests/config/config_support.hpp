// SPDX-License-Identifier: Apache-2.0
/// @file What the tests of configuration files share.
#pragma once

#include <articula/config/yaml/source.hpp>

#include <string>

namespace support {

/// One of the files in tests/config/files.
inline articula::ConfigSource config_file(const std::string& name) { return CONFIG_FILES + name; }

/// One of the files in examples.
inline articula::ConfigSource example_file(const std::string& name) { return EXAMPLE_FILES + name; }

/// A text that messages call "test".
inline articula::ConfigSource yaml(const std::string& text) {
  return articula::ConfigSource::text(text, "test");
}

}  // namespace support

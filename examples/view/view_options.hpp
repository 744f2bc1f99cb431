// SPDX-License-Identifier: Apache-2.0
/// @file What the examples of the view have in common.
#pragma once

#include <articula/view/show.hpp>

#include <cstdint>
#include <cstdlib>

/// Opens the browser and runs until Ctrl-C, or for ARTICULA_VIEW_SECONDS, at the default port or at
/// ARTICULA_VIEW_PORT.
/// @param period  of the loop [s]
inline articula::ShowOptions view_options(double period) {
  articula::ShowOptions options{.opens_browser = true};
  if (const char* seconds = std::getenv("ARTICULA_VIEW_SECONDS")) {
    options.run.cycles = static_cast<std::uint64_t>(std::atof(seconds) / period);
  }
  if (const char* port = std::getenv("ARTICULA_VIEW_PORT")) {
    options.view.port = static_cast<std::uint16_t>(std::atoi(port));
  }
  return options;
}

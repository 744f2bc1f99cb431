// SPDX-License-Identifier: Apache-2.0
/// @file Opens an address in the browser of this machine. Target articula::view.
#pragma once

#include <string>

namespace articula {

/// Opens an address by `xdg-open`, if there is a screen (DISPLAY or WAYLAND_DISPLAY is set). Does
/// not wait for the browser. The address becomes an argument of a program, and so other users of
/// this machine may read it, with a token if it has one.
/// @return whether `xdg-open` was started
bool open_in_browser(const std::string& url);

}  // namespace articula

// SPDX-License-Identifier: Apache-2.0
/// @file The options of a view: content, audience, address.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace articula {

/// The address, rights and limits of a View. The defaults show the loop to programs of this machine
/// and let nobody operate it.
struct ViewOptions {
  std::string address = "127.0.0.1";  ///< IPv4 or IPv6 of the interface to listen on
  std::uint16_t port = 8765;          ///< TCP port; 0: any free one

  /// Whether clients may take the controls, or only watch. By default they watch a View, and
  /// operate what `show` shows.
  std::optional<bool> operates{};

  /// What clients must know: they append `?token=<token>` to the address. An address that is not
  /// loopback needs one of at least 16 letters, digits, '-', '.', '_' or '~'.
  std::string token{};

  /// Origins of other pages that may connect, as "https://app.foxglove.dev". The view's own page
  /// and programs that are no browser always may.
  std::vector<std::string> origins{};

  /// Folder of the page's files. Default: the page that the build made, if it made one.
  std::string page_folder{};
  /// Folders that the meshes of `package://<package>/<path>` are served from, by the package's
  /// name. Every file in them can be read by every client.
  std::map<std::string, std::string> mesh_folders{};

  std::size_t client_limit = 32;           ///< WebSocket clients at a time
  std::size_t message_limit = 4 << 20;     ///< of a client's message [bytes]
  std::size_t messages_per_second = 2000;  ///< of a client; the view reads no faster
  std::size_t queue_limit = 8 << 20;       ///< of what waits to be sent to a client [bytes]
  double patience = 10;                    ///< a client that takes nothing is dropped then [s]
  std::function<void(const std::string&)> warn{};  ///< of refused connections; default: to stderr
};

}  // namespace articula

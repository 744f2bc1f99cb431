// SPDX-License-Identifier: Apache-2.0
/// @file The rules on who may connect to a view. Pure: headers in, refusals out.
#pragma once

#include "articula/view/view_options.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace articula::view {

/// The target of an HTTP request in its parts.
struct Target {
  std::string path{};   ///< decoded, begins with '/'
  std::string token{};  ///< of the query `token=`; empty if there is none
};

/// The parts of a target; nothing if it is malformed.
[[nodiscard]] std::optional<Target> parse_target(std::string_view target);

/// The rules by which a view lets clients connect.
class Access {
 public:
  /// @throws std::invalid_argument if the address is not loopback and there is no good token, or an
  ///         origin is none
  Access(const ViewOptions& options, bool is_loopback);

  /// Refuses a host name that is not this machine's. A foreign page uses such a name after it has
  /// bound the name to this machine's address (DNS rebinding).
  /// @param host  the Host header
  /// @return      empty, or why the request is refused
  [[nodiscard]] std::string host_fault(std::string_view host) const;

  /// Refuses pages of other origins. Programs that are no browser send no origin.
  [[nodiscard]] std::string origin_fault(std::optional<std::string_view> origin,
                                         std::string_view host) const;

  /// Refuses clients without the token, if there is one. Takes a time that does not depend on
  /// where the two differ.
  [[nodiscard]] std::string token_fault(std::string_view token) const;

 private:
  bool is_loopback_;
  std::string address_;
  std::string token_;
  std::vector<std::string> origins_;
};

}  // namespace articula::view

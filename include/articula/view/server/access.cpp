// SPDX-License-Identifier: Apache-2.0
#include "articula/view/server/access.hpp"

#include "articula/core/refuse.hpp"
#include "articula/text/characters.hpp"

#include <algorithm>
#include <cstddef>

namespace articula::view {

namespace {

constexpr std::size_t shortest_token = 16;

int hexadecimal(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

/// Replaces %XX by the byte; nothing if a % is followed by something else.
std::optional<std::string> decode(std::string_view text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      decoded += text[i];
      continue;
    }
    if (i + 2 >= text.size()) return std::nullopt;
    const int high = hexadecimal(text[i + 1]), low = hexadecimal(text[i + 2]);
    if (high < 0 || low < 0) return std::nullopt;
    decoded += static_cast<char>(16 * high + low);
    i += 2;
  }
  return decoded;
}

/// Letters, digits and what needs no escape in an address.
bool is_unreserved(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
         c == '.' || c == '_' || c == '~';
}

/// "localhost:8765" without the port.
std::string_view without_port(std::string_view host) {
  const std::size_t bracket = host.rfind(']'), colon = host.rfind(':');
  if (colon == std::string_view::npos) return host;
  if (bracket != std::string_view::npos && bracket > colon) return host;
  return host.substr(0, colon);
}

}  // namespace

std::optional<Target> parse_target(std::string_view target) {
  if (target.empty() || target.front() != '/') return std::nullopt;
  const std::size_t question = target.find('?');
  auto path = decode(target.substr(0, question));
  if (!path) return std::nullopt;
  Target parts{std::move(*path), {}};
  std::string_view query =
      question == std::string_view::npos ? std::string_view() : target.substr(question + 1);
  constexpr std::string_view name = "token=";
  while (!query.empty()) {
    const std::string_view pair = query.substr(0, query.find('&'));
    if (pair.substr(0, name.size()) == name) parts.token = pair.substr(name.size());
    query.remove_prefix(std::min(query.size(), pair.size() + 1));
  }
  return parts;
}

Access::Access(const ViewOptions& options, bool is_loopback)
    : is_loopback_(is_loopback),
      address_(options.address),
      token_(options.token),
      origins_(options.origins) {
  if (!std::all_of(token_.begin(), token_.end(), is_unreserved)) {
    detail::refuse(
        {"view: the token has a character that an address cannot have; use letters, "
         "digits, '-', '.', '_' and '~'"});
  }
  if (!is_loopback && token_.size() < shortest_token) {
    detail::refuse({"view: other machines reach the address ", address_,
                    ", so a token of at least ", shortest_token,
                    " characters is needed; set ViewOptions::token, for example to the output of "
                    "`openssl rand -hex 16`"});
  }
  for (const std::string& origin : origins_) {
    const std::size_t scheme = origin.find("://");
    if (scheme == std::string::npos || origin.find('/', scheme + 3) != std::string::npos) {
      detail::refuse({"view: '", origin, "' is not an origin; expected one as ",
                      "\"https://app.foxglove.dev\", without a path"});
    }
  }
}

std::string Access::host_fault(std::string_view host) const {
  if (!is_loopback_) return {};  // The token protects, and the names of this machine are not known.
  const std::string_view name = without_port(host);
  if (name == "127.0.0.1" || name == "localhost" || name == "[::1]" || name == address_) return {};
  return "the host '" + detail::shown(name) + "' is not a name of this server; use " + address_;
}

std::string Access::origin_fault(std::optional<std::string_view> origin,
                                 std::string_view host) const {
  if (!origin) return {};
  const std::string own(host);
  if (*origin == "http://" + own || *origin == "https://" + own) return {};
  if (std::find(origins_.begin(), origins_.end(), *origin) != origins_.end()) return {};
  return "pages of the origin '" + detail::shown(*origin) +
         "' may not connect; add it to ViewOptions::origins if they shall";
}

std::string Access::token_fault(std::string_view token) const {
  if (token_.empty()) return {};
  std::size_t difference = token.size() ^ token_.size();
  for (std::size_t i = 0; i < token_.size(); ++i) {
    const char c = i < token.size() ? token[i] : '\0';
    difference |= static_cast<std::size_t>(static_cast<unsigned char>(c ^ token_[i]));
  }
  return difference == 0 ? "" : "a token is needed: append ?token=<token> to the address";
}

}  // namespace articula::view

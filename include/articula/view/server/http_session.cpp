// SPDX-License-Identifier: Apache-2.0
#include "articula/view/server/http_session.hpp"

#include "articula/view/server/clients/files.hpp"
#include "articula/view/server/websocket_session.hpp"

#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>

#include <chrono>
#include <filesystem>
#include <utility>

namespace articula::view {

namespace {

namespace beast = boost::beast;
namespace http = beast::http;

constexpr auto time_limit = std::chrono::seconds(10);  // for all requests, and for a response
constexpr std::size_t header_limit = 8192;             // bytes

std::optional<std::string_view> field(const HttpSession::Request& request, http::field name) {
  const auto found = request.find(name);
  if (found == request.end()) return std::nullopt;
  return std::string_view(found->value());
}

/// A response with the headers that keep other pages from framing or reading this one.
HttpSession::Response response(const HttpSession::Request& request, http::status status,
                               std::string_view type, std::string body) {
  HttpSession::Response response{status, request.version()};
  response.set(http::field::server, "articula");
  response.set(http::field::content_type, type);
  response.set(http::field::cache_control, "no-cache");
  response.set("X-Content-Type-Options", "nosniff");
  response.set("Referrer-Policy", "no-referrer");  // the address may have a token
  response.set("Cross-Origin-Resource-Policy", "same-origin");
  response.set("Content-Security-Policy",
               "default-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; "
               "connect-src 'self' ws: wss: data: blob:; worker-src 'self' blob:; "
               "frame-ancestors 'none'; base-uri 'none'; form-action 'none'");
  // Who asks for what there is not must connect again, and so queue behind all others.
  response.keep_alive(request.keep_alive() && status == http::status::ok);
  const auto size = body.size();
  if (request.method() != http::verb::head) response.body() = std::move(body);
  response.content_length(size);
  return response;
}

HttpSession::Response plain(const HttpSession::Request& request, http::status status,
                            const std::string& text) {
  return response(request, status, "text/plain; charset=utf-8", text + "\n");
}

std::string text_without_page(const remote::Port& port) {
  return "articula: " + port.robot().name +
         "\n\nThis program was built without the page of the view. Install Node.js and npm "
         "(Debian: nodejs, npm)\nand build again. Foxglove, Lichtblick and PlotJuggler connect to "
         "this address without the page,\nby \"Foxglove WebSocket\".";
}

}  // namespace

HttpSession::HttpSession(boost::asio::ip::tcp::socket&& socket, Context& context)
    : context_(context),
      stream_(std::move(socket)),
      buffer_(header_limit),
      end_(std::chrono::steady_clock::now() + time_limit) {
  context_.http_sessions.push_back(this);
}

HttpSession::~HttpSession() { context_.http_sessions.remove(this); }

void HttpSession::close() {
  context_.http_sessions.remove(this);
  stream_.close();  // ends what waits, and so this
}

void HttpSession::read() {
  parser_.emplace();
  parser_->header_limit(header_limit);
  parser_->body_limit(0);
  stream_.expires_at(end_);
  http::async_read(stream_, buffer_, *parser_,
                   [self = shared_from_this()](Error error, std::size_t) { self->got(error); });
}

void HttpSession::got(Error error) {
  if (error) return;  // The connection closes, as this ends.
  Request request = parser_->release();
  const auto target = parse_target(request.target());
  if (!target) return send(plain(request, http::status::bad_request, "The target is malformed."));
  if (auto refused = refusal(request, *target)) {
    context_.warn("refused: " + refused->body());
    return send(std::move(*refused));
  }
  if (beast::websocket::is_upgrade(request)) return upgrade(std::move(request));
  send(answer(request, *target));
}

std::optional<HttpSession::Response> HttpSession::refusal(const Request& request,
                                                          const Target& target) const {
  const std::string_view host = field(request, http::field::host).value_or("");
  if (const auto fault = context_.access.host_fault(host); !fault.empty()) {
    return plain(request, http::status::misdirected_request, fault);
  }
  const bool is_upgrade = beast::websocket::is_upgrade(request);
  // The code of the page is no secret, and its files do not carry the token.
  const bool is_page_file =
      !is_upgrade && target.path != "/" && !target.path.starts_with("/meshes/");
  if (!is_page_file) {
    if (const auto fault = context_.access.token_fault(target.token); !fault.empty()) {
      return plain(request, http::status::unauthorized, fault);
    }
  }
  if (!is_upgrade) return std::nullopt;
  if (const auto fault = context_.access.origin_fault(field(request, http::field::origin), host);
      !fault.empty()) {
    return plain(request, http::status::forbidden, fault);
  }
  if (choose_subprotocol(request[http::field::sec_websocket_protocol]).empty()) {
    return plain(request, http::status::bad_request,
                 "no common subprotocol; offer foxglove.websocket.v1 or foxglove.sdk.v1");
  }
  if (context_.sessions.size() >= context_.options.client_limit) {
    return plain(request, http::status::service_unavailable,
                 "there are already " + std::to_string(context_.options.client_limit) +
                     " clients; close one or raise ViewOptions::client_limit");
  }
  return std::nullopt;
}

HttpSession::Response HttpSession::answer(const Request& request, const Target& target) const {
  if (request.method() != http::verb::get && request.method() != http::verb::head) {
    return plain(request, http::status::method_not_allowed, "Only GET and HEAD are understood.");
  }
  const ViewOptions& options = context_.options;
  constexpr std::string_view meshes = "/meshes/";
  const std::string_view path = target.path;
  const bool is_mesh = path.starts_with(meshes);
  if (path == "/" && options.page_folder.empty()) {
    return plain(request, http::status::ok, text_without_page(context_.port));
  }
  const std::string page_file(path == "/" ? "index.html" : path.substr(1));
  const auto file = is_mesh ? mesh_file(options, path.substr(meshes.size()))
                            : file_in(options.page_folder, page_file);
  // The build keeps a compressed copy beside each file of the page. It is found as the file is, so
  // that no link leads out of the folder.
  const bool takes_packed =
      file && !is_mesh && http::token_list(request[http::field::accept_encoding]).exists("gzip");
  const auto packed_file =
      takes_packed ? file_in(options.page_folder, page_file + ".gz") : std::nullopt;
  const SharedText packed = packed_file ? contents_of(*packed_file) : nullptr;
  const SharedText contents = packed ? packed : file ? contents_of(*file) : nullptr;
  if (!contents) return plain(request, http::status::not_found, "There is no such file.");
  Response found = response(request, http::status::ok, media_type_of(*file), *contents);
  if (packed) found.set(http::field::content_encoding, "gzip");
  found.set(http::field::vary, "Accept-Encoding");
  return found;
}

void HttpSession::upgrade(Request request) {
  // What others read of who has the controls.
  const bool is_browser = request[http::field::user_agent].starts_with("Mozilla/");
  std::string name = is_browser ? "browser " : "program ";
  name += std::to_string(++context_.names);
  Error error;
  const auto peer = stream_.socket().remote_endpoint(error).address();
  if (!error && !peer.is_loopback()) name += " at " + peer.to_string();
  const auto session =
      std::make_shared<WebSocketSession>(std::move(stream_), context_, std::move(name));
  session->start(std::move(request));
}

void HttpSession::send(Response message) {
  const auto kept = std::make_shared<Response>(std::move(message));
  if (std::chrono::steady_clock::now() >= end_) kept->keep_alive(false);
  stream_.expires_after(time_limit);
  http::async_write(stream_, *kept, [self = shared_from_this(), kept](Error error, std::size_t) {
    if (!error && kept->keep_alive()) return self->read();
    Error ignored;
    self->stream_.socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send, ignored);
  });
}

}  // namespace articula::view

// SPDX-License-Identifier: Apache-2.0
#include "articula/view/view.hpp"

#include "articula/core/refuse.hpp"
#include "articula/view/server/clients/files.hpp"
#include "articula/view/server/http_session.hpp"
#include "articula/view/server/websocket_session.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>

#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <csignal>
#include <exception>
#include <system_error>
#include <thread>
#include <utility>

namespace articula {

namespace {

namespace asio = boost::asio;
using tcp = asio::ip::tcp;
using Error = boost::system::error_code;
using Clock = std::chrono::steady_clock;

constexpr auto tick_period = std::chrono::microseconds(16'667);  // screens draw at 60 Hz
constexpr auto good_bye_time = std::chrono::milliseconds(250);
constexpr int send_buffer = 256 << 10;  // bytes; more would be old data when they arrive

asio::ip::address address_of(const ViewOptions& options) {
  Error error;
  const auto address = asio::ip::make_address(options.address, error);
  if (error) {
    detail::refuse({"view: '", options.address, "' is not an address; expected one as ",
                    "\"127.0.0.1\" or \"::1\""});
  }
  return address;
}

ViewOptions checked(ViewOptions options) {
  const auto check = [](bool good, const char* member, const char* expected) {
    if (!good) detail::refuse({"view: ViewOptions::", member, " is not ", expected});
  };
  check(options.client_limit > 0, "client_limit", "positive");
  check(options.message_limit >= 1024, "message_limit", "at least 1024");
  check(options.messages_per_second > 0, "messages_per_second", "positive");
  check(options.queue_limit >= 1024, "queue_limit", "at least 1024");
  check(options.patience > 0 && options.patience < 1e6, "patience", "between 0 and 1e6 s");
  const std::filesystem::path page = options.page_folder;
  if (!page.empty() && !std::filesystem::exists(page / "index.html")) {
    detail::refuse({"view: ViewOptions::page_folder, ", options.page_folder,
                    ", has no index.html; leave it empty for the page of the build"});
  }
  if (options.page_folder.empty()) options.page_folder = view::page_folder();
  for (const auto& [package, folder] : options.mesh_folders) {
    if (!std::filesystem::is_directory(folder)) {
      detail::refuse({"view: the mesh folder of '", package, "', ", folder, ", does not exist"});
    }
  }
  return options;
}

/// The threads of a program inherit the priority and signals of the one that starts them. This one
/// leaves both to the others: it must not delay the loop, nor take its Ctrl-C.
void become_ordinary() {
  sched_param none{};
  (void)pthread_setschedparam(pthread_self(), SCHED_OTHER, &none);
}

}  // namespace

/// The thread of a view and what it runs.
class View::Server {
 public:
  Server(remote::Port& port, const ViewOptions& options)
      : address_(address_of(options)),
        context_(port, checked(options), address_.is_loopback()),
        acceptor_(io_),
        tick_(io_),
        retry_(io_),
        good_bye_(io_) {
    listen(options.port);
    port_ = acceptor_.local_endpoint().port();
    url_ = "http://" +
           (address_.is_v6() ? "[" + address_.to_string() + "]" : address_.to_string()) + ":" +
           std::to_string(port_) + "/";
    if (!options.token.empty()) url_ += "?token=" + options.token;
    accept();
    wait_for_tick();
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    thread_ = std::thread([this] { run(); });
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
  }

  ~Server() {
    asio::post(io_, [this] { end(); });
    thread_.join();
  }

  [[nodiscard]] const std::string& url() const noexcept { return url_; }
  [[nodiscard]] std::uint16_t port() const noexcept { return port_; }
  [[nodiscard]] std::size_t clients() const noexcept { return context_.clients; }

 private:
  void listen(std::uint16_t port) {
    const tcp::endpoint endpoint(address_, port);
    Error error;
    acceptor_.open(endpoint.protocol(), error);
    if (!error) acceptor_.set_option(tcp::acceptor::reuse_address(true), error);
    if (!error) acceptor_.bind(endpoint, error);
    if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
    if (error) {
      throw std::system_error(std::error_code(error.value(), std::system_category()),
                              "view: cannot listen on " + address_.to_string() + ", port " +
                                  std::to_string(port) +
                                  "; end the program that uses it, or choose another port, by "
                                  "ViewOptions::port or articula's --port (0: any)");
    }
  }

  void accept() {
    acceptor_.async_accept([this](Error error, tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      if (error) {  // as when the process has too many open files
        retry_.expires_after(std::chrono::milliseconds(100));
        retry_.async_wait([this](Error ended) {
          if (!ended) accept();
        });
        return;
      }
      // The oldest makes room: whoever holds all connections must not keep the others out.
      if (context_.http_sessions.size() >= view::Context::http_limit) {
        context_.http_sessions.front()->close();
      }
      Error ignored;
      socket.set_option(tcp::no_delay(true), ignored);
      socket.set_option(tcp::socket::send_buffer_size(send_buffer), ignored);
      std::make_shared<view::HttpSession>(std::move(socket), context_)->read();
      accept();
    });
  }

  void wait_for_tick() {
    // A late tick delays none of those after it. At least half a period is between two.
    tick_.expires_at(std::max(tick_.expiry() + tick_period, Clock::now() + tick_period / 2));
    tick_.async_wait([this](Error error) {
      if (error) return;
      tick();
      wait_for_tick();
    });
  }

  void tick() {
    const auto wall = std::chrono::system_clock::now().time_since_epoch();
    const auto nanoseconds = std::chrono::duration_cast<std::chrono::nanoseconds>(wall).count();
    const auto now = Clock::now();
    context_.broadcast.tick(now, static_cast<view::WallTime>(nanoseconds));
    for (view::WebSocketSession* session : context_.sessions) session->tick(now);
  }

  void run() {
    become_ordinary();
    while (true) {
      try {
        io_.run();
        return;
      } catch (const std::exception& error) {
        context_.warn(error.what());
        if (tick_.expiry() < Clock::now()) wait_for_tick();
      }
    }
  }

  void end() {
    acceptor_.close();
    tick_.cancel();
    retry_.cancel();
    for (view::WebSocketSession* session : context_.sessions) session->close();
    wait_for_good_byes(Clock::now() + good_bye_time);
  }

  /// Ends the thread when all clients are gone, or do not answer.
  void wait_for_good_byes(Clock::time_point end) {
    if (context_.sessions.empty() || Clock::now() > end) return io_.stop();
    good_bye_.expires_after(std::chrono::milliseconds(2));
    good_bye_.async_wait([this, end](Error) { wait_for_good_byes(end); });
  }

  asio::ip::address address_;
  view::Context context_;
  asio::io_context io_{1};  // after what its handlers refer to
  tcp::acceptor acceptor_;
  asio::steady_timer tick_;
  asio::steady_timer retry_;
  asio::steady_timer good_bye_;
  std::uint16_t port_ = 0;
  std::string url_{};
  std::thread thread_{};
};

View::View(remote::Port& port, const ViewOptions& options)
    : server_(std::make_unique<Server>(port, options)) {}
View::~View() = default;
const std::string& View::url() const noexcept { return server_->url(); }
std::uint16_t View::port() const noexcept { return server_->port(); }
std::size_t View::clients() const noexcept { return server_->clients(); }

}  // namespace articula

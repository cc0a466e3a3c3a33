#include "view/view_server.h"

#include <fmt/format.h>
#include <httplib.h>

#include <algorithm>
#include <mutex>
#include <optional>
#include <set>
#include <thread>

#include "core/error.h"
#include "view/served_folder.h"

namespace tera {
namespace {

constexpr char kLoopback[] = "127.0.0.1";
/// A browser opens up to six connections, and a connection occupies a thread.
constexpr std::size_t kThreads = 24;
constexpr std::size_t kMostRequests = 1'000'000;  ///< requests per connection
constexpr std::size_t kPiece = 1 << 20;           ///< bytes per read

/// Content security policy: the page may run its own script and worker, and access only this
/// server.
constexpr char kPolicy[] =
    "default-src 'none'; script-src 'unsafe-inline' blob:; worker-src blob:; style-src "
    "'unsafe-inline'; img-src data: blob:; connect-src 'self' blob: data:; base-uri 'none'; "
    "form-action 'none'; frame-ancestors 'none'";

std::string MediaTypeOf(const std::filesystem::path& file) {
  const std::string ending = file.extension().string();
  if (ending == ".png") return "image/png";
  if (ending == ".json") return "application/json";
  if (ending == ".csv" || ending == ".yaml") return "text/plain; charset=utf-8";
  return "application/octet-stream";
}

/// Limits a requested range to the end of the file (RFC 9110, 14.1.2), because the library does
/// not. Returns false for an empty range and for several ranges. The cast is safe, because the
/// library owns the request as non-const.
bool FitRange(std::uint64_t bytes, const httplib::Request& request) {
  auto& ranges = const_cast<httplib::Request&>(request).ranges;
  if (ranges.empty()) return true;
  auto& [first, last] = ranges.front();
  const auto size = static_cast<ssize_t>(bytes);
  if (first < 0) {
    first = std::max<ssize_t>(size - last, 0);
    last = size - 1;
  }
  if (last < 0 || last >= size) last = size - 1;
  const bool fits = ranges.size() == 1 && first < size;
  if (!fits) ranges.clear();
  return fits;
}

/// Prevents other sockets from sharing the port, which the library allows by default.
void TakePortAlone(int listener) {
  const int yes = 1;
  setsockopt(listener, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
}

/// Sends a file, or the requested range of it, in pieces.
void SendFile(const std::filesystem::path& file, const httplib::Request& request,
              httplib::Response* answer) {
  const std::uint64_t bytes = std::filesystem::file_size(file);
  if (!FitRange(bytes, request)) {
    answer->status = 416;
    answer->set_header("Content-Range", fmt::format("bytes */{}", bytes));
    return;
  }
  if (bytes == 0) {
    answer->set_content("", MediaTypeOf(file));
    return;
  }
  answer->set_content_provider(
      bytes, MediaTypeOf(file),
      [file](std::size_t begin, std::size_t length, httplib::DataSink& sink) {
        const std::string piece = ReadPart(file, begin, std::min(length, kPiece));
        return !piece.empty() && sink.write(piece.data(), piece.size());
      });
}

/// Sends `text` uncompressed, because compression takes longer than a local transfer. The text must
/// outlive the response.
void SendText(const std::string& text, const char* type, httplib::Response* answer) {
  answer->set_content_provider(
      text.size(), type, [&text](std::size_t begin, std::size_t length, httplib::DataSink& sink) {
        return sink.write(text.data() + begin, length);
      });
}

void Refuse(int status, const std::string& why, httplib::Response* answer) {
  answer->status = status;
  answer->set_content(why, "text/plain; charset=utf-8");
}

}  // namespace

class ViewServer::Running {
 public:
  Running(std::vector<Viewed> viewed, std::string page, int port)
      : viewed_(std::move(viewed)), page_(std::move(page)), stages_(viewed_.size()) {
    index_ = IndexJson(viewed_);
    server_.new_task_queue = [] { return new httplib::ThreadPool(kThreads); };
    server_.set_keep_alive_max_count(kMostRequests);
    server_.set_tcp_nodelay(true);
    server_.set_socket_options(TakePortAlone);
    server_.set_payload_max_length(0);
    server_.set_default_headers({{"X-Content-Type-Options", "nosniff"},
                                 {"Referrer-Policy", "no-referrer"},
                                 {"Cross-Origin-Resource-Policy", "same-origin"},
                                 {"Cache-Control", "no-cache"},
                                 {"Content-Security-Policy", kPolicy}});
    server_.set_pre_routing_handler([this](const auto& request, auto& answer) {
      return IsWelcome(request, &answer) ? httplib::Server::HandlerResponse::Unhandled
                                         : httplib::Server::HandlerResponse::Handled;
    });
    server_.Get("/", [this](const auto&, auto& answer) {
      SendText(page_, "text/html; charset=utf-8", &answer);
    });
    server_.Get("/index.json", [this](const auto&, auto& answer) {
      SendText(index_, "application/json", &answer);
    });
    server_.Get(R"(/stage/(\d{1,4}))", [this](const auto& request, auto& answer) {
      SendStage(std::stoul(request.matches[1]), &answer);
    });
    server_.Get(R"(/data/(\d{1,4})/(.+))", [this](const auto& request, auto& answer) {
      const std::size_t k = std::stoul(request.matches[1]);
      const auto file =
          k < viewed_.size() ? viewed_[k].folder.Find(request.matches[2].str()) : std::nullopt;
      if (file)
        SendFile(*file, request, &answer);
      else
        Refuse(404, "no such file", &answer);
    });
    Bind(port);
    thread_ = std::thread([this] { server_.listen_after_bind(); });
    while (!server_.is_running()) std::this_thread::yield();
  }

  ~Running() {
    server_.stop();
    thread_.join();
  }

  int port() const { return port_; }

 private:
  void Bind(int port) {
    if (port == 0) {
      port_ = server_.bind_to_any_port(kLoopback);
    } else if (server_.bind_to_port(kLoopback, port)) {
      port_ = port;
    }
    if (port_ <= 0) {
      throw InputError(
          "--port " + port,
          {FaultKind::kUnwritable,
           fmt::format("cannot be bound on {}; another program may have it, give another or none",
                       kLoopback)});
    }
    hosts_ = {fmt::format("{}:{}", kLoopback, port_), fmt::format("localhost:{}", port_)};
    constexpr int kUsualPort = 80;  // browsers omit this port in the host name
    if (port_ == kUsualPort) hosts_.insert({kLoopback, "localhost"});
  }

  /// Accepts only read requests for the host name of this computer. A foreign web page whose DNS
  /// name resolves to this computer sends its own host name, and is rejected.
  bool IsWelcome(const httplib::Request& request, httplib::Response* answer) const {
    if (request.method != "GET" && request.method != "HEAD") {
      Refuse(405, "this server is only read from", answer);
      answer->set_header("Allow", "GET, HEAD");
      return false;
    }
    if (!hosts_.contains(request.get_header_value("Host"))) {
      Refuse(403, "this server is for this computer alone", answer);
      return false;
    }
    return true;
  }

  void SendStage(std::size_t k, httplib::Response* answer) {
    if (k >= viewed_.size() || !viewed_[k].stage) {
      Refuse(404, "the scene of this dataset is not known", answer);
      return;
    }
    const std::lock_guard lock(making_);
    try {
      if (!stages_[k]) stages_[k] = viewed_[k].stage();
      SendText(*stages_[k], "application/octet-stream", answer);
    } catch (const InputError& e) {
      Refuse(404, e.what(), answer);
    }
  }

  std::vector<Viewed> viewed_;
  std::string page_, index_;
  std::mutex making_;  ///< guards stages_
  std::vector<std::optional<std::string>> stages_;
  std::set<std::string> hosts_;
  int port_ = -1;
  httplib::Server server_;
  std::thread thread_;
};

ViewServer::ViewServer(std::vector<Viewed> viewed, std::string page, int port)
    : running_(std::make_unique<Running>(std::move(viewed), std::move(page), port)) {}

ViewServer::~ViewServer() = default;

int ViewServer::port() const { return running_->port(); }

std::string ViewServer::address() const { return fmt::format("http://{}:{}/", kLoopback, port()); }

}  // namespace tera

#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>

namespace tera {

class Stage;

struct ServerOptions {
  std::string address = "127.0.0.1";  ///< address of the listening interface
  int port = 0;                       ///< 0: the system chooses
  std::string name = "tera";          ///< server name with version
  /// Time limit for a client's first message.
  std::chrono::milliseconds hello_within = std::chrono::seconds(10);
};

/// Network server through which clients step a simulation, a single client at a time. The messages
/// are in proto/tera/v1/simulation.proto.
///
/// Model   a separate thread serves the sessions in sequence. Each session has its own stage, which
///         is destroyed before the client's end-of-session notice. A second concurrent client is
///         refused at once. A client's death ends its session, even within a step.
class Server {
 public:
  /// Creates the stage of a session. `ended` returns true when the session is over, so that a long
  /// step may stop.
  using MakeStage = std::function<std::unique_ptr<Stage>(std::function<bool()> ended)>;
  /// Receives one line of text per session start and end.
  using Log = std::function<void(const std::string&)>;

  /// Starts to listen. Throws InputError on failure.
  Server(const ServerOptions& options, MakeStage make_stage, Log log);
  /// Ends a current session and waits for its end.
  ~Server();

  /// "127.0.0.1:50051", the address for clients.
  const std::string& address() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tera

#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>

namespace tera {

class Stage;

struct ServerOptions {
  std::string address = "127.0.0.1";  ///< address of the network interface to listen on
  int port = 0;                       ///< 0: the system selects a free port
  std::string name = "tera";          ///< name and version of the server
  /// Time limit for the first message of a client.
  std::chrono::milliseconds hello_within = std::chrono::seconds(10);
};

/// Network server with which a client steps a simulation. It serves one client at a time. Messages
/// are defined in proto/tera/v1/simulation.proto.
///
/// Model   One thread serves the sessions one after another. A session has its own stage, which is
///         destroyed before the client is told that the session has ended. While a client is
///         served, others are refused at once. The death of a client ends its session, even during
///         a step.
class Server {
 public:
  /// Creates the stage of a session. `ended` returns true once the session is over, so that a long
  /// step can stop.
  using MakeStage = std::function<std::unique_ptr<Stage>(std::function<bool()> ended)>;
  /// Receives one line of text at the start and the end of each session.
  using Log = std::function<void(const std::string&)>;

  /// Starts to listen. Throws InputError on failure.
  Server(const ServerOptions& options, MakeStage make_stage, Log log);
  /// Ends the current session and waits for its end.
  ~Server();

  /// Address for clients, such as "127.0.0.1:50051".
  const std::string& address() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tera

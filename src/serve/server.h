#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>

namespace tera {

class Stage;

struct ServerOptions {
  std::string address = "127.0.0.1";  ///< of the interface to listen on
  int port = 0;                       ///< 0: the system chooses
  std::string name = "tera";          ///< of the server, with its version
  /// A client that says nothing for so long loses its place.
  std::chrono::milliseconds hello_within = std::chrono::seconds(10);
};

/// Lets clients step a simulation over the network, one at a time, by the messages of
/// proto/tera/v1/simulation.proto.
///
/// Model   one thread of its own serves one session after the other: each gets a stage of its own,
///         which is gone before the session's end is told to its client. A client that comes
///         meanwhile is refused at once. A client that dies ends its session, in the middle of a
///         step too.
class Server {
 public:
  /// Makes the stage of a session; `ended` says, from then on, that the session is over and a long
  /// step may be left.
  using MakeStage = std::function<std::unique_ptr<Stage>(std::function<bool()> ended)>;
  /// Told of each session that began or ended, as one line of text.
  using Log = std::function<void(const std::string&)>;

  /// Listens. Throws InputError where it cannot.
  Server(const ServerOptions& options, MakeStage make_stage, Log log);
  /// Ends a session under way and waits until it is over.
  ~Server();

  /// "127.0.0.1:50051", as a client needs it.
  const std::string& address() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tera

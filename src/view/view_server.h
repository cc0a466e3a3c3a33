#pragma once

#include <memory>
#include <string>
#include <vector>

#include "view/viewed.h"

namespace tera {

/// Sends a page and what it asks for to browsers of this computer, while it lives.
///
/// Model   HTTP/1.1 on 127.0.0.1 alone, which answers requests for that host only; GET and HEAD:
/// `/` the page,
///         `/index.json`, `/stage/K` the scene of the K-th that is viewed, `/data/K/FILE` a file of
///         its folder (ServedFolder), whole or a range of it. All else is 404, 405 or 403. It
///         writes nothing.
class ViewServer {
 public:
  /// Of port 0 a free one is taken. Throws InputError where the port is taken.
  ViewServer(std::vector<Viewed> viewed, std::string page, int port);
  ViewServer(const ViewServer&) = delete;
  ViewServer& operator=(const ViewServer&) = delete;
  ~ViewServer();

  int port() const;
  std::string address() const;

 private:
  class Running;
  std::unique_ptr<Running> running_;
};

}  // namespace tera

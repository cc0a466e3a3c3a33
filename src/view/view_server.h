#pragma once

#include <memory>
#include <string>
#include <vector>

#include "view/viewed.h"

namespace tera {

/// HTTP server for a page and its data, for browsers on this computer. It runs during the lifetime
/// of the object.
///
/// Model   HTTP/1.1 on 127.0.0.1. Requests for another host name are rejected. GET and HEAD are
///         supported: `/` is the page, `/index.json` the index, `/stage/K` the scene of item K, and
///         `/data/K/FILE` a file in the item's folder (ServedFolder), as a whole or a range. Other
///         requests give 403, 404 or 405. The server never writes files.
class ViewServer {
 public:
  /// Port 0 selects a free port. Throws InputError if the port is in use.
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

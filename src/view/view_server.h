#pragma once

#include <memory>
#include <string>
#include <vector>

#include "view/viewed.h"

namespace tera {

/// Serves a page and its data to browsers on this computer during its lifetime.
///
/// Model   HTTP/1.1 on 127.0.0.1 alone; the server answers only requests for that host. GET and
///         HEAD: `/` is the page, `/index.json` the index, `/stage/K` the scene of the K-th viewed
///         item. `/data/K/FILE` is a file of its folder (ServedFolder), whole or as a range. All
///         other requests give 404, 405 or 403. The server writes no files.
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

#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "ros2/fast_peer.h"

namespace tera {

/// A program in a separate process, killed on destruction.
class PeerProcess {
 public:
  explicit PeerProcess(std::vector<std::string> command);
  ~PeerProcess() { Kill(); }
  PeerProcess(const PeerProcess&) = delete;
  PeerProcess& operator=(const PeerProcess&) = delete;

  /// Without a word to anybody.
  void Kill();
  void Signal(int number) const;
  /// Whether it has been stopped, by itself or a signal.
  bool IsStopped();

 private:
  pid_t pid_ = -1;
  bool stopped_ = false;
};

/// lever_peer for `machine`, which raises its boom by `boom`.
std::vector<std::string> LeverPeer(const std::string& machine, const std::string& boom);

/// hung_reader of the topics.
std::vector<std::string> HungReader(const std::vector<FastPeer::Wish>& wishes);

}  // namespace tera

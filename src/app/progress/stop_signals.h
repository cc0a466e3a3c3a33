#pragma once

#include <csignal>

namespace tera {

/// Ctrl-C and SIGTERM, kept from all threads that are started while it lives and waited for by one.
class StopSignals {
 public:
  StopSignals();
  /// Also until the end of standard input, if `or_stdin`.
  void Wait(bool or_stdin) const;

 private:
  sigset_t signals_;
};

}  // namespace tera

#pragma once

#include <csignal>

namespace tera {

/// Blocks SIGINT (Ctrl-C) and SIGTERM in all threads that start during its lifetime, so that one
/// thread can wait for them.
class StopSignals {
 public:
  StopSignals();
  /// Waits for such a signal; with `or_stdin`, also for the end of standard input.
  void Wait(bool or_stdin) const;

 private:
  sigset_t signals_;
};

}  // namespace tera

#pragma once

#include <csignal>

namespace tera {

/// Blocks Ctrl-C and SIGTERM in all threads started during its lifetime; a single thread waits for
/// them.
class StopSignals {
 public:
  StopSignals();
  /// `or_stdin` also waits for the end of standard input.
  void Wait(bool or_stdin) const;

 private:
  sigset_t signals_;
};

}  // namespace tera

#include "app/progress/stop_signals.h"

#include <poll.h>
#include <unistd.h>

namespace tera {
namespace {

bool StandardInputIsClosed() {
  pollfd input = {.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
  if (poll(&input, 1, 0) <= 0) return false;
  char unread[256];
  return read(STDIN_FILENO, unread, sizeof unread) <= 0;
}

}  // namespace

StopSignals::StopSignals() {
  sigemptyset(&signals_);
  sigaddset(&signals_, SIGINT);
  sigaddset(&signals_, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
}

void StopSignals::Wait(bool or_stdin) const {
  constexpr timespec kLookAgain = {.tv_sec = 0, .tv_nsec = 100'000'000};
  while (sigtimedwait(&signals_, nullptr, &kLookAgain) < 0) {
    if (or_stdin && StandardInputIsClosed()) return;
  }
}

}  // namespace tera

#include "app/progress/stop_message.h"

#include <unistd.h>

#include <csignal>

namespace tera {
namespace {

std::string message;

/// Runs within the signal: nothing but write and raise. SA_RESETHAND has brought back the default
/// action, which ends the program when the handler returns.
void SayAndEnd(int signal) {
  // The program ends here; where standard error is closed there is nobody to tell.
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, message.data(), message.size());
  raise(signal);
}

}  // namespace

StopMessage::StopMessage(const std::string& text) {
  message = text;
  struct sigaction action = {};
  action.sa_handler = SayAndEnd;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

StopMessage::~StopMessage() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

}  // namespace tera

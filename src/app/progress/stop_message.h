#pragma once

#include <string>

namespace tera {

/// While it lives, Ctrl-C and SIGTERM still end the program, but first `text` goes to standard
/// error: how to go on with the run that they stop. One at a time.
class StopMessage {
 public:
  explicit StopMessage(const std::string& text);
  StopMessage(const StopMessage&) = delete;
  StopMessage& operator=(const StopMessage&) = delete;
  ~StopMessage();
};

}  // namespace tera

#include "dataset/files/child_process.h"

#include <fmt/format.h>

#include <csignal>
#include <utility>

#include "core/check.h"
#include "core/error.h"

namespace tera {
namespace {

constexpr int kNotFoundStatus = 127;  // exit status of a shell

}  // namespace

ChildProcess::ChildProcess(const std::string& program, const std::string& arguments,
                           const std::string& remedy)
    : program_(program), remedy_(remedy) {
  // Without this, a write to a program that has ended would kill this process.
  old_handler_ = std::signal(SIGPIPE, SIG_IGN);
  const std::string command = fmt::format("command -v {0} >/dev/null || exit {1}; exec {0} {2}",
                                          program, kNotFoundStatus, arguments);
  pipe_ = ::popen(command.c_str(), "w");
  TERA_CHECK(pipe_ != nullptr, command);
}

ChildProcess::~ChildProcess() {
  if (pipe_) ::pclose(pipe_);
  std::signal(SIGPIPE, old_handler_);
}

void ChildProcess::Write(std::string_view bytes) {
  std::fwrite(bytes.data(), 1, bytes.size(), pipe_);
}

void ChildProcess::Close() {
  const int status = ::pclose(std::exchange(pipe_, nullptr));
  if (status == 0) return;
  const bool missing = WIFEXITED(status) && WEXITSTATUS(status) == kNotFoundStatus;
  throw InputError(
      "", {FaultKind::kUnsupported,
           fmt::format("{} {}; {}", program_, missing ? "is not installed" : "failed", remedy_)});
}

std::string ShellWord(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

}  // namespace tera

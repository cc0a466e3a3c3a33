#pragma once

#include <cstdio>
#include <string>
#include <string_view>

namespace tera {

/// Another program that reads this one's output: gnuplot, ffmpeg.
class ChildProcess {
 public:
  /// Starts `program` with `arguments`, split as in a shell. `remedy` ends the messages: the
  /// package of the program.
  ChildProcess(const std::string& program, const std::string& arguments, const std::string& remedy);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ~ChildProcess();

  /// Does nothing after the program's early end, which Close reports.
  void Write(std::string_view bytes);
  /// Waits for the end. Throws InputError if the program is not installed or reports a failure.
  void Close();

 private:
  std::string program_, remedy_;
  std::FILE* pipe_ = nullptr;
  void (*old_handler_)(int) = nullptr;
};

/// `text` as one word of a shell command.
std::string ShellWord(const std::string& text);

}  // namespace tera

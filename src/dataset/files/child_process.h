#pragma once

#include <cstdio>
#include <string>
#include <string_view>

namespace tera {

/// Another program that reads what is written to it: gnuplot, ffmpeg.
class ChildProcess {
 public:
  /// Starts `program` with `arguments` as a shell would split them. `remedy` ends the messages:
  /// which package holds the program.
  ChildProcess(const std::string& program, const std::string& arguments, const std::string& remedy);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ~ChildProcess();

  /// A program that ended early takes nothing more; Close reports it.
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

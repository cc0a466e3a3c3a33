#pragma once

#include <cstdio>
#include <string>
#include <string_view>

namespace tera {

/// Another program that reads data from this process, such as gnuplot or ffmpeg.
class ChildProcess {
 public:
  /// Starts `program`. `arguments` is split as in a shell. `remedy` ends error messages, for
  /// example with the package to install.
  ChildProcess(const std::string& program, const std::string& arguments, const std::string& remedy);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ~ChildProcess();

  /// Has no effect if the program has already ended; Close then reports its failure.
  void Write(std::string_view bytes);
  /// Waits until the program ends. Throws InputError if it is not installed or fails.
  void Close();

 private:
  std::string program_, remedy_;
  std::FILE* pipe_ = nullptr;
  void (*old_handler_)(int) = nullptr;
};

/// Quotes `text` as one word of a shell command.
std::string ShellWord(const std::string& text);

}  // namespace tera

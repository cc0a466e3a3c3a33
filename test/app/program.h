#pragma once

#include <sys/types.h>

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "dataset/format/sample_recording.h"

/// The `tera` program from a user's view: arguments in, exit status and text out.

namespace tera {

using Arguments = std::vector<std::string>;

/// Result of a run.
struct Outcome {
  int status = -1;  ///< exit status, or -1 if a signal ended it
  int signal = 0;
  std::string out, err;
};

struct Surroundings {
  std::filesystem::path directory;  ///< working directory
  std::map<std::string, std::string> environment = {};
};

extern const char* const kTera;

/// A run of `program` with its standard output and error in files, hence without a terminal.
class TeraProcess {
 public:
  TeraProcess(const Arguments& arguments, const Surroundings& surroundings,
              const std::string& program = kTera);
  TeraProcess(const TeraProcess&) = delete;
  TeraProcess& operator=(const TeraProcess&) = delete;
  /// Ends a run that is still running.
  ~TeraProcess();

  bool Running();
  void Signal(int signal);
  Outcome Wait();

 private:
  ScratchDirectory output_;
  pid_t pid_ = -1;
  bool ended_ = false;
  int wait_status_ = 0;
};

/// Runs to the end. A dataset written by it must pass `tera lint`.
Outcome RunTera(const Arguments& arguments, const Surroundings& surroundings);

/// A run on a terminal of `columns`; `out` holds all its output.
Outcome RunTeraOnTerminal(const Arguments& arguments, const std::filesystem::path& directory,
                          int columns);

/// Every file and folder below `root`.
std::set<std::string> Entries(const std::filesystem::path& root);

/// A rover at rest, 0.4 s, with an IMU and the sensors in `more_sensors`.
std::string SmallScenario(const std::string& more_sensors = "");
/// Sensors for SmallScenario.
extern const char* const kCamera;
extern const char* const kLidar;

/// `text` with its first `from` replaced by `to`; fails the test without one.
std::string Edited(std::string text, const std::string& from, const std::string& to);

/// "line:column" of the first `needle` in `text`, counted from 1.
std::string LineAndColumn(const std::string& text, const std::string& needle);

}  // namespace tera

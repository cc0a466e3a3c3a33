#pragma once

#include <array>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "campaign/plan/plan.h"
#include "render/gl/egl_options.h"

namespace tera {

/// Signals by which a program ends because of a bug. Other signals come from outside, for example
/// when memory is exhausted.
inline constexpr std::array kCrashSignals = {SIGILL, SIGABRT, SIGBUS, SIGFPE, SIGSEGV, SIGSYS};

/// Command with which an engine starts a worker: `program campaign run FOLDER --index N arguments`.
struct WorkerCommand {
  std::filesystem::path program;  ///< path of `tera`, which must be the same on every host
  std::vector<std::string> arguments;
};

struct WorkerOptions {
  int threads = 1;  ///< the result does not depend on it
  EglOptions egl;
};

/// Runs one episode. The result does not depend on when, where or how often the episode is tried. A
/// complete episode is not changed; an interrupted one resumes. Returns false if another worker is
/// running the episode.
///
/// Model   An episode is created in work/ and renamed when complete, together with its record. Bad
///         input, a bug, rejection by the rules and lack of memory leave a failure in failed/.
///         Faults of the computer (disk, driver, missing program) and input files changed since
///         planning leave none.
/// Throws  InputError on failure, and for an episode that has failed before and would fail again.
bool RunEpisode(const Plan& plan, int number, const WorkerOptions& options);

}  // namespace tera

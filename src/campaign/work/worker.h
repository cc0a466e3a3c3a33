#pragma once

#include <array>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "campaign/plan/plan.h"
#include "render/gl/egl_options.h"

namespace tera {

/// Signals by which a program ends itself: a bug. Others come from outside, as where memory ran
/// out.
inline constexpr std::array kCrashSignals = {SIGILL, SIGABRT, SIGBUS, SIGFPE, SIGSEGV, SIGSYS};

/// How an engine starts a worker: `program campaign run FOLDER --index N arguments`.
struct WorkerCommand {
  std::filesystem::path program;  ///< `tera`, at this path wherever the engine starts it
  std::vector<std::string> arguments;
};

struct WorkerOptions {
  int threads = 1;  ///< the bytes do not depend on it
  EglOptions egl;
};

/// Makes one episode, the same whenever, wherever and however often it is tried. An episode that is
/// there is left as it is, and one that was killed goes on. Returns false for an episode that
/// another worker is making, which is left to it.
///
/// Model   an episode is made in work/ and renamed when it is whole, with its record. Bad input, a
///         bug, refusals by the rules and too little memory leave a failure in failed/. Faults of
///         the computer (its disks, drivers, programs) and files changed since the plan leave none.
/// Throws  InputError, also of an episode that failed before and would fail again.
bool RunEpisode(const Plan& plan, int number, const WorkerOptions& options);

}  // namespace tera

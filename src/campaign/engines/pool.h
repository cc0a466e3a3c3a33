#pragma once

#include <functional>

#include "campaign/plan/plan.h"
#include "campaign/work/index.h"
#include "campaign/work/worker.h"

namespace tera {

struct PoolProgress {
  int done = 0, failed = 0, running = 0, episodes = 0;
  double wall_s = 0;  ///< since the pool began
  double left_s = 0;  ///< expected; 0 while nothing is known
};

struct PoolOptions {
  WorkerCommand worker;
  int processes = 1;  ///< at once; fewer where memory does not reach
  std::function<void(const PoolProgress&)> progress;
};

/// Makes all missing episodes by child processes, `tera campaign run FOLDER --index N`, each with
/// its output in logs/.
///
/// Model   a process starts when its expected memory is available beside that of those that run.
///         Expected is the largest peak of an episode so far, 1 GB before the first. Children end
///         with this process.
///         An episode that another worker makes is left to it.
/// Throws  InputError where another pool is at work on the folder, and of an obstacle of the
///         computer, with the last lines of the log. It starts no further episodes then and waits
///         for those that run.
CampaignState RunPool(const Plan& plan, const PoolOptions& options);

}  // namespace tera

#pragma once

#include <functional>

#include "campaign/plan/plan.h"
#include "campaign/work/index.h"
#include "campaign/work/worker.h"

namespace tera {

struct PoolProgress {
  int done = 0, failed = 0, running = 0, episodes = 0;
  double wall_s = 0;  ///< since the pool started
  double left_s = 0;  ///< expected remaining time; 0 if unknown
};

struct PoolOptions {
  WorkerCommand worker;
  int processes = 1;  ///< largest number of processes at a time; fewer if memory is short
  std::function<void(const PoolProgress&)> progress;
};

/// Runs all missing episodes in child processes, `tera campaign run FOLDER --index N`. The output
/// of each goes to logs/.
///
/// Model   A process starts if the expected memory of all processes fits into 90 % of the memory
///         that was free at the start. The expected memory of a process is the largest peak of an
///         episode so far, or 1 GB before the first episode ends. Children are killed if this
///         process ends. Episodes that another worker runs are skipped.
/// Throws  InputError if another pool runs on the folder, or if an episode meets an obstacle of the
///         computer, such as a full disk. The message contains the last lines of the log. No
///         further episodes start then; those running are completed first.
CampaignState RunPool(const Plan& plan, const PoolOptions& options);

}  // namespace tera

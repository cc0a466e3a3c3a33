#pragma once

#include <functional>
#include <string>

#include "campaign/engines/emitters.h"
#include "campaign/plan/plan.h"
#include "campaign/work/index.h"

namespace tera {

struct SlurmOptions {
  WorkerCommand worker;
  int per_task = 0;       ///< episodes of a task; 0: so many that a task lasts some minutes
  int memory_mb = 0;      ///< of a task; 0: the cluster's default
  int minutes = 0;        ///< of a task; 0: the cluster's default
  int tries = 3;          ///< times in a row that all arrays may end without one episode
  double poll_s = 30;     ///< between questions to the controller
  std::string arguments;  ///< further ones of sbatch, as a shell has them
  std::function<void(const std::string&)> say;
};

/// Makes all missing episodes as job arrays of Slurm, and waits for them.
///
/// Model   a task makes several episodes by WorkerScript. The controller is asked for the state of
///         tasks (scontrol), so that accounting is not needed; one that does not answer is asked
///         again. Further arrays retry episodes that neither succeeded nor failed. They exclude
///         nodes that were lost or met an obstacle twice, and double the memory where it ran out,
///         up to that of the largest node: what needs more fails. Stopped episodes, as by a time
///         limit, resume where they were. After a kill while arrays are
///         under way, the next call waits for those arrays first.
/// Throws  InputError if another engine is at work, or if Slurm is absent or refuses the array.
CampaignState RunOnSlurm(const Plan& plan, const SlurmOptions& options);

}  // namespace tera

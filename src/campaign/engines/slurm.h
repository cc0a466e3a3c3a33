#pragma once

#include <functional>
#include <string>

#include "campaign/engines/emitters.h"
#include "campaign/plan/plan.h"
#include "campaign/work/index.h"

namespace tera {

struct SlurmOptions {
  WorkerCommand worker;
  int per_task = 0;   ///< episodes per task; 0: enough for a task to last some minutes
  int memory_mb = 0;  ///< memory per task; 0: default of the cluster
  int minutes = 0;    ///< time limit per task; 0: default of the cluster
  int tries = 3;  ///< number of rounds of arrays in a row that may end without a finished episode
  double poll_s = 30;     ///< interval between queries to the controller
  std::string arguments;  ///< more arguments for sbatch, in shell syntax
  std::function<void(const std::string&)> say;
};

/// Runs all missing episodes as job arrays of Slurm and waits for them.
///
/// Model   A task runs several episodes with WorkerScript. The states of tasks come from scontrol,
///         so no accounting is required. If the controller does not answer, it is queried again.
///         Further arrays retry episodes that neither succeeded nor failed; an interrupted episode,
///         for example at a time limit, resumes. A retry excludes nodes that were lost or on which
///         two tasks failed. After a lack of memory, it requests twice as much, up to the memory of
///         the largest node. An episode that needs more than that fails. If this program is killed
///         while arrays are running, the next call first waits for them.
/// Throws  InputError if another engine runs the campaign, or if Slurm is missing or refuses the
///         array.
CampaignState RunOnSlurm(const Plan& plan, const SlurmOptions& options);

}  // namespace tera

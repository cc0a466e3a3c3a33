#pragma once

#include <functional>
#include <string>

#include "campaign/plan/plan.h"
#include "campaign/work/index.h"

namespace tera {

struct SlurmOptions {
  std::filesystem::path program;  ///< `tera`, on every node
  int per_task = 0;               ///< episodes of a task; 0: so many that a task lasts some minutes
  int memory_mb = 0;              ///< of a task; 0: the cluster's default
  int minutes = 0;                ///< of a task; 0: the cluster's default
  int tries = 3;                  ///< of arrays, for episodes that a node, memory or time cost
  double poll_s = 30;             ///< between questions to the controller
  std::string arguments;          ///< further ones of sbatch, as a shell has them
  std::function<void(const std::string&)> say;
};

/// Makes all missing episodes as job arrays of Slurm, and waits for them.
///
/// Model   a task makes several episodes, one after the other, by `tera campaign run --index`. The
///         controller is asked for the state of tasks (scontrol), so that accounting is not needed;
///         one that does not answer is asked again. What ended tasks without episode and failure is
///         tried in a further array: without nodes that failed, with twice the memory where that
///         ran out, with twice the time where that did. A stopped episode goes on where it was.
/// Throws  InputError if Slurm is absent or refuses the array.
CampaignState RunOnSlurm(const Plan& plan, const SlurmOptions& options);

}  // namespace tera

#pragma once

#include <functional>
#include <string>
#include <vector>

#include "campaign/plan/plan.h"
#include "campaign/sweep/effects.h"
#include "campaign/work/worker.h"

namespace tera {

struct SweepOptions {
  WorkerCommand worker;  ///< program of the episodes and of the outcome's command
  int processes = 1;     ///< commands of outcomes at once
};

struct SweepResult {
  std::string figure;
  std::vector<SweptRun> runs;
  std::vector<FactorEffect> effects;
};

/// Takes the outcome of an episode: runs the campaign's `outcome.run` on it, unless
/// `outcomes/NUMBER/` holds the report already, and reads the figure. A command writes in
/// `outcomes/NUMBER.part/`, which is renamed when it has ended well.
///
/// Throws  InputError: a command that fails, with the end of its output; a figure that is not
/// there.
double OutcomeOf(const Plan& plan, int number, const SweepOptions& options);

/// Takes the outcomes of the episodes `numbers`, several commands at once.
SweepResult TakeSweep(const Plan& plan, const std::vector<int>& numbers,
                      const SweepOptions& options);

/// Writes runs.csv, sweep.csv, sweep.svg and sweep.md into the campaign's folder.
void WriteSweep(const SweepResult& sweep, const Plan& plan);

}  // namespace tera

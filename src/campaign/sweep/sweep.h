#pragma once

#include <functional>
#include <string>
#include <vector>

#include "campaign/plan/plan.h"
#include "campaign/sweep/effects.h"
#include "campaign/work/worker.h"

namespace tera {

struct SweepOptions {
  WorkerCommand worker;  ///< program that runs the episodes and the outcome's command
  int processes = 1;     ///< commands that run at a time
};

struct SweepResult {
  std::string figure;
  std::vector<SweptRun> runs;
  std::vector<FactorEffect> effects;
};

/// Determines the outcome of an episode: runs the campaign's `outcome.run` on it and reads the
/// figure. The command is skipped if `outcomes/NUMBER/` already contains the report. It writes to
/// `outcomes/NUMBER.part/`, which is renamed after success.
///
/// Throws  InputError if the command fails, with the end of its output, or if the figure is
///         missing.
double OutcomeOf(const Plan& plan, int number, const SweepOptions& options);

/// Determines the outcomes of the episodes `numbers`, with several commands at a time.
SweepResult TakeSweep(const Plan& plan, const std::vector<int>& numbers,
                      const SweepOptions& options);

/// Writes runs.csv, sweep.csv, sweep.svg and sweep.md to the campaign's folder.
void WriteSweep(const SweepResult& sweep, const Plan& plan);

}  // namespace tera

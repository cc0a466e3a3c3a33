#pragma once

#include <filesystem>
#include <optional>

#include "serve/scenario_source.h"
#include "serve/server.h"
#include "sim/run/live_run.h"
#include "sim/scenario/scenario.h"

namespace tera {

struct StageOptions {
  int threads = 2;  ///< for parallel environments, rays and encoding
  EglOptions egl;
  /// Folder in which each episode is recorded as a dataset, episode_0001 and so on. Numbers
  /// continue after existing episodes.
  std::optional<std::filesystem::path> record;
};

/// Creates the stages of `tera serve`. A stage simulates the episodes of one client session, each
/// with a LiveRun.
///
/// Model   A session has one or more environments. Those named in a batch are stepped in parallel.
///         Results do not depend on other environments or on the number of threads. An episode
///         lasts from a Reset to the next Reset of its environment, or to the end of the session;
///         its recording is then completed. An action applies during the whole step.
/// Throws  InputError at once if the recording folder is not writable, and later if `source`
///         throws.
///
/// `log` receives a message if a recording cannot be completed after its session. `scenario` is the
/// scenario of the source, used for the description.
Server::MakeStage LiveStages(const Scenario& scenario, ScenarioSource source,
                             const StageOptions& options, Server::Log log);

}  // namespace tera

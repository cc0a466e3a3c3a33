#pragma once

#include <filesystem>
#include <optional>

#include "serve/scenario_source.h"
#include "serve/server.h"
#include "sim/run/live_run.h"
#include "sim/scenario/scenario.h"

namespace tera {

struct StageOptions {
  int threads = 2;  ///< for the turns of a batch, rays and encoding
  EglOptions egl;
  /// Folder in which each episode becomes a dataset, episode_0001 and so on, numbered after
  /// existing episodes.
  std::optional<std::filesystem::path> record;
};

/// Stages of `tera serve` sessions: episodes of a scenario, each with its own LiveRun.
///
/// Model   a session has environments, which take the turns of a batch in parallel; results do not
///         depend on each other, nor on the number of threads. In each an episode lasts from a
///         Reset to the next Reset or to the end of the session. Its recording is then completed in
///         any case. An action holds for the whole of its step.
/// Throws  InputError at once if the recording folder is not writable; later if the source throws.
///
/// `log` receives recordings that cannot be completed after the session's end. `scenario` is the
/// source's scenario, for the description.
Server::MakeStage LiveStages(const Scenario& scenario, ScenarioSource source,
                             const StageOptions& options, Server::Log log);

}  // namespace tera

#pragma once

#include <filesystem>
#include <optional>

#include "serve/scenario_source.h"
#include "serve/server.h"
#include "sim/run/live_run.h"
#include "sim/scenario/scenario.h"

namespace tera {

struct StageOptions {
  int threads = 2;  ///< for rays and for encoding
  EglOptions egl;
  /// Folder in which each episode becomes a dataset, episode_0001 and so on, after those there.
  std::optional<std::filesystem::path> record;
};

/// What each session of `tera serve` acts on: episodes of a scenario, each a LiveRun of its own.
///
/// Model   An episode lasts from a Reset to the next or to the session's end, however it comes;
///         its recording is then finished. An action holds for the whole of its step.
/// Throws  InputError at once where the folder for recordings cannot be written to; later where the
///         source does. `log` is told of a recording that cannot be finished
///         after the session's end.
///
/// `scenario` is what `source` gives, to be described.
Server::MakeStage LiveStages(const Scenario& scenario, ScenarioSource source,
                             const StageOptions& options, Server::Log log);

}  // namespace tera

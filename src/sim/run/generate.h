#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "render/gl/rasterizer.h"
#include "sim/scenario/scenario.h"

namespace tera {

struct GenerateProgress {
  double simulated_s = 0, duration_s = 0;
  std::int64_t frames = 0;
};

struct GenerateOptions {
  std::filesystem::path out;
  int threads = 2;  ///< for rays and encoding; does not affect the output
  bool resume = false;
  /// Also record the scene's evolution, to measure it with other sensors later (StateLog).
  bool keep_state = false;
  EglOptions egl;
  std::function<void(const GenerateProgress&)> progress;  ///< called at regular intervals
};

/// Wall-clock time of each stage. Pictures may be rendered in parallel: `camera_s` is the time of
/// the busiest rasterizer, `camera_wait_s` the time for which the run waited.
struct GenerateReport {
  double simulated_s = 0, wall_s = 0;
  double physics_s = 0, soil_s = 0, camera_s = 0, camera_wait_s = 0, lidar_s = 0;
  std::int64_t frames = 0, bytes = 0;
  std::optional<TaskDeviation> task;  ///< at the end of the run; empty without a task
  bool task_done = false;
};

/// Runs `scenario` and writes its dataset to `options.out`. `resolved_yaml` comes from
/// Config::ResolvedYaml.
///
/// Throws  InputError as DatasetWriter and Rasterizer do. If that happens before the first step, no
///         files remain. Later, the incomplete dataset remains and can be resumed.
GenerateReport Generate(const Scenario& scenario, const std::string& resolved_yaml,
                        const GenerateOptions& options);

}  // namespace tera

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
  int threads = 2;  ///< for rays and for encoding; the bytes do not depend on it
  bool resume = false;
  bool keep_state = false;  ///< records the scene's evolution for other sensors (StateLog)
  EglOptions egl;
  std::function<void(const GenerateProgress&)> progress;  ///< called at intervals
};

/// Wall-clock times of the stages. Pictures may be taken in parallel: `camera_s` is the time of the
/// busiest of their threads, `camera_wait_s` the time that the run waited for them.
struct GenerateReport {
  double simulated_s = 0, wall_s = 0;
  double physics_s = 0, soil_s = 0, camera_s = 0, camera_wait_s = 0, lidar_s = 0;
  std::int64_t frames = 0, bytes = 0;
  std::optional<TaskDeviation> task;  ///< at the end; nothing without a task
  bool task_done = false;
};

/// Runs `scenario` and writes its dataset to `options.out`. `resolved_yaml` is from
/// Config::ResolvedYaml.
///
/// Throws  InputError as DatasetWriter and Rasterizer do. It leaves nothing behind if it fails
///         before the first step, else a directory that can be resumed.
GenerateReport Generate(const Scenario& scenario, const std::string& resolved_yaml,
                        const GenerateOptions& options);

}  // namespace tera

#pragma once

#include <filesystem>
#include <functional>
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
  bool keep_state = false;  ///< how the scene evolved, for other sensors later (StateLog)
  EglOptions egl;
  std::function<void(const GenerateProgress&)> progress;  ///< called now and then
};

/// Where the wall-clock time went. Pictures may be taken beside the other stages: `camera_s` is
/// that of the busiest of the threads that take them, `camera_wait_s` for how long they held up the
/// run.
struct GenerateReport {
  double simulated_s = 0, wall_s = 0;
  double physics_s = 0, soil_s = 0, camera_s = 0, camera_wait_s = 0, lidar_s = 0;
  std::int64_t frames = 0, bytes = 0;
};

/// Runs `scenario` and writes its dataset to `options.out`. `resolved_yaml` is the scenario as
/// Config::ResolvedYaml gives it. Throws InputError as DatasetWriter and Rasterizer do; nothing is
/// left behind then before the first step, and after it a directory that can be resumed.
GenerateReport Generate(const Scenario& scenario, const std::string& resolved_yaml,
                        const GenerateOptions& options);

}  // namespace tera

#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "dataset/format/measurement_sink.h"
#include "dataset/format/site_frame.h"
#include "sensors/sampling.h"
#include "sim/rig_scene.h"
#include "sim/scenario/scenario.h"
#include "sim/scene_assembly.h"
#include "sim/world_state.h"

namespace tera {

/// Samples all sensors of a scenario as they fall due and writes the samples. src/sensors has the
/// model of each kind.
///
/// Frames  W; each sensor's S at X_BS on its link, or at the pose that its effects set.
/// Model   a sensor's raw output passes through the slots of its effects. A sample due between two
///         steps uses the interpolated state and the terrain of the later step. A lidar revolution
///         is traced when it is complete. A picture with an exposure time is taken when its last
///         row is complete. A picture that is incomplete at the end of the run is dropped.
///         Everything is at rest until the start.
/// Omits   motion of the ground within a revolution or an exposure: the ground at its end applies
///         throughout.
class Rig {
 public:
  /// Keeps references to `assembly` and `sink`. Creates the rasterizer and the ray scene only if a
  /// sensor needs them.
  Rig(const Scenario& scenario, const SceneAssembly& assembly, const EglOptions& egl, int threads,
      MeasurementSink* sink);

  /// Samples at the start, t = 0.
  void SampleStart(const Instant& now, const TerrainSurface& ground);
  /// Samples everything that falls due in the step, including its end.
  void Sample(const WorldStep& step);
  /// Writes the unfinished pictures and the open inertial samples of the last step. `step` is the
  /// step after it; nothing else is sampled in it.
  void Finish(const WorldStep& step);

  /// Wall-clock seconds that the run waited for pictures.
  double camera_wait_s() const { return WallOf(ChannelForm::kPictures); }
  /// Wall-clock seconds of the busiest rasterizer, which may run in parallel; valid after Finish.
  double camera_wall_s() const;
  double lidar_wall_s() const { return WallOf(ChannelForm::kScans); }

 private:
  struct Unit {
    std::size_t machine;
    ChannelForm form;
    std::unique_ptr<SensorSampler> sampler;
  };

  bool Has(ChannelForm form) const;
  double* WallOf(ChannelForm form) { return &wall_s_[static_cast<std::size_t>(form)]; }
  double WallOf(ChannelForm form) const { return wall_s_[static_cast<std::size_t>(form)]; }
  /// Calls `what` of every unit with the step.
  using SamplerStep = void (SensorSampler::*)(const SensedStep&);
  void ForEach(SamplerStep what, const WorldStep& step);
  void SampleWithScene(SamplerStep what, const WorldStep& step);

  SiteFrame site_;
  std::vector<Unit> units_;
  RigScene scene_;  ///< after units_: its rasterizers use the units and must be destroyed first
  std::array<double, 3> wall_s_ = {};  ///< by form
};

}  // namespace tera

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

/// Samples all sensors of a scenario when samples fall due, and writes them. src/sensors contains
/// the model of each kind.
///
/// Frames  W. S is each sensor's frame: at X_BS on its link, or at the pose that its effects set.
/// Model   a sensor's raw output passes through its effects. A sample that falls due between two
///         steps uses the interpolated state and the ground of the later step. A lidar revolution
///         is traced when it is complete. A picture with an exposure time is rendered when its last
///         row is complete. Pictures that are incomplete at the end of the run are dropped. Before
///         the start everything is at rest.
/// Omits   changes of the ground during a revolution or an exposure: the ground at its end counts.
class Rig {
 public:
  /// Keeps references to `assembly` and `sink`. Creates rasterizer and ray scene only if a sensor
  /// needs them.
  Rig(const Scenario& scenario, const SceneAssembly& assembly, const EglOptions& egl, int threads,
      MeasurementSink* sink);

  /// Takes the samples at the start, t = 0.
  void SampleStart(const Instant& now, const TerrainSurface& ground);
  /// Takes all samples that fall due in the step, its end included.
  void Sample(const WorldStep& step);
  /// Writes pending pictures and inertial samples of the last step. `step` is the step that
  /// follows; nothing else is sampled in it.
  void Finish(const WorldStep& step);

  /// Wall-clock time for which the run waited for pictures.
  double camera_wait_s() const { return WallOf(ChannelForm::kPictures); }
  /// Wall-clock time of the busiest rasterizer, which may run in parallel. Valid after Finish.
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
  /// Calls the member function `what` of each unit with the step.
  using SamplerStep = void (SensorSampler::*)(const SensedStep&);
  void ForEach(SamplerStep what, const WorldStep& step);
  void SampleWithScene(SamplerStep what, const WorldStep& step);

  SiteFrame site_;
  std::vector<Unit> units_;
  /// Declared after units_: rasterizers use the units, so they must be destroyed first.
  RigScene scene_;
  std::array<double, 3> wall_s_ = {};  ///< by ChannelForm
};

}  // namespace tera

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

/// All sensors of a scenario, sampled as they fall due and written. What each kind does stands with
/// the kind (src/sensors).
///
/// Frames  W; each sensor's S at X_BS on its link, or where its effects put it.
/// Model   what a sensor's own model measures passes through the slots that its effects make.
///         A sample due between two steps is taken from the state interpolated between them; the
///         terrain is that of the later step. A lidar's revolution is traced when it is complete.
///         A picture whose rows are exposed for a while is taken when the last is complete; one
///         that is not at the end of the run is none, and before the start all stood still.
/// Omits   motion of the ground within a revolution or an exposure: that of its end stands for
/// each.
class Rig {
 public:
  /// Keeps references to `assembly` and `sink`. The rasterizer and the ray scene are made only if
  /// a sensor needs them.
  Rig(const Scenario& scenario, const SceneAssembly& assembly, const EglOptions& egl, int threads,
      MeasurementSink* sink);

  /// Samples what is due at the start, t = 0.
  void SampleStart(const Instant& now, const TerrainSurface& ground);
  /// Samples everything that falls due in the step, its end included.
  void Sample(const WorldStep& step);
  /// Writes the pictures that are still being taken, and the inertial samples that the last step
  /// left open, after the step that follows it, in which nothing else is sampled.
  void Finish(const WorldStep& step);

  /// For which pictures held up the run.
  double camera_wait_s() const { return WallOf(ChannelForm::kPictures); }
  /// For which the busiest rasterizer took pictures, which may be beside the run; after Finish.
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
  /// Lets every unit do `what` with the step.
  using SamplerStep = void (SensorSampler::*)(const SensedStep&);
  void ForEach(SamplerStep what, const WorldStep& step);
  void SampleWithScene(SamplerStep what, const WorldStep& step);

  SiteFrame site_;
  std::vector<Unit> units_;
  RigScene scene_;  ///< behind the units, so that its rasterizers, which use them, go first
  std::array<double, 3> wall_s_ = {};  ///< by form
};

}  // namespace tera

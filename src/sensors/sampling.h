#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/motion.h"
#include "core/time.h"
#include "core/types/terrain_surface.h"
#include "dataset/format/measurement_sink.h"
#include "physics/description/machine.h"
#include "render/scene.h"

/// Sampling of active sensors over the physics steps, each at its own times.

namespace tera {

class RayScene;
class SiteFrame;
class RasterizerPool;
struct SensorDescription;

/// Dust, precipitation and fog in a scene.
struct SensedAir {
  const DustVolume* dust = nullptr;  ///< null: no dust
  double rain_mmph = 0;
  double snowfall_mmph = 0;
  double visibility_m = 0;  ///< visibility in fog and haze; 0 for clear air
};

/// Inputs of an image at the end of a step, apart from poses.
struct KeptScene {
  std::shared_ptr<const TerrainSurface> ground;
  Shapes shapes;
  std::shared_ptr<const DustVolume> dust;  ///< null: no dust
};

/// The scene around a rig during a step, for cameras and lidars.
class SensedScene {
 public:
  virtual ~SensedScene() = default;
  /// The ground at the end of the step.
  virtual const TerrainSurface& ground() const = 0;
  /// Deforming meshes at the end of the step.
  virtual Shapes ShapesNow() const = 0;
  /// Poses X_WB of all bodies at fraction `s` of the step.
  virtual std::vector<Pose> BodiesBetween(double s) const = 0;
  /// Poses X_WB of all bodies at a time. The oldest valid time is SensorSampler::SceneNeededSince.
  virtual std::vector<Pose> BodiesAt(TimeNs t_ns) const = 0;
  /// The air at the end of the step.
  virtual SensedAir air() const { return {}; }
  /// Scene data that do not change while held. With concurrent rasterizers they stay valid through
  /// later steps, otherwise until the end of the step. The requesting thread must release them.
  virtual KeptScene Keep() const;
  virtual RasterizerPool* rasterizers() const = 0;
  virtual RayScene* ray_scene() const = 0;
  /// Threads for rays; measurements do not depend on this number.
  virtual int threads() const = 0;
};

/// One step as a sensor sees it: the machine at both ends, and the scene. At the start of a run
/// both ends are equal.
struct SensedStep {
  TimeNs t0_ns = 0, t1_ns = 0;
  const MachineState& before;
  const MachineState& after;
  const SiteFrame& site;
  const SensedScene& scene;

  /// Position of `t_ns` in the step, 0 to 1.
  double FractionAt(TimeNs t_ns) const;
  /// X_WB of a link of the machine at fraction `s` of the step.
  Pose LinkAt(int link, double s) const;
};

/// Destination of a sampler's measurements.
struct SensorOutput {
  MeasurementSink* sink;
  ChannelId channel;
};

/// Construction parameters of a sampler. The references need to be valid only during construction.
struct SensorPlace {
  const SensorDescription& sensor;
  const std::vector<SensorDescription>& rig;  ///< all sensors of the machine
  const MachineModel& machine;
  /// prefix of the sensor's channel and random streams, for example "excavator1/imu_boom"
  std::string folder;
  std::uint64_t seed;
  SensorOutput output;
};

/// One active sensor. It receives contiguous steps.
class SensorSampler {
 public:
  virtual ~SensorSampler() = default;
  /// Takes the samples due at the start of the run.
  virtual void SampleStart(const SensedStep& step) { Sample(step); }
  /// Takes the samples due in the step, including its end.
  virtual void Sample(const SensedStep& step) = 0;
  /// Writes the samples that would depend on a step after the end of the run.
  virtual void Finish(const SensedStep&) {}
  /// True if the sampler queries body poses from earlier steps.
  virtual bool LooksBack() const { return false; }
  /// Oldest time at which the sampler may query body poses.
  virtual TimeNs SceneNeededSince(TimeNs now_ns) const { return now_ns; }
};

/// A sensor with instantaneous samples.
class InstantSampler : public SensorSampler {
 public:
  explicit InstantSampler(const SampleClock& clock) : clock_(clock) {}
  void Sample(const SensedStep& step) final;

 protected:
  /// Takes sample `k`, due at `t_ns` within the step.
  virtual void MeasureAt(std::int64_t k, TimeNs t_ns, const SensedStep& step) = 0;
  const SampleClock& clock() const { return clock_; }

 private:
  SampleClock clock_;
  std::int64_t next_ = 0;
};

}  // namespace tera

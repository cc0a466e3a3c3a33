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

/// Drives active sensors through the physics steps, each at its own sample times.

namespace tera {

class RayScene;
class SiteFrame;
class RasterizerPool;
struct SensorDescription;

/// Airborne matter of a scene.
struct SensedAir {
  const DustVolume* dust = nullptr;  ///< null: no dust
  double rain_mmph = 0;
  double snowfall_mmph = 0;
  double visibility_m = 0;  ///< in fog and haze; 0: not stated, clear
};

/// Inputs of an image other than poses, at the end of a step.
struct KeptScene {
  std::shared_ptr<const TerrainSurface> ground;
  Shapes shapes;
  std::shared_ptr<const DustVolume> dust;  ///< null: no dust
};

/// The scene around a rig during the sampled step, for exteroceptive sensors.
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
  /// Scene data that stay constant while held. With concurrent rasterizers, the data remain valid
  /// through later steps, otherwise until the end of the step. The requesting thread must release
  /// them.
  virtual KeptScene Keep() const;
  virtual RasterizerPool* rasterizers() const = 0;
  virtual RayScene* ray_scene() const = 0;
  /// Threads for rays; measurements do not depend on this number.
  virtual int threads() const = 0;
};

/// One step as seen by a sensor: the machine at both ends, and the scene. At the start of a run
/// both ends are equal.
struct SensedStep {
  TimeNs t0_ns = 0, t1_ns = 0;
  const MachineState& before;
  const MachineState& after;
  const SiteFrame& site;
  const SensedScene& scene;

  /// Position of `t_ns` between the ends, 0 to 1.
  double FractionAt(TimeNs t_ns) const;
  /// X_WB of a link of the machine at the fraction `s`.
  Pose LinkAt(int link, double s) const;
};

/// Destination of a sampler's measurements.
struct SensorOutput {
  MeasurementSink* sink;
  ChannelId channel;
};

/// Construction parameters of a sampler. References need to outlive only the construction.
struct SensorPlace {
  const SensorDescription& sensor;
  const std::vector<SensorDescription>& rig;  ///< all sensors of the machine
  const MachineModel& machine;
  std::string folder;  ///< "excavator1/imu_boom", base of its channel and random streams
  std::uint64_t seed;
  SensorOutput output;
};

/// One active sensor. Steps are contiguous.
class SensorSampler {
 public:
  virtual ~SensorSampler() = default;
  /// Measures the samples due at the start of the run.
  virtual void SampleStart(const SensedStep& step) { Sample(step); }
  /// Measures the samples due in the step, including its end.
  virtual void Sample(const SensedStep& step) = 0;
  /// Writes samples that depend on the step after the run's last step. The step produces no other
  /// measurements.
  virtual void Finish(const SensedStep&) {}
  /// True if the sampler queries body poses from earlier steps.
  virtual bool LooksBack() const { return false; }
  /// Oldest time at which the sampler may still query body poses.
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

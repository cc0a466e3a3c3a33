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

/// How sensors at work are driven: step by step of the physics, each at its own times.

namespace tera {

class RayScene;
class SiteFrame;
class RasterizerPool;
struct SensorDescription;

/// What the air of a scene carries.
struct SensedAir {
  const DustVolume* dust = nullptr;  ///< null: none
  double rain_mmph = 0;
};

/// What a picture looks at beside poses, as it is at the end of a step.
struct KeptScene {
  std::shared_ptr<const TerrainSurface> ground;
  Shapes shapes;
  std::shared_ptr<const DustVolume> dust;  ///< null: none
};

/// The scene around a rig, for sensors that see it. It is that of the step which is being sampled.
class SensedScene {
 public:
  virtual ~SensedScene() = default;
  /// The ground at the end of the step.
  virtual const TerrainSurface& ground() const = 0;
  /// What changes its shape, at the end of the step.
  virtual Shapes ShapesNow() const = 0;
  /// Poses X_WB of all bodies at the fraction `s` of the way through the step.
  virtual std::vector<Pose> BodiesBetween(double s) const = 0;
  /// Poses X_WB of all bodies at a time, which may be as early as the oldest that a sampler needs
  /// (SensorSampler::SceneNeededSince).
  virtual std::vector<Pose> BodiesAt(TimeNs t_ns) const = 0;
  /// The air at the end of the step.
  virtual SensedAir air() const { return {}; }
  /// What of it stays as it is for as long as it is held: where rasterizers work beside the run,
  /// through later steps; else to the end of the step. To be let go by the thread that asked.
  virtual KeptScene Keep() const;
  virtual RasterizerPool* rasterizers() const = 0;
  virtual RayScene* ray_scene() const = 0;
  /// Threads that rays may use; no measurement depends on it.
  virtual int threads() const = 0;
};

/// What a sensor may sense of one step: its machine at both ends, and the scene. At the start of a
/// run both ends are the same.
struct SensedStep {
  TimeNs t0_ns = 0, t1_ns = 0;
  const MachineState& before;
  const MachineState& after;
  const SiteFrame& site;
  const SensedScene& scene;

  /// How far `t_ns` lies between the ends, 0 to 1.
  double FractionAt(TimeNs t_ns) const;
  /// X_WB of a link of the machine at the fraction `s`.
  Pose LinkAt(int link, double s) const;
};

/// Where a sampler puts what it measures.
struct SensorOutput {
  MeasurementSink* sink;
  ChannelId channel;
};

/// What a sampler is made from. All but the strings must outlive it only while it is made.
struct SensorPlace {
  const SensorDescription& sensor;
  const std::vector<SensorDescription>& rig;  ///< all sensors of the machine
  const MachineModel& machine;
  std::string folder;  ///< "excavator1/imu_boom", of its channel and its random streams
  std::uint64_t seed;
  SensorOutput output;
};

/// One sensor at work. Steps follow each other without a gap.
class SensorSampler {
 public:
  virtual ~SensorSampler() = default;
  /// Measures what is due at the start of the run.
  virtual void SampleStart(const SensedStep& step) { Sample(step); }
  /// Measures what falls due in the step, its end included.
  virtual void Sample(const SensedStep& step) = 0;
  /// Writes what only the step after the run's last one tells, in which nothing else is measured.
  virtual void Finish(const SensedStep&) {}
  /// Whether it asks where bodies were before the step.
  virtual bool LooksBack() const { return false; }
  /// The oldest time at which the sensor will still ask where bodies were.
  virtual TimeNs SceneNeededSince(TimeNs now_ns) const { return now_ns; }
};

/// A sensor that measures at instants.
class InstantSampler : public SensorSampler {
 public:
  explicit InstantSampler(const SampleClock& clock) : clock_(clock) {}
  void Sample(const SensedStep& step) final;

 protected:
  /// Sample `k`, due at `t_ns` in the step.
  virtual void MeasureAt(std::int64_t k, TimeNs t_ns, const SensedStep& step) = 0;
  const SampleClock& clock() const { return clock_; }

 private:
  SampleClock clock_;
  std::int64_t next_ = 0;
};

}  // namespace tera

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "resimulate/recorded_stage.h"
#include "resimulate/sensor_calibration.h"
#include "resimulate/simulated_return.h"
#include "sensors/sensor.h"

namespace tera {

/// Surface class of each instance for a comparison. Tracks and carried soil are not comparable,
/// because their shape is not measured. Machine parts beyond an unmeasured joint are not comparable
/// either. The ground is instance 0.
std::vector<Surface> SurfacesOf(const Scenario& scenario, const SceneAssembly& assembly,
                                const std::vector<RecordedMotion>& machines);

/// Casts rays of recorded scans in the simulated scene, from the recorded trajectory.
///
/// Model   bodies and link have as many poses per scan as the sensor kind specifies; an image has
///         one. The ground is the ground at the scan's end.
class ScanCaster {
 public:
  /// Keeps references to all.
  ScanCaster(const Scenario& scenario, const SceneAssembly& assembly, const RecordedStage& stage,
             const std::vector<RecordedMotion>& machines, int threads);

  /// One scan of a sensor of machine `machine`.
  struct Scan {
    TimeNs t_ns = 0;     ///< recorded time stamp
    TimeNs span_ns = 0;  ///< duration of its rays, a revolution; 0: an image
    RecordedStage::Moment moment;
  };
  std::vector<SimulatedReturn> Cast(std::size_t machine, const SensorDescription& sensor,
                                    const Scan& scan, const SensorCalibration& calibration,
                                    const std::vector<Beam>& beams);
  std::string NameOf(int object) const;

 private:
  void ShowScene(std::size_t machine, int link, const Scan& scan, TimeNs start_ns,
                 int poses_of_span);

  const Scenario& scenario_;
  const SceneAssembly& assembly_;
  const RecordedStage& stage_;
  const std::vector<RecordedMotion>& machines_;
  int threads_;
  RayScene scene_;
  std::vector<Surface> surface_;  ///< one per instance

  /// Present state of the scene.
  TimeNs posed_start_ns_ = 0, posed_span_ns_ = -1;
  const TerrainSurface* posed_ground_ = nullptr;
  std::size_t posed_machine_ = 0;
  int posed_link_ = -1;
  std::vector<BodyState> link_;  ///< at equal steps
};

}  // namespace tera

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "resimulate/recorded_stage.h"
#include "resimulate/sensor_calibration.h"
#include "resimulate/simulated_return.h"
#include "sensors/sensor.h"

namespace tera {

/// Surface class of each instance, for a comparison with measurements. The ground is instance 0.
/// Not comparable are tracks and carried soil, whose shape is not measured, and all parts of a
/// machine whose whole pose is not known (RecordedMotion::shows_whole).
std::vector<Surface> SurfacesOf(const Scenario& scenario, const SceneAssembly& assembly,
                                const std::vector<RecordedMotion>& machines);

/// Casts the rays of recorded scans in the simulated scene, along the recorded trajectory.
///
/// Model   for each scan, bodies and the sensor's link have as many poses as the sensor kind
///         specifies; for an image, one. The ground is that at the end of the scan.
class ScanCaster {
 public:
  /// Keeps references to all arguments.
  ScanCaster(const Scenario& scenario, const SceneAssembly& assembly, const RecordedStage& stage,
             const std::vector<RecordedMotion>& machines, int threads);

  /// A scan or image of a sensor of one machine.
  struct Scan {
    TimeNs t_ns = 0;     ///< recorded time stamp
    TimeNs span_ns = 0;  ///< duration of a revolution; 0 for an image
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

  /// State that the scene currently has.
  TimeNs posed_start_ns_ = 0, posed_span_ns_ = -1;
  const TerrainSurface* posed_ground_ = nullptr;
  std::size_t posed_machine_ = 0;
  int posed_link_ = -1;
  std::vector<BodyState> link_;  ///< motion of the sensor's link, at equal time steps of the scan
};

}  // namespace tera

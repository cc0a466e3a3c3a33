#pragma once

#include <memory>
#include <string>
#include <vector>

#include "resimulate/recorded_stage.h"
#include "resimulate/sensor_calibration.h"
#include "resimulate/simulated_return.h"
#include "sensors/sensor.h"

namespace tera {

/// What each instance of the scene is to a comparison. Tracks and what a shovel carries are
/// not to be compared: nothing measured their shape. Nor are parts of machines of which a joint was
/// not measured. The ground is instance 0.
std::vector<Surface> SurfacesOf(const Scenario& scenario, const SceneAssembly& assembly,
                                const std::vector<RecordedMotion>& machines);

/// Casts rays of recorded scans in the simulated scene, as seen from the recorded trajectory.
///
/// Model   bodies and link are posed at as many instants of a scan as its kind of sensor says, at
///         one of a picture; the ground is that of a scan's end.
class ScanCaster {
 public:
  /// Keeps references to all.
  ScanCaster(const Scenario& scenario, const SceneAssembly& assembly, const RecordedStage& stage,
             const std::vector<RecordedMotion>& machines, int threads);

  /// One scan of a sensor of machine `machine`.
  struct Scan {
    TimeNs t_ns = 0;     ///< as written on it
    TimeNs span_ns = 0;  ///< of its rays, a revolution; 0: a picture
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
  std::vector<Surface> surface_;  ///< of each instance

  /// What the scene shows now.
  TimeNs posed_start_ns_ = 0, posed_span_ns_ = -1;
  const TerrainSurface* posed_ground_ = nullptr;
  std::size_t posed_machine_ = 0;
  int posed_link_ = -1;
  std::vector<BodyState> link_;  ///< at equal steps
};

}  // namespace tera

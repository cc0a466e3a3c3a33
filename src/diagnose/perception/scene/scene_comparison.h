#pragma once

#include "diagnose/perception/perception_diagnosis.h"
#include "diagnose/perception/scene/dust.h"
#include "diagnose/perception/scene/ground_map.h"
#include "diagnose/perception/scene/missing_objects.h"

namespace tera {

/// Differences of the scene under one calibration of a sensor.
struct SceneComparison {
  Dust dust;
  GroundMap ground;
  MissingObjects missing;
  PointFlags explained;        ///< points that one of these explains
  double explained_share = 0;  ///< of all points
};

/// `scale`: sensor noise over its model.
SceneComparison CompareScene(const RangeSource& source, const ScanSplit& split,
                             const SensorCalibration& calibration, double scale);

/// Enters confirmed and unconfirmed differences of the scene, and the map of the ground. Runs after
/// the findings of the sensor, whose noise the errors are compared with.
void TakeOver(const RangeSource& source, SceneComparison scene, PerceptionDiagnosis* diagnosis);

}  // namespace tera

#pragma once

#include "diagnose/perception/perception_diagnosis.h"
#include "diagnose/perception/scene/dust.h"
#include "diagnose/perception/scene/ground_map.h"
#include "diagnose/perception/scene/missing_objects.h"

namespace tera {

/// What of the scene differs under one calibration of a sensor.
struct SceneComparison {
  Dust dust;
  GroundMap ground;
  MissingObjects missing;
  PointFlags explained;        ///< points that any of these explains
  double explained_share = 0;  ///< of all points
};

/// `scale`: of the sensor's noise over its model.
SceneComparison CompareScene(const RangeSource& source, const ScanSplit& split,
                             const SensorCalibration& calibration, double scale);

/// Enters what of the scene is confirmed and what is not, and the map of the ground; after what was
/// found of the sensor, whose noise the errors are held against.
void TakeOver(const RangeSource& source, SceneComparison scene, PerceptionDiagnosis* diagnosis);

}  // namespace tera

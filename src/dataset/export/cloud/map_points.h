#pragma once

#include <functional>

#include "core/types/measurement.h"
#include "dataset/export/export_job.h"

namespace tera {

/// A point of the merged map.
struct MapPoint {
  Vec3 p_W_m = Vec3::Zero();
  float intensity = 0;       ///< 0 to 1
  TimeNs t_ns = 0;           ///< of its own ray, as Stamp has it
  std::uint16_t sensor = 0;  ///< lidars from 0 in the order of dataset.yaml
  std::uint16_t ring = 0;
  std::uint16_t instance = 0;
  std::uint8_t label = 0;  ///< SemanticClass
};

/// All points of all lidars, in the order of the scans, in the world: each from where its sensor
/// was at the time of its own ray (SensorTrack). Throws InputError where there is no lidar or its
/// place is not known.
void ForEachMapPoint(ExportJob* job, const std::function<void(const MapPoint&)>& take);

}  // namespace tera

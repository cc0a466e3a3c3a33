#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "core/types/measurement.h"
#include "dataset/export/counted_file.h"
#include "dataset/export/export_job.h"

namespace tera {

/// A point of the merged map.
struct MapPoint {
  Vec3 p_m = Vec3::Zero();   ///< in the map's frame
  float intensity = 0;       ///< 0 to 1
  TimeNs t_ns = 0;           ///< time of its own ray, converted by Stamp
  std::uint16_t sensor = 0;  ///< index of the lidar in dataset.yaml
  std::uint16_t ring = 0;
  std::uint16_t instance = 0;
  std::uint8_t label = 0;  ///< SemanticClass
};

/// Size of a map.
struct MapExtent {
  std::uint64_t points = 0;
  Vec3 least_m = Vec3::Zero(), most_m = Vec3::Zero();  ///< 0 without points

  void Include(const MapExtent& part);
};

/// Map from a point in W to the map's frame.
using PlaceOnMap = std::function<Vec3(const Vec3& p_W_m)>;
/// Appends a point in a format's bytes.
using AppendMapPoint = void (*)(const MapPoint& point, std::string* bytes);

/// Appends all points of all lidars to a file, in the order of the scans. Each point uses the
/// sensor's pose at the time of its own ray (SensorTrack). Throws InputError without a lidar, or if
/// its pose is unknown.
MapExtent WriteMapPoints(ExportJob* job, const PlaceOnMap& place, AppendMapPoint append,
                         CountedFile* file);

}  // namespace tera

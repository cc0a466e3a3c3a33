#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "core/types/measurement.h"
#include "dataset/export/counted_file.h"
#include "dataset/export/export_job.h"

namespace tera {

/// A point of the merged point cloud.
struct MapPoint {
  Vec3 p_m = Vec3::Zero();   ///< coordinates of the file format
  float intensity = 0;       ///< in [0, 1]
  TimeNs t_ns = 0;           ///< time of the point's ray, converted by ExportJob::Stamp
  std::uint16_t sensor = 0;  ///< index of the lidar in the order of dataset.yaml
  std::uint16_t ring = 0;
  std::uint16_t instance = 0;
  std::uint8_t label = 0;  ///< SemanticClass
};

/// Number of points of a cloud and its bounds.
struct MapExtent {
  std::uint64_t points = 0;
  Vec3 least_m = Vec3::Zero(), most_m = Vec3::Zero();  ///< zero for an empty cloud

  void Include(const MapExtent& part);
};

/// Maps a point in W to the coordinates of the file format.
using PlaceOnMap = std::function<Vec3(const Vec3& p_W_m)>;
/// Appends a point, encoded in the file format.
using AppendMapPoint = void (*)(const MapPoint& point, std::string* bytes);

/// Writes all points of all lidars to a file, scan by scan. Each point is placed by the sensor's
/// pose at the time of the point's own ray (SensorTrack). Throws InputError if there is no lidar or
/// its pose is unknown.
MapExtent WriteMapPoints(ExportJob* job, const PlaceOnMap& place, AppendMapPoint append,
                         CountedFile* file);

}  // namespace tera

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
  TimeNs t_ns = 0;           ///< of its own ray, as Stamp has it
  std::uint16_t sensor = 0;  ///< lidars from 0 in the order of dataset.yaml
  std::uint16_t ring = 0;
  std::uint16_t instance = 0;
  std::uint8_t label = 0;  ///< SemanticClass
};

/// How much a map holds.
struct MapExtent {
  std::uint64_t points = 0;
  Vec3 least_m = Vec3::Zero(), most_m = Vec3::Zero();  ///< of no points 0

  void Include(const MapExtent& part);
};

/// Where a point of W lies in a map's frame.
using PlaceOnMap = std::function<Vec3(const Vec3& p_W_m)>;
/// Appends a point in the bytes of a format.
using AppendMapPoint = void (*)(const MapPoint& point, std::string* bytes);

/// Appends all points of all lidars to a file, in the order of the scans: each from where its
/// sensor was at the time of its own ray (SensorTrack). Throws InputError where there is no lidar
/// or its place is not known.
MapExtent WriteMapPoints(ExportJob* job, const PlaceOnMap& place, AppendMapPoint append,
                         CountedFile* file);

}  // namespace tera

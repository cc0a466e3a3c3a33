#include <fmt/format.h>

#include <bit>
#include <string>

#include "dataset/export/bag/little_endian.h"
#include "dataset/export/cloud/las.h"
#include "dataset/export/cloud/map_points.h"
#include "dataset/export/counted_file.h"
#include "dataset/export/export_job.h"

// Exports of the merged point cloud.

namespace tera {
namespace {

void AppendFloat(double value, std::string* bytes) {
  AppendNumber(std::bit_cast<std::uint32_t>(static_cast<float>(value)), bytes);
}

/// Encodes x y z intensity (float), time in s (double), instance, ring, sensor (16 bits), label (8
/// bits).
void AppendPoint(const MapPoint& point, std::string* bytes) {
  for (const double coordinate : point.p_m) AppendFloat(coordinate, bytes);
  AppendFloat(point.intensity, bytes);
  AppendNumber(std::bit_cast<std::uint64_t>(ToSeconds(point.t_ns)), bytes);
  AppendNumber(point.instance, bytes);
  AppendNumber(point.ring, bytes);
  AppendNumber(point.sensor, bytes);
  AppendNumber(point.label, bytes);
}

Vec3 InW(const Vec3& p_W_m) { return p_W_m; }

}  // namespace

/// Writes map.pcd: PCD 0.7, binary.
///
/// Source  Point Cloud Library, "The PCD (Point Cloud Data) file format".
void ExportPcd(ExportJob* job) {
  CountedFile file(job->folder / "map.pcd");
  const std::uint64_t points = WriteMapPoints(job, InW, AppendPoint, &file).points;
  file.Commit(
      fmt::format("# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n"
                  "FIELDS x y z intensity time instance ring sensor label\n"
                  "SIZE 4 4 4 4 8 2 2 2 1\nTYPE F F F F F U U U U\n"
                  "COUNT 1 1 1 1 1 1 1 1 1\nWIDTH {0}\nHEIGHT 1\n"
                  "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS {0}\nDATA binary\n",
                  points));
}

/// Writes map.ply: PLY 1.0, binary little-endian.
///
/// Source  Turk, "The PLY polygon file format", 1994.
void ExportPly(ExportJob* job) {
  CountedFile file(job->folder / "map.ply");
  const std::uint64_t points = WriteMapPoints(job, InW, AppendPoint, &file).points;
  file.Commit(fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment W: local east-north-up, metres\n"
      "element vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "property float intensity\nproperty double time\nproperty ushort instance\n"
      "property ushort ring\nproperty ushort sensor\nproperty uchar label\nend_header\n",
      points));
}

/// Writes map.las: LAS 1.4 (las.h).
void ExportLas(ExportJob* job) {
  CountedFile file(job->folder / "map.las");
  const DatasetInfo& info = job->recording.info();
  file.Commit(LasHeader(WriteMapPoints(job, LasPlaces(info), AppendLasPoint, &file), info));
}

}  // namespace tera

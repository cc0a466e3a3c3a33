#include "dataset/export/cloud/las.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/types/labels.h"
#include "dataset/export/bag/little_endian.h"
#include "dataset/format/dataset_description.h"
#include "dataset/format/site_frame.h"

namespace tera {
namespace {

constexpr double kUnit_m = 1e-4;
constexpr std::uint16_t kHeaderBytes = 375, kVlrHeaderBytes = 54, kPointBytes = 30;
constexpr std::uint8_t kPointFormat = 6;

void AppendPadded(std::string_view text, std::size_t size, std::string* bytes) {
  bytes->append(text.substr(0, size));
  bytes->append(size - std::min(size, text.size()), '\0');
}

void AppendDouble(double value, std::string* bytes) {
  AppendNumber(std::bit_cast<std::uint64_t>(value), bytes);
}

std::uint8_t ClassOf(std::uint8_t label) {
  constexpr std::uint8_t kUnclassified = 1, kGround = 2, kHighVegetation = 5, kBuilding = 6;
  constexpr int kFirstOfUsers = 64, kLastOfUsers = 255;
  switch (static_cast<SemanticClass>(label)) {
    case SemanticClass::kTerrain:
      return kGround;
    case SemanticClass::kVegetation:
      return kHighVegetation;
    case SemanticClass::kStructure:
      return kBuilding;
    default:
      if (kFirstOfUsers + label > kLastOfUsers) return kUnclassified;
      return static_cast<std::uint8_t>(kFirstOfUsers + label);
  }
}

std::int32_t Units(double coordinate_m) {
  const double units = std::round(coordinate_m / kUnit_m);
  if (std::abs(units) > std::numeric_limits<std::int32_t>::max()) {
    throw InputError(
        "",
        {FaultKind::kOutOfRange,
         fmt::format(
             "a point at {:.0f} m is too far from the origin for LAS; need less than 200 km, or "
             "another format",
             coordinate_m)});
  }
  return static_cast<std::int32_t>(units);
}

/// False for a recording at an unknown place, whose origin is stored as zeros.
bool IsOnTheEarth(const DatasetInfo& info) {
  return info.origin_lat_deg != 0 || info.origin_lon_deg != 0 || info.origin_height_m != 0;
}

std::string WktOf(const DatasetInfo& info) {
  if (!IsOnTheEarth(info)) {
    return "LOCAL_CS[\"East, north, up\",LOCAL_DATUM[\"Site\",0],UNIT[\"metre\",1],"
           "AXIS[\"East\",EAST],AXIS[\"North\",NORTH],AXIS[\"Up\",UP]]";
  }
  return fmt::format(
      "PROJCS[\"Site plane\",GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,"
      "298.257223563,AUTHORITY[\"EPSG\",\"7030\"]],AUTHORITY[\"EPSG\",\"6326\"]],"
      "PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433],AUTHORITY[\"EPSG\",\"4326\"]],"
      "PROJECTION[\"Transverse_Mercator\"],PARAMETER[\"latitude_of_origin\",{}],"
      "PARAMETER[\"central_meridian\",{}],PARAMETER[\"scale_factor\",1],"
      "PARAMETER[\"false_easting\",0],PARAMETER[\"false_northing\",0],UNIT[\"metre\",1],"
      "AXIS[\"Easting\",EAST],AXIS[\"Northing\",NORTH]]",
      info.origin_lat_deg, info.origin_lon_deg);
}

}  // namespace

PlaceOnMap LasPlaces(const DatasetInfo& info) {
  if (!IsOnTheEarth(info)) return [](const Vec3& p_W_m) { return p_W_m; };
  const SiteFrame site(info.origin_lat_deg, info.origin_lon_deg, info.origin_height_m);
  return [site](const Vec3& p_W_m) {
    return Vec3(p_W_m.x(), p_W_m.y(), site.ToGeodetic(p_W_m).height_m);
  };
}

void AppendLasPoint(const MapPoint& point, std::string* bytes) {
  constexpr std::uint8_t kFirstOfOneReturn = 1 | 1 << 4;
  constexpr double kMostIntensity = 65535;
  for (const double coordinate_m : point.p_m) {
    AppendNumber(static_cast<std::uint32_t>(Units(coordinate_m)), bytes);
  }
  const double intensity = std::clamp(static_cast<double>(point.intensity), 0.0, 1.0);
  AppendNumber(static_cast<std::uint16_t>(std::lround(intensity * kMostIntensity)), bytes);
  AppendNumber(kFirstOfOneReturn, bytes);
  AppendNumber(std::uint8_t{0}, bytes);  // flags, scanner channel
  AppendNumber(ClassOf(point.label), bytes);
  AppendNumber(static_cast<std::uint8_t>(point.instance & 0xff), bytes);
  AppendNumber(std::uint16_t{0}, bytes);  // scan angle
  AppendNumber(static_cast<std::uint16_t>(point.sensor + 1), bytes);
  AppendDouble(ToSeconds(point.t_ns), bytes);
}

std::string LasHeader(const MapExtent& extent, const DatasetInfo& info) {
  constexpr std::uint16_t kWktFlag = 1 << 4;
  const std::string wkt = WktOf(info) + '\0';
  const auto before_points =
      static_cast<std::uint32_t>(kHeaderBytes + kVlrHeaderBytes + wkt.size());
  std::string bytes = "LASF";
  AppendNumber(std::uint16_t{0}, &bytes);  // file source
  AppendNumber(kWktFlag, &bytes);
  bytes.append(16, '\0');                 // project
  AppendNumber(std::uint8_t{1}, &bytes);  // version 1.4
  AppendNumber(std::uint8_t{4}, &bytes);
  AppendPadded(info.simulated ? "simulation" : "OTHER", 32, &bytes);
  AppendPadded("TERA " + std::string(TeraVersion()), 32, &bytes);
  AppendNumber(std::uint16_t{0},
               &bytes);  // day and year of creation; 0, so that equal exports have equal bytes
  AppendNumber(std::uint16_t{0}, &bytes);
  AppendNumber(kHeaderBytes, &bytes);
  AppendNumber(before_points, &bytes);
  AppendNumber(std::uint32_t{1}, &bytes);  // variable length records
  AppendNumber(kPointFormat, &bytes);
  AppendNumber(kPointBytes, &bytes);
  bytes.append(4 + 5 * 4, '\0');  // point counts of LAS 1.2; 0 for this point format
  for (int axis = 0; axis < 3; ++axis) AppendDouble(kUnit_m, &bytes);
  for (int axis = 0; axis < 3; ++axis) AppendDouble(0, &bytes);  // offset
  for (int axis = 0; axis < 3; ++axis) {
    AppendDouble(extent.most_m[axis], &bytes);
    AppendDouble(extent.least_m[axis], &bytes);
  }
  bytes.append(8 + 8 + 4, '\0');  // waveforms, extended records
  AppendNumber(extent.points, &bytes);
  AppendNumber(extent.points, &bytes);  // first returns
  bytes.append(14 * 8, '\0');           // second to fifteenth
  AppendNumber(std::uint16_t{0}, &bytes);
  AppendPadded("LASF_Projection", 16, &bytes);
  AppendNumber(std::uint16_t{2112}, &bytes);  // OGC coordinate system WKT
  AppendNumber(static_cast<std::uint16_t>(wkt.size()), &bytes);
  AppendPadded("Plane of the recording's site", 32, &bytes);
  return bytes + wkt;
}

}  // namespace tera

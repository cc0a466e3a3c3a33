#include "soil/site/georaster.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>

#include "core/config/spelling.h"
#include "core/error.h"
#include "core/units.h"

namespace tera {
namespace {

constexpr double kMostPixels = 2.5e7;  ///< of a file that is read: 600 MB while it is
constexpr double kNoHeight = std::numeric_limits<double>::quiet_NaN();

/// A band's numbers as GDAL converts them to `type`, T's, rows from the south.
template <typename T>
std::vector<T> ReadStored(const std::filesystem::path& file, GDALRasterBand* band,
                          GDALDataType type) {
  const int nx = band->GetXSize(), ny = band->GetYSize();
  std::vector<T> pixels(static_cast<std::size_t>(nx) * ny);
  // The file's first row is the northernmost: the lines are laid down backwards.
  T* last_row = pixels.data() + static_cast<std::size_t>(ny - 1) * nx;
  const GSpacing line = -static_cast<GSpacing>(nx) * static_cast<GSpacing>(sizeof(T));
  if (band->RasterIO(GF_Read, 0, 0, nx, ny, last_row, nx, ny, type, 0, line) != CE_None) {
    Refuse(file, {FaultKind::kMalformed,
                  fmt::format("its pixels cannot be read ({}); the file may be truncated",
                              CPLGetLastErrorMsg())});
  }
  return pixels;
}

/// Metres in the unit of a raster's heights.
double HeightUnit_m(const std::filesystem::path& file, GDALRasterBand* band,
                    const OGRSpatialReference* system) {
  constexpr double kFoot_m = 0.3048, kSurveyFoot_m = 1200.0 / 3937;
  static const std::map<std::string, double> known_m = {{"m", 1},
                                                        {"metre", 1},
                                                        {"meter", 1},
                                                        {"metres", 1},
                                                        {"meters", 1},
                                                        {"dm", 0.1},
                                                        {"cm", 0.01},
                                                        {"mm", 0.001},
                                                        {"ft", kFoot_m},
                                                        {"foot", kFoot_m},
                                                        {"feet", kFoot_m},
                                                        {"us survey foot", kSurveyFoot_m},
                                                        {"us-ft", kSurveyFoot_m},
                                                        {"ftus", kSurveyFoot_m},
                                                        {"foot_us", kSurveyFoot_m}};
  std::string unit = band->GetUnitType();
  if (!unit.empty()) {
    const auto found = known_m.find(LowerCase(unit));
    if (found != known_m.end()) return found->second;
    Refuse(file, {FaultKind::kUnsupported,
                  fmt::format("its heights are in '{}', need metres or feet; name their unit with "
                              "gdal_edit.py -units, or convert them with gdal_calc.py",
                              band->GetUnitType())});
  }
  if (system && system->GetAttrNode("VERT_CS")) return system->GetTargetLinearUnits("VERT_CS");
  if (system && system->IsProjected() && system->GetLinearUnits() != 1.0) {
    Refuse(file, {FaultKind::kUnsupported,
                  fmt::format("its map has a unit of {:.4f} m, and the unit of its heights is not "
                              "named; name it with gdal_edit.py -units m, ft or us-ft",
                              system->GetLinearUnits())});
  }
  return 1;
}

/// Refuses pixels of one number that is far from all others: no height, which no tag says.
///
/// Model   the number lies farther from the others than they from each other, and so much below or
///         above them that no wall or tower is as high.
void RequireMarkedGaps(const std::filesystem::path& file, const std::vector<double>& height_m,
                       const std::function<double(double)>& stored) {
  constexpr double kDeepestWall_m = 50, kTallestTower_m = 1000;
  double least_m = std::numeric_limits<double>::max(), most_m = -least_m;
  for (const double z_m : height_m) {  // comparisons with NaN are false
    if (z_m < least_m) least_m = z_m;
    if (z_m > most_m) most_m = z_m;
  }
  // A gap between heights that is wider than both sides of it contains the middle.
  const double middle_m = 0.5 * least_m + 0.5 * most_m;
  double below_m = least_m, above_m = most_m;
  std::int64_t low = 0, high = 0;
  for (const double z_m : height_m) {
    if (z_m <= middle_m) below_m = std::max(below_m, z_m), ++low;
    if (z_m > middle_m) above_m = std::min(above_m, z_m), ++high;
  }
  if (high == 0) return;
  const double gap_m = above_m - below_m;
  const bool is_pit = below_m == least_m && gap_m > std::max(kDeepestWall_m, most_m - above_m);
  const bool is_peak = above_m == most_m && gap_m > std::max(kTallestTower_m, below_m - least_m);
  if (!is_pit && !is_peak) return;
  const bool tell_pit = is_pit && (!is_peak || low <= high);
  Refuse(file,
         {FaultKind::kUnsupported,
          fmt::format("{} of {} pixels have a height of {:g} m, {:g} m {} all others: no "
                      "height, without the tag that says so? tag it: gdal_translate -a_nodata "
                      "{} IN OUT",
                      tell_pit ? low : high, height_m.size(), tell_pit ? below_m : above_m, gap_m,
                      tell_pit ? "below" : "above", stored(tell_pit ? below_m : above_m))});
}

/// Refuses heights beyond the earth's land, and steps that no ground has.
void RequireHeightsOfTheEarth(const std::filesystem::path& file,
                              const std::vector<double>& height_m, int nx) {
  constexpr double kHighest_m = 20'000, kSteepest_m = 1000;
  for (std::size_t k = 0; k < height_m.size(); ++k) {
    if (std::abs(height_m[k]) > kHighest_m) {
      Refuse(file,
             {FaultKind::kUnsupported,
              fmt::format("a height of {:g} m found, and no ground is higher or lower than {} "
                          "m; name their unit with gdal_edit.py -units, or their scale with "
                          "-scale",
                          height_m[k], kHighest_m)});
    }
    const auto width = static_cast<std::size_t>(nx);
    for (const std::size_t before : {k % width > 0 ? k - 1 : k, k >= width ? k - width : k}) {
      const double step_m = std::abs(height_m[k] - height_m[before]);
      if (step_m <= kSteepest_m || std::isnan(step_m)) continue;
      Refuse(file,
             {FaultKind::kUnsupported,
              fmt::format("two pixels beside each other have heights of {:g} and {:g} m: heights "
                          "mixed with no-data values? mark these before you resample: "
                          "gdal_translate -a_nodata",
                          height_m[before], height_m[k])});
    }
  }
}

}  // namespace

QuietGdal::QuietGdal() {
  static const bool registered = [] {
    GDALAllRegister();
    return true;
  }();
  (void)registered;
  CPLPushErrorHandler(CPLQuietErrorHandler);
}

void Refuse(const std::filesystem::path& file, const InputFault& fault) {
  throw InputError(file.string(), fault);
}

RasterFile OpenRaster(const std::filesystem::path& file, std::string_view content) {
  RasterFile raster(static_cast<GDALDataset*>(GDALOpen(file.c_str(), GA_ReadOnly)), &GDALClose);
  if (!raster) {
    Refuse(file, {FaultKind::kUnreadable,
                  fmt::format("not readable as a GeoTIFF ({}); give a one-band {}",
                              CPLGetLastErrorMsg(), content)});
  }
  if (raster->GetRasterCount() != 1) {
    Refuse(file, {FaultKind::kMistyped, fmt::format("{} bands found, need a one-band {}",
                                                    raster->GetRasterCount(), content)});
  }
  return raster;
}

std::vector<std::filesystem::path> FilesOf(GDALDataset* raster) {
  char** names = raster->GetFileList();
  const std::vector<std::filesystem::path> files(names, names + CSLCount(names));
  CSLDestroy(names);
  return files;
}

RasterFrame ReadFrame(const std::filesystem::path& file, GDALDataset* raster) {
  RasterFrame frame;
  const OGRSpatialReference* projection = raster->GetSpatialRef();
  if (!projection || raster->GetGeoTransform(frame.affine.data()) != CE_None) {
    Refuse(file, {FaultKind::kMissing,
                  "has no projection or no geotransform; add them with gdal_translate -a_srs "
                  "and -a_ullr"});
  }
  const std::array<double, 6>& affine = frame.affine;
  if (affine[2] != 0 || affine[4] != 0 || affine[1] <= 0 || affine[5] >= 0) {
    Refuse(file,
           {FaultKind::kUnsupported, "is rotated or not north-up; warp it with gdalwarp first"});
  }
  frame.nx = raster->GetRasterXSize();
  frame.ny = raster->GetRasterYSize();
  if (frame.nx < 2 || frame.ny < 2) {
    Refuse(file, {FaultKind::kOutOfRange,
                  fmt::format("{} x {} pixels found, need at least 2 x 2", frame.nx, frame.ny)});
  }
  if (static_cast<double>(frame.nx) * frame.ny > kMostPixels) {
    Refuse(file, {FaultKind::kOutOfRange,
                  fmt::format("{} x {} pixels found, need at most {}; make them larger with "
                              "gdalwarp -tr, or cut out the site with gdalwarp -te",
                              frame.nx, frame.ny, kMostPixels)});
  }
  frame.projection = *projection;
  frame.projection.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return frame;
}

std::vector<double> ReadBand(const std::filesystem::path& file, GDALDataset* raster) {
  GDALRasterBand* band = raster->GetRasterBand(1);
  std::vector<double> values = ReadStored<double>(file, band, GDT_Float64);
  const BandScaling scaling(band);
  for (double& value : values) value = scaling.Value(value);
  return values;
}

std::vector<double> ReadHeights(const std::filesystem::path& file, GDALDataset* raster) {
  GDALRasterBand* band = raster->GetRasterBand(1);
  const double unit_m = HeightUnit_m(file, band, raster->GetSpatialRef());
  std::vector<double> height_m = ReadBand(file, raster);
  for (double& z_m : height_m) z_m = std::isfinite(z_m) ? unit_m * z_m : kNoHeight;
  if ((band->GetMaskFlags() & GMF_ALL_VALID) == 0) {
    const auto valid = ReadStored<std::uint8_t>(file, band->GetMaskBand(), GDT_Byte);
    for (std::size_t k = 0; k < valid.size(); ++k) {
      if (valid[k] == 0) height_m[k] = kNoHeight;
    }
  }
  const auto stored = [&](double z_m) { return BandScaling(band).Stored(z_m / unit_m); };
  RequireMarkedGaps(file, height_m, stored);
  RequireHeightsOfTheEarth(file, height_m, band->GetXSize());
  return height_m;
}

OGRSpatialReference SitePlane(const SiteOrigin& origin) {
  OGRSpatialReference plane;
  plane.SetProjCS("Site plane");
  plane.SetWellKnownGeogCS("WGS84");
  plane.SetTM(origin.lat_deg, origin.lon_deg, 1.0, 0.0, 0.0);
  plane.SetLinearUnits(SRS_UL_METER, 1.0);
  return plane;
}

std::string WktOf(const OGRSpatialReference& system) {
  char* text = nullptr;
  system.exportToWkt(&text);
  std::string wkt = text ? text : "";
  CPLFree(text);
  return wkt;
}

SiteOrigin MiddleOf(const std::filesystem::path& file, const RasterFrame& frame) {
  OGRSpatialReference wgs84;
  wgs84.SetWellKnownGeogCS("WGS84");
  wgs84.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  const Vec2 middle = frame.PlaceOf(0.5 * (frame.nx - 1), 0.5 * (frame.ny - 1));
  std::vector<double> lon_deg = {middle.x()}, lat_deg = {middle.y()};
  Conversion(file, frame.projection, wgs84).Apply(&lon_deg, &lat_deg);
  return {lat_deg[0], lon_deg[0], 0};
}

Vec2 PixelSize_m(const std::filesystem::path& file, const RasterFrame& frame,
                 const OGRSpatialReference& plane) {
  const double i = 0.5 * (frame.nx - 1), j = 0.5 * (frame.ny - 1);
  std::vector<double> x, y;
  for (const Vec2& place : {frame.PlaceOf(i - 0.5, j), frame.PlaceOf(i + 0.5, j),
                            frame.PlaceOf(i, j - 0.5), frame.PlaceOf(i, j + 0.5)}) {
    x.push_back(place.x());
    y.push_back(place.y());
  }
  Conversion(file, frame.projection, plane).Apply(&x, &y);
  return {std::hypot(x[1] - x[0], y[1] - y[0]), std::hypot(x[3] - x[2], y[3] - y[2])};
}

Conversion::Conversion(const std::filesystem::path& file, const OGRSpatialReference& from,
                       const OGRSpatialReference& to)
    : file_(file),
      transformation_(OGRCreateCoordinateTransformation(&from, &to),
                      &OGRCoordinateTransformation::DestroyCT) {}

void Conversion::Apply(std::vector<double>* x, std::vector<double>* y) const {
  if (!transformation_ ||
      !transformation_->Transform(static_cast<int>(x->size()), x->data(), y->data())) {
    Refuse(file_,
           {FaultKind::kUnsupported,
            "its reference system cannot be converted to that of the site (WGS 84, near by); "
            "reproject it with gdalwarp"});
  }
}

EllipsoidDrop::EllipsoidDrop(double lat_deg) {
  constexpr double kSemiMajor_m = 6378137.0, kFlattening = 1 / 298.257223563;
  constexpr double kE2 = kFlattening * (2 - kFlattening);
  const double s = std::sin(lat_deg * kDeg);
  const double w = 1 - kE2 * s * s;
  normal_m_ = kSemiMajor_m / std::sqrt(w);
  meridian_m_ = kSemiMajor_m * (1 - kE2) / (w * std::sqrt(w));
}

}  // namespace tera

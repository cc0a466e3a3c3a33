#include "soil/site/georaster.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

#include "core/config/spelling.h"
#include "core/error.h"
#include "core/units.h"

namespace tera {
namespace {

constexpr double kMostPixels = 2.5e7;  ///< limit for files that are read; needs 600 MB
constexpr double kNoHeight = std::numeric_limits<double>::quiet_NaN();

/// Numbers of a band, converted by GDAL to `type`, which must match T. Rows from the south.
template <typename T>
std::vector<T> ReadStored(const std::filesystem::path& file, GDALRasterBand* band,
                          GDALDataType type) {
  const int nx = band->GetXSize(), ny = band->GetYSize();
  std::vector<T> pixels(static_cast<std::size_t>(nx) * ny);
  // The first row of the file is the northernmost one, so the rows are stored backwards.
  T* last_row = pixels.data() + static_cast<std::size_t>(ny - 1) * nx;
  const GSpacing line = -static_cast<GSpacing>(nx) * static_cast<GSpacing>(sizeof(T));
  if (band->RasterIO(GF_Read, 0, 0, nx, ny, last_row, nx, ny, type, 0, line) != CE_None) {
    Refuse(file, {FaultKind::kMalformed,
                  fmt::format("its pixels cannot be read ({}); the file may be truncated",
                              CPLGetLastErrorMsg())});
  }
  return pixels;
}

/// Length in metres of the unit of a raster's heights.
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

/// True if files commonly use a stored number for a missing height.
bool StandsForNoHeight(double stored, GDALRasterBand* band) {
  constexpr std::array kNumbers = {-999.0,   -9999.0, -10000.0, -32767.0, -32768.0,
                                   -99999.0, 9999.0,  32767.0,  65535.0,  99999.0};
  constexpr double kNoInteger = 1e9, kMostOfBytes = 255;
  if (stored == 0) {
    // Zero is a valid height if the file marks another number as no-data.
    int marks = 0;
    band->GetNoDataValue(&marks);
    return marks == 0;
  }
  return std::abs(stored) > kNoInteger ||
         std::find(kNumbers.begin(), kNumbers.end(), stored) != kNumbers.end() ||
         (stored == kMostOfBytes && band->GetRasterDataType() == GDT_Byte);
}

/// An extreme height, the number of its pixels, and the gap to the next height.
struct Outermost {
  double height_m = 0, gap_m = 0;
  std::int64_t pixels = 0;
};

/// The lowest height for sign 1, the highest for sign -1.
Outermost LowestOf(const std::vector<double>& height_m, double sign) {
  constexpr double kNone = std::numeric_limits<double>::max();
  double least_m = kNone, next_m = kNone;
  std::int64_t pixels = 0;
  for (const double z_m : height_m) {  // comparisons with NaN are false
    const double signed_m = sign * z_m;
    if (signed_m < least_m) {
      next_m = least_m;
      least_m = signed_m;
      pixels = 0;
    } else if (signed_m > least_m && signed_m < next_m) {
      next_m = signed_m;
    }
    if (signed_m == least_m) ++pixels;
  }
  return {sign * least_m, next_m < kNone ? next_m - least_m : 0, pixels};
}

/// The widest gap between successive sorted heights, without the height `out_m`.
double WidestGap_m(std::vector<double> height_m, double out_m) {
  std::erase_if(height_m, [&](double z_m) { return std::isnan(z_m) || z_m == out_m; });
  std::sort(height_m.begin(), height_m.end());
  double widest_m = 0;
  for (std::size_t k = 1; k < height_m.size(); ++k) {
    widest_m = std::max(widest_m, height_m[k] - height_m[k - 1]);
  }
  return widest_m;
}

/// Refuses unmarked pixels that stand for a missing height.
///
/// Model   The candidates are the lowest and the highest height. A number that files commonly use
///         for a missing height is refused if its gap to the next height is large. The gap must
///         exceed the height of a wall and all other gaps. Any other number is refused if its gap
///         exceeds the span of all other heights and the height of a tower.
void RequireMarkedGaps(const std::filesystem::path& file, GDALRasterBand* band,
                       const std::vector<double>& height_m, double unit_m) {
  constexpr double kHighestWall_m = 50, kHighestCliffOverSea_m = 100, kTallestTower_m = 1000;
  const Outermost low = LowestOf(height_m, 1), high = LowestOf(height_m, -1);
  const double whole_m = high.height_m - low.height_m;
  const auto stored = [&](double z_m) { return BandScaling(band).Stored(z_m / unit_m); };
  const auto is_no_height = [&](const Outermost& of) {
    if (of.gap_m > std::max(kTallestTower_m, 0.5 * whole_m)) return true;
    const double number = stored(of.height_m);
    return of.gap_m > (number == 0 ? kHighestCliffOverSea_m : kHighestWall_m) &&
           StandsForNoHeight(number, band) && of.gap_m > WidestGap_m(height_m, of.height_m);
  };
  // The candidate with a common no-data number first, else the rarer one.
  const bool high_stands = StandsForNoHeight(stored(high.height_m), band),
             low_stands = StandsForNoHeight(stored(low.height_m), band);
  const bool is_high_first = high_stands != low_stands ? high_stands : high.pixels < low.pixels;
  const Outermost &first = is_high_first ? high : low, &second = is_high_first ? low : high;
  const bool is_first = is_no_height(first);
  if (!is_first && !is_no_height(second)) return;
  const Outermost& found = is_first ? first : second;
  const double number = stored(found.height_m);
  Refuse(file,
         {FaultKind::kUnsupported,
          fmt::format("{} of {} pixels have a height of {:g} m, {:g} m {} all others: no "
                      "height, without the tag that says so? tag it: gdal_translate -a_nodata "
                      "{} IN OUT{}",
                      found.pixels, height_m.size(), found.height_m, found.gap_m,
                      &found == &low ? "below" : "above", number,
                      number == 0 ? "; where it is one, tag a number that no pixel has" : "")});
}

/// Refuses heights outside those of the earth, and steps steeper than any ground.
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
  RequireMarkedGaps(file, band, height_m, unit_m);
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
  OGRSpatialReference wgs84;
  wgs84.SetWellKnownGeogCS("WGS84");
  const double semi_major_m = wgs84.GetSemiMajor(), flattening = 1 / wgs84.GetInvFlattening();
  const double e2 = flattening * (2 - flattening);
  const double s = std::sin(lat_deg * kDeg);
  const double w = 1 - e2 * s * s;
  normal_m_ = semi_major_m / std::sqrt(w);
  meridian_m_ = semi_major_m * (1 - e2) / (w * std::sqrt(w));
}

}  // namespace tera

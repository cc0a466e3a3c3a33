#include "soil/site/survey_raster.h"

#include <fmt/format.h>

#include <cmath>

#include "core/check.h"
#include "core/error.h"
#include "soil/site/file_in_place.h"
#include "soil/site/write_raster.h"

namespace tera {
namespace {

template <typename T>
void Write(const std::filesystem::path& file, const SquareRaster<T>& raster,
           const MapReference& map) {
  TERA_CHECK(raster.values.size() == static_cast<std::size_t>(raster.nx) * raster.ny,
             raster.values.size());
  const QuietGdal quiet;
  OGRSpatialReference projection;
  TERA_CHECK(projection.importFromWkt(map.wkt.c_str()) == OGRERR_NONE, map.wkt);
  projection.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  PutInPlace(file, [&](const std::filesystem::path& part) -> std::optional<std::string> {
    if (WriteSquares(part, raster, projection)) return std::nullopt;
    return CPLGetLastErrorMsg();
  });
}

}  // namespace

SurveyRaster ReadSurveyRaster(const std::filesystem::path& file) {
  const QuietGdal quiet;
  const RasterFile raster = OpenRaster(file, "elevation raster, heights in metres");
  const RasterFrame frame = ReadFrame(file, raster.get());
  const std::vector<double> height_m = ReadHeights(file, raster.get());
  SurveyRaster survey;
  OGRSpatialReference plane = frame.projection;
  const char* vertical = plane.GetAttrValue("VERT_CS");
  const std::string counted_from = vertical ? vertical : "";
  plane.StripVertical();  // its unit is already applied
  const auto map = ReadMapReference(file.string(), WktOf(plane));
  if (!map)
    Refuse(file, {FaultKind::kUnsupported,
                  "its reference system is a local one; give it one with gdal_edit -a_srs"});
  survey.map = *map;
  survey.map.vertical = counted_from;
  survey.pixel_m = Vec2(frame.affine[1], -frame.affine[5]);
  for (int j = 0; j < frame.ny; ++j) {
    for (int i = 0; i < frame.nx; ++i) {
      const double z_m = height_m[static_cast<std::size_t>(j) * frame.nx + i];
      if (std::isnan(z_m)) {
        ++survey.gaps;
        continue;
      }
      const Vec2 place = frame.PlaceOf(i, j);
      survey.p_m.emplace_back(place.x(), place.y(), z_m);
    }
  }
  if (survey.p_m.empty()) {
    Refuse(file, {FaultKind::kMissing,
                  fmt::format("none of its {} pixels has a height; need an elevation raster",
                              survey.gaps)});
  }
  return survey;
}

void WriteHeights(const std::filesystem::path& file, const MapSquares& squares,
                  const std::vector<float>& height_m, const MapReference& map) {
  Write<float>(file,
               {squares.low_m, squares.square_m, squares.nx, squares.ny, height_m, "m", "height",
                std::nullopt},
               map);
}

void WriteClasses(const std::filesystem::path& file, const MapSquares& squares,
                  const std::vector<std::uint8_t>& values, const std::string& description,
                  const MapReference& map) {
  Write<std::uint8_t>(file,
                      {squares.low_m, squares.square_m, squares.nx, squares.ny, values, "",
                       description, std::nullopt},
                      map);
}

}  // namespace tera

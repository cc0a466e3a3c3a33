#include "survey/points/read_survey.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "core/error.h"
#include "dataset/import/cloud/read_point_cloud.h"
#include "dataset/import/foreign_file.h"
#include "soil/site/survey_raster.h"

namespace tera {
namespace {

std::string EndingOf(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

bool IsRaster(const std::filesystem::path& file) {
  const std::string ending = EndingOf(file);
  for (const char* other : {".pcd", ".ply", ".las", ".laz"}) {
    if (ending == other) return false;
  }
  if (ending == ".tif" || ending == ".tiff") return true;
  RefuseForeignFile(file, "a survey as .pcd, .ply, .las or .tif");
  throw InputError(
      fmt::format("{}: '{}' is no ending of a survey that is known; need .pcd, .ply, "
                  ".las or .tif",
                  file.string(), ending));
}

Survey ReadRaster(const std::filesystem::path& file) {
  SurveyRaster raster = ReadSurveyRaster(file);
  return {std::move(raster.p_m), raster.map, raster.gaps, raster.pixel_m};
}

Survey ReadCloud(const std::filesystem::path& file) {
  PointCloud cloud = ReadPointCloud(file);
  Survey survey;
  survey.p_m = std::move(cloud.p_m);
  survey.left_out = cloud.without_place + cloud.marked;
  if (!cloud.map.empty()) survey.map = ReadMapReference(file.string(), cloud.map);
  return survey;
}

}  // namespace

Survey ReadSurvey(const std::filesystem::path& file, const std::string& map) {
  Survey survey = IsRaster(file) ? ReadRaster(file) : ReadCloud(file);
  if (map.empty()) return survey;
  if (survey.map) {
    throw InputError(
        fmt::format("{}: is in '{}' already; leave out --map", file.string(), survey.map->name));
  }
  survey.map = ReadMapReference("--map", map);
  if (!survey.map) throw InputError("--map: is a local system; need one of the earth, EPSG:n");
  return survey;
}

}  // namespace tera

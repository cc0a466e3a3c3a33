#include "survey/points/read_survey.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <string_view>

#include "core/config/spelling.h"
#include "core/error.h"
#include "dataset/import/cloud/read_point_cloud.h"
#include "dataset/import/foreign_file.h"
#include "soil/site/survey_raster.h"
#include "survey/points/coarse_steps.h"

namespace tera {
namespace {

/// Advice on converting a text file of points or an unsupported raster, in the form "; ...".
std::string RemedyFor(const std::filesystem::path& file, const std::string& ending) {
  const auto is_of = [&](std::initializer_list<std::string_view> endings) {
    return std::find(endings.begin(), endings.end(), ending) != endings.end();
  };
  const std::string name = file.stem().string();
  if (is_of({".xyz", ".txt", ".csv", ".pts", ".xyb", ".neu"})) {
    return fmt::format(
        "; points as text become LAS by pdal translate -r readers.text "
        "--readers.text.header=\"X Y Z\" --readers.text.separator=\" \" "
        "--writers.las.scale_x=0.001 --writers.las.scale_y=0.001 --writers.las.scale_z=0.001 {} "
        "{}.las",
        file.string(), name);
  }
  if (is_of({".asc", ".dem", ".hgt", ".img", ".bil", ".flt", ".vrt", ".grd", ".nc"})) {
    return fmt::format("; a raster becomes GeoTIFF by gdal_translate {} {}.tif", file.string(),
                       name);
  }
  return "";
}

bool IsRaster(const std::filesystem::path& file) {
  const std::string ending = LowerCase(file.extension().string());
  for (const char* other : {".pcd", ".ply", ".las", ".laz"}) {
    if (ending == other) return false;
  }
  if (ending == ".tif" || ending == ".tiff") return true;
  RefuseForeignFile(file, "a survey as .pcd, .ply, .las or .tif");
  throw InputError(
      file.string(),
      {FaultKind::kUnsupported,
       fmt::format("'{}' is an unknown extension of a survey; need .pcd, .ply, .las or .tif{}",
                   ending, RemedyFor(file, ending))});
}

Survey ReadRaster(const std::filesystem::path& file) {
  SurveyRaster raster = ReadSurveyRaster(file);
  return {std::move(raster.p_m), raster.map, raster.gaps, raster.pixel_m, {}};
}

/// A point that stands for the whole survey.
Vec2 SomePlace(const std::vector<Vec3>& p_m) { return p_m[p_m.size() / 2].head<2>(); }

/// The coordinate reference system named in the file. If the caller names one, a system in the file
/// that is unreadable or belongs to another area is ignored.
std::optional<MapReference> OwnMap(const std::filesystem::path& file, const PointCloud& cloud,
                                   const SurveyReading& how, std::vector<std::string>* warnings) {
  if (cloud.map.empty()) return std::nullopt;
  try {
    std::optional<MapReference> map = ReadMapReference(file.string(), cloud.map);
    if (map) RequireOnMap(file.string(), *map, SomePlace(cloud.p_m));
    return map;
  } catch (const InputError& fault) {
    if (how.map.empty() && !how.is_local) {
      const InputFault& first = fault.faults().front();
      throw InputError(
          first.place,
          {first.kind, first.finding + " (tera site accepts --map or --local instead)"});
    }
    warnings->push_back(fmt::format("{}; {} counts", fault.what(),
                                    how.is_local ? std::string("--local") : how.map));
    return std::nullopt;
  }
}

void RequireFineSteps(const std::filesystem::path& file, const PointCloud& cloud,
                      const SurveyReading& how, std::vector<std::string>* warnings) {
  const auto found = FindCoarseSteps(cloud);
  if (!found) return;
  const std::string finding =
      fmt::format("{} has steps of {:g} m: {}", found->axis, found->step_m, found->cause);
  if (found->step_m > how.coarsest_step_m) {
    throw InputError(
        file.string(),
        {FaultKind::kOutOfRange, fmt::format("{} (for a site, --cell of {:g} or more accepts them)",
                                             finding, found->step_m)});
  }
  warnings->push_back(fmt::format("{}: {}", file.string(), finding));
}

Survey ReadCloud(const std::filesystem::path& file, const SurveyReading& how) {
  PointCloud cloud = ReadPointCloud(file);
  Survey survey;
  RequireFineSteps(file, cloud, how, &survey.warnings);
  survey.map = OwnMap(file, cloud, how, &survey.warnings);
  survey.p_m = std::move(cloud.p_m);
  survey.left_out = cloud.without_place + cloud.marked;
  return survey;
}

}  // namespace

Survey ReadSurvey(const std::filesystem::path& file, const SurveyReading& how) {
  Survey survey = IsRaster(file) ? ReadRaster(file) : ReadCloud(file, how);
  if (how.map.empty()) return survey;
  if (survey.map) {
    throw InputError(file.string(),
                     {FaultKind::kInconsistent,
                      fmt::format("is already in '{}'; remove --map", survey.map->name)});
  }
  survey.map = ReadMapReference("--map", how.map);
  if (!survey.map) {
    throw InputError("--map", {FaultKind::kUnsupported,
                               "is a local system; need a system of the Earth, EPSG:n"});
  }
  RequireOnMap("--map", *survey.map, SomePlace(survey.p_m));
  return survey;
}

}  // namespace tera

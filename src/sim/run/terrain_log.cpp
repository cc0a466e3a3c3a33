#include "sim/run/terrain_log.h"

#include <fmt/format.h>

#include "soil/site/voxel_file.h"

namespace tera {
namespace {

constexpr char kStart[] = "start";

bool IsChange(GroundRaster raster) {
  return raster == GroundRaster::kChange || raster == GroundRaster::kMassChange;
}

}  // namespace

TerrainLog::TerrainLog(const Scenario& scenario, const Soil& ground, DatasetWriter* writer)
    : scenario_(scenario), ground_(ground), writer_(writer) {
  WriteAll(kStart);
}

void TerrainLog::Write(TimeNs t_ns) {
  const auto& period_ns = scenario_.record.period_ns;
  if (!period_ns || t_ns < next_ * *period_ns) return;
  WriteAll(std::to_string(t_ns));
  next_ = t_ns / *period_ns + 1;
}

void TerrainLog::Finish() { WriteAll("end"); }

void TerrainLog::WriteAll(const std::string& when) {
  const auto path = [&](std::string_view name, const char* ending) {
    return writer_->PathFor(fmt::format("truth/terrain/{}_{}.{}", name, when, ending));
  };
  for (const GroundRaster raster : scenario_.record.rasters) {
    if (when == kStart && IsChange(raster)) continue;  // no change at the start
    ground_.WriteGeoTiff(path(NameOf(raster), "tif"), raster, scenario_.origin,
                         scenario_.record.columns_per_pixel);
  }
  for (const TerrainRecord::Voxels& voxels : scenario_.record.voxels) {
    WriteVoxels(path(voxels.name, "vti"), ground_.Voxels(voxels.box), ground_.soils());
  }
}

}  // namespace tera

#include "dataset/export/packets/lidar_pattern.h"

#include <fmt/format.h>

#include <cmath>

#include "core/config/config.h"
#include "core/config/config_faults.h"
#include "core/error.h"
#include "core/units.h"

namespace tera {
namespace {

constexpr std::size_t kMostBeams = 1024;
constexpr double kMostColumns = 65536;

/// A number for each ring; zeros without the key.
std::vector<double> ReadRings(const ConfigMap& model, const char* key, const Range& range,
                              std::size_t rings) {
  if (!model.Has(key)) return std::vector<double>(rings, 0.0);
  std::vector<double> values = model.Numbers(key, range, 1, kMostBeams);
  if (values.size() != rings) {
    model.Fault(key, fmt::format("has {} numbers, need {} as elevation_deg", values.size(), rings));
    values.resize(rings);
  }
  return values;
}

}  // namespace

TimeNs LidarPattern::ColumnStart(int column) const {
  return std::llround(1e9 * column / (columns * rate_hz));
}

Vec3 LidarPattern::Direction(int column, std::size_t ring) const {
  const double turns = column / static_cast<double>(columns) + rate_hz * 1e-6 * firing_us[ring];
  const double azimuth =
      kPi + (is_clockwise ? -2 : 2) * kPi * turns + azimuth_offset_deg[ring] * kDeg;
  const double elevation = elevation_deg[ring] * kDeg;
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

LidarPattern ReadLidarPattern(const std::filesystem::path& sensor_folder) {
  const std::filesystem::path file = sensor_folder / "sensor.yaml";
  const Config config = Config::FromFile(file);
  const ConfigMap root = config.root();
  LidarPattern pattern;
  pattern.place = file.string() + ": model";
  const auto model = root.OptionalMap("model");
  if (!model || !model->Has("elevation_deg") || !model->Has("columns") || !root.Has("rate_hz")) {
    throw InputError(pattern.place,
                     {FaultKind::kUnsupported,
                      "states no rings and columns of a turn; need rate_hz, elevation_deg and "
                      "columns of a VLP-16, a VLP-32C or an Ouster; choose another lidar by "
                      "--lidar"});
  }
  pattern.rate_hz = root.Number("rate_hz", Positive("Hz"));
  pattern.columns = static_cast<int>(model->Integer("columns", Between(1, kMostColumns, "")));
  pattern.is_clockwise = model->Boolean("clockwise", true);
  pattern.elevation_deg = model->Numbers("elevation_deg", Between(-90, 90, "deg"), 1, kMostBeams);
  pattern.azimuth_offset_deg =
      ReadRings(*model, "azimuth_offset_deg", Between(-180, 180, "deg"), pattern.rings());
  pattern.firing_us = ReadRings(*model, "firing_offset_us", AtLeast(0, "us"), pattern.rings());
  if (const auto beam = model->OptionalMap("beam")) {
    pattern.returns = static_cast<int>(beam->Integer("returns", Between(1, 3, ""), 1));
    pattern.pick = beam->Choice("pick", {"strongest", "first", "last"}, "strongest");
  }
  // Other keys belong to other readers and are checked only after a fault in the requested ones.
  if (FaultCount(root) > 0) config.Finish();
  return pattern;
}

}  // namespace tera

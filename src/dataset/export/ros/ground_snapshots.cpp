#include "dataset/export/ros/ground_snapshots.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <system_error>
#include <utility>

#include "core/error.h"
#include "core/parse_number.h"
#include "dataset/ros/names.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

struct Layer {
  std::string_view raster;  ///< name in the file names of a recording
  std::string_view name;    ///< name in grid maps
};

constexpr std::array<Layer, 5> kLayers = {{{"height", kElevationLayer},
                                           {"change", "change"},
                                           {"mass_change", "mass_change"},
                                           {"density", "density"},
                                           {"soil_class", "soil_class"}}};

/// Time in a file name: "start", "end" or nanoseconds.
std::optional<TimeNs> TimeOf(std::string_view text, const Recording& recording) {
  if (text == "start") return 0;
  if (text == "end") return FromSeconds(recording.info().duration_s);
  return ParseNumber<TimeNs>(text);
}

/// Splits a file name such as "height_start" into layer and time; nullopt for other files.
std::optional<std::pair<std::string, TimeNs>> LayerAndTime(const std::string& stem,
                                                           const Recording& recording) {
  for (const Layer& layer : kLayers) {
    const std::string begin = std::string(layer.raster) + "_";
    if (!stem.starts_with(begin)) continue;
    const auto t_ns = TimeOf(std::string_view(stem).substr(begin.size()), recording);
    if (t_ns) return std::pair(std::string(layer.name), *t_ns);
  }
  return std::nullopt;
}

bool LieAlike(const GroundSquares& a, const GroundSquares& b) {
  return a.nx == b.nx && a.ny == b.ny && a.square_m == b.square_m && a.low_W_m == b.low_W_m;
}

}  // namespace

std::vector<GroundSnapshot> GroundSnapshotsOf(const Recording& recording) {
  const fs::path folder = recording.directory() / "truth/terrain";
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) return {};
  // Sorted by name, so the final state ("end") replaces a snapshot at the same time.
  std::map<std::string, fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".tif") files[entry.path().stem()] = entry.path();
  }
  std::map<TimeNs, GroundSnapshot> by_time;
  for (const auto& [stem, file] : files) {
    const auto found = LayerAndTime(stem, recording);
    if (!found) continue;
    GroundSnapshot& snapshot = by_time[found->second];
    snapshot.t_ns = found->second;
    snapshot.layers[found->first] = file;
  }
  std::vector<GroundSnapshot> snapshots;
  for (auto& [t_ns, snapshot] : by_time) snapshots.push_back(std::move(snapshot));
  return snapshots;
}

ros::GridMap GridMapOf(const GroundSnapshot& snapshot, TimeNs stamp_ns, const ReadGround& read) {
  ros::GridMap map;
  map.header = {stamp_ns, ros::kWorldFrame};
  std::optional<GroundSquares> first;
  for (const auto& [name, file] : snapshot.layers) {
    GroundSquares squares = read(file, name);
    if (!first) {
      map.resolution_m = squares.square_m;
      map.rows = static_cast<std::uint32_t>(squares.nx);
      map.columns = static_cast<std::uint32_t>(squares.ny);
      const Vec2 middle_m = squares.low_W_m + 0.5 * squares.square_m * Vec2(squares.nx, squares.ny);
      map.middle.translation() = Vec3(middle_m.x(), middle_m.y(), 0);
    } else if (!LieAlike(squares, *first)) {
      throw InputError(
          file.string(),
          fmt::format("its pixel grid differs from that of {}; need rasters of one recording",
                      snapshot.layers.begin()->second.string()));
    }
    // In a grid map, row index grows with decreasing x, column index with decreasing y, and data is
    // column-major. This equals the reversed order of row-major data that starts in the south-west.
    map.layers.push_back({name, {squares.values.rbegin(), squares.values.rend()}});
    squares.values.clear();
    if (!first) first = std::move(squares);
  }
  return map;
}

}  // namespace tera

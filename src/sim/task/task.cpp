#include "sim/task/task.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/polygon.h"
#include "core/units.h"

namespace tera {
namespace {

constexpr double kDeepest_m = 20, kWidest_m = 50;
constexpr double kFlattest_deg = 10;  ///< flatter sides are rejected
constexpr double kUpright_deg = 90;
constexpr double kFinest_m = 0.005, kCoarsest_m = 1;  ///< range of tolerances
constexpr double kLeastArea_m2 = 0.01;
constexpr double kRounding_m = 1e-6;  ///< for positions of columns
/// Smallest width in cells with which a floor surely contains columns, in any orientation.
constexpr double kNarrowest = 3;
/// Limit on the width of the sides, relative to their width on level ground.
constexpr double kRise = 2;

/// Reports a design of which a part is beyond the site, at `key`.
bool IsOnSite(const ConfigMap& config, std::string_view key, const Vec2& corner_W_m,
              double margin_m, const TerrainGrid& site) {
  const Vec2 low_m = site.origin_W_m;
  const Vec2 high_m(site.x_m(site.nx - 1), site.y_m(site.ny - 1));
  const Vec2 margin(margin_m, margin_m);
  if (((corner_W_m - margin).array() >= low_m.array()).all() &&
      ((corner_W_m + margin).array() <= high_m.array()).all()) {
    return true;
  }
  config.Fault(
      key, {FaultKind::kOutOfRange,
            fmt::format("the design reaches beyond the site: its corner ({:g}, {:g}) m "
                        "with {:.2f} m for the side; need x {:g} to {:g} m, y {:g} to {:g} "
                        "m, or a larger terrain",
                        corner_W_m.x(), corner_W_m.y(), margin_m, low_m.x(), high_m.x(), low_m.y(),
                        high_m.y())});
  return false;
}

double ReadDepth_m(const ConfigMap& config) {
  return config.Number("depth_m", {.min = 0, .max = kDeepest_m, .min_excluded = true, .unit = "m"});
}

double ReadSide_rad(const ConfigMap& config) {
  return config.Number("side_slope_deg", Between(kFlattest_deg, kUpright_deg, "deg"),
                       kUpright_deg) *
         kDeg;
}

double SideWidth_m(double depth_m, double side_rad) { return depth_m / std::tan(side_rad); }

bool ReadTrench(const ConfigMap& config, const TerrainSurface& ground, Task* task) {
  TrenchLine line;
  line.from_W_m = config.Vector2("from_m", Any("m"));
  line.to_W_m = config.Vector2("to_m", Any("m"));
  line.width_m =
      config.Number("width_m", {.min = 0, .max = kWidest_m, .min_excluded = true, .unit = "m"});
  line.depth_m = ReadDepth_m(config);
  DesignSurface& design = task->design;
  design.side_rad = ReadSide_rad(config);
  if (line.length_m() < ground.cell_m) {
    config.Fault("to_m",
                 "the trench ends where it begins; need two places at least a cell of the "
                 "terrain apart");
    return false;
  }
  const Vec2 along = line.Along(), half = 0.5 * line.width_m * Vec2(-along.y(), along.x());
  const double margin_m = SideWidth_m(line.depth_m, design.side_rad);
  bool on_site = true;
  for (const auto& [key, end] : {std::pair{"from_m", line.from_W_m}, {"to_m", line.to_W_m}}) {
    on_site = on_site && IsOnSite(config, key, end + half, margin_m, ground) &&
              IsOnSite(config, key, end - half, margin_m, ground);
  }
  design.corners_W_m = {line.from_W_m - half, line.to_W_m - half, line.to_W_m + half,
                        line.from_W_m + half};
  const auto floor_at = [&](const Vec2& end) {
    return ground.HeightAt(end.x(), end.y()) - line.depth_m;
  };
  design.at_W_m = line.from_W_m;
  design.floor_m = floor_at(line.from_W_m);
  design.grade = along * (floor_at(line.to_W_m) - design.floor_m) / line.length_m();
  task->side_m = kRise * margin_m;
  task->trench = line;
  return on_site;
}

bool ReadPit(const ConfigMap& config, const TerrainSurface& ground, Task* task) {
  DesignSurface& design = task->design;
  const double depth_m = ReadDepth_m(config);
  design.side_rad = ReadSide_rad(config);
  for (const std::vector<double>& row : config.NumberRows("corners_m", Any("m"), 2, 3)) {
    design.corners_W_m.emplace_back(row[0], row[1]);
  }
  if (design.corners_W_m.size() < 3) return false;
  if (FirstCrossing(design.corners_W_m) || AreaOf(design.corners_W_m) < kLeastArea_m2) {
    config.Fault("corners_m",
                 "the sides cross, or enclose no area; need the corners of the floor "
                 "in their order around it");
    return false;
  }
  const double margin_m = SideWidth_m(depth_m, design.side_rad);
  task->side_m = kRise * margin_m;
  double lowest_m = std::numeric_limits<double>::infinity();
  for (const Vec2& corner : design.corners_W_m) {
    if (!IsOnSite(config, "corners_m", corner, margin_m, ground)) {
      return false;
    }
    lowest_m = std::min(lowest_m, ground.HeightAt(corner.x(), corner.y()));
  }
  design.at_W_m = design.corners_W_m.front();
  design.floor_m = lowest_m - depth_m;
  return true;
}

/// Reports a floor without columns at `key`.
bool HasFloor(const ConfigMap& config, std::string_view key, const Task& task,
              const TerrainSurface& ground) {
  if (TaskColumns(task, ground).HasFloor()) return true;
  config.Fault(
      key, {FaultKind::kOutOfRange,
            fmt::format("no column of the terrain is on the floor, below the ground and half a "
                        "cell within its edge; need a floor of {:g} m or more in width and length, "
                        "or a terrain of smaller cells",
                        kNarrowest * ground.cell_m)});
  return false;
}

}  // namespace

std::optional<Task> ReadTask(const ConfigMap& config, const TerrainSurface& ground) {
  Task task;
  task.tolerance_m =
      config.Number("tolerance_m", Between(kFinest_m, kCoarsest_m, "m"), task.tolerance_m);
  const auto trench = config.OptionalMap("trench"), pit = config.OptionalMap("pit");
  if (trench.has_value() == pit.has_value()) {
    config.Fault(
        "", {trench ? FaultKind::kRepeated : FaultKind::kMissing, "need either a trench or a pit"});
    return std::nullopt;
  }
  const bool good =
      trench ? ReadTrench(*trench, ground, &task) && HasFloor(*trench, "width_m", task, ground)
             : ReadPit(*pit, ground, &task) && HasFloor(*pit, "corners_m", task, ground);
  if (!good) return std::nullopt;
  return task;
}

TaskColumns::TaskColumns(const Task& task, const TerrainSurface& before)
    : tolerance_m_(task.tolerance_m), cell_m_(before.cell_m) {
  Vec2 low_m = task.design.corners_W_m.front(), high_m = low_m;
  for (const Vec2& corner : task.design.corners_W_m) {
    low_m = low_m.cwiseMin(corner);
    high_m = high_m.cwiseMax(corner);
  }
  const auto column = [&](double place_m, double first_m, int count) {
    return std::clamp(static_cast<int>(std::lround((place_m - first_m) / cell_m_)), 0, count - 1);
  };
  const double side_m = task.side_m + cell_m_;
  const Vec2& origin_m = before.origin_W_m;
  const int i0 = column(low_m.x() - side_m, origin_m.x(), before.nx);
  const int i1 = column(high_m.x() + side_m, origin_m.x(), before.nx);
  const int j0 = column(low_m.y() - side_m, origin_m.y(), before.ny);
  const int j1 = column(high_m.y() + side_m, origin_m.y(), before.ny);
  for (int j = j0; j <= j1; ++j) {
    for (int i = i0; i <= i1; ++i) {
      const Vec2 xy_W_m(before.x_m(i), before.y_m(j));
      const std::optional<double> design_m = task.design.HeightAt(xy_W_m);
      if (!design_m || *design_m >= before.height_m(i, j)) continue;
      const bool floor = task.design.InsideBy_m(xy_W_m) >= 0.5 * cell_m_ - kRounding_m;
      columns_.push_back({i, j, *design_m, floor});
    }
  }
}

bool TaskColumns::HasFloor() const { return std::ranges::any_of(columns_, &Column::floor); }

TaskDeviation TaskColumns::Compare(const TerrainSurface& ground) const {
  TaskDeviation deviation;
  double squares_m2 = 0;
  int floor = 0, within = 0;
  for (const Column& column : columns_) {
    const double above_m = ground.height_m(column.i, column.j) - column.design_m;
    deviation.to_cut_m3 += std::max(above_m, 0.0) * cell_m_ * cell_m_;
    deviation.cut_beyond_m3 += std::max(-above_m, 0.0) * cell_m_ * cell_m_;
    if (!column.floor) continue;
    deviation.lowest_m = floor == 0 ? above_m : std::min(deviation.lowest_m, above_m);
    deviation.highest_m = floor == 0 ? above_m : std::max(deviation.highest_m, above_m);
    ++floor;
    if (std::abs(above_m) <= tolerance_m_) ++within;
    squares_m2 += above_m * above_m;
  }
  deviation.within = static_cast<double>(within) / floor;
  deviation.rms_m = std::sqrt(squares_m2 / floor);
  return deviation;
}

}  // namespace tera

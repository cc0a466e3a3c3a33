#include "soil/columns/old_ruts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tera {
namespace {

constexpr double kShoulder = 0.2;  // share of a rut's width, on each side
constexpr double kWidestRut_m = 3, kWidestGauge_m = 10;
constexpr double kFurthest_m = 1e5;

/// Position of a point relative to a path.
struct Beside {
  double left_m = std::numeric_limits<double>::infinity();
  Vec2 left = Vec2::UnitY();  ///< unit vector to the left of the path
};

Beside BesidePath(const std::vector<Vec2>& path_m, const Vec2& p_m) {
  double nearest_m2 = std::numeric_limits<double>::infinity();
  Beside beside;
  for (std::size_t k = 0; k + 1 < path_m.size(); ++k) {
    const Vec2 along_m = path_m[k + 1] - path_m[k], from_m = p_m - path_m[k];
    const double length_m2 = along_m.squaredNorm();
    if (length_m2 <= 0) continue;
    const double share = std::clamp(from_m.dot(along_m) / length_m2, 0.0, 1.0);
    const double m2 = (from_m - share * along_m).squaredNorm();
    if (m2 >= nearest_m2) continue;
    nearest_m2 = m2;
    beside.left = Vec2(-along_m.y(), along_m.x()).normalized();
    beside.left_m = std::copysign(std::sqrt(m2), beside.left.dot(from_m));
  }
  return beside;
}

/// Share of the full depth at a distance from the middle of a rut.
double ShareOfDepth(double from_middle_m, double width_m) {
  const double shoulder_m = kShoulder * width_m;
  return std::clamp((0.5 * width_m - from_middle_m) / shoulder_m, 0.0, 1.0);
}

void PressColumn(const RutPlan& ruts, int i, int j, Columns* ground) {
  const Vec2 p_m(ground->x_m(i), ground->y_m(j));
  const Beside at = BesidePath(ruts.path_W_m, p_m);
  const double middle_m = std::copysign(0.5 * ruts.size.gauge_m, at.left_m);
  const double share = ShareOfDepth(std::abs(at.left_m - middle_m), ruts.size.width_m);
  if (share <= 0) return;
  SpoilMix squeezed;
  ground->Press(ground->Touch(i, j), {share * ruts.depth_m, ruts.size.width_m}, &squeezed);
  if (squeezed.empty()) return;
  const double edge_m =
      std::copysign(0.5 * ruts.size.width_m + ground->cell_m(), at.left_m - middle_m);
  const Vec2 to_m = p_m + (middle_m + edge_m - at.left_m) * at.left;
  ground->DepositAt(ground->NearestI(to_m.x()), ground->NearestJ(to_m.y()), squeezed);
}

}  // namespace

RutSize ReadRutSize(const ConfigMap& config, double usual_gauge_m,
                    std::optional<double> usual_width_m) {
  const Range width = Between(0.05, kWidestRut_m, "m");
  const RutSize ruts{config.Number("gauge_m", Between(0, kWidestGauge_m, "m"), usual_gauge_m),
                     usual_width_m ? config.Number("width_m", width, *usual_width_m)
                                   : config.Number("width_m", width)};
  if (ruts.gauge_m > 0 && ruts.gauge_m < ruts.width_m) {
    config.Fault("gauge_m",
                 {FaultKind::kOutOfRange,
                  fmt::format("{} m lets two ruts of {} m lie over each other; need at least "
                              "their width, or 0 for one rut",
                              ruts.gauge_m, ruts.width_m)});
  }
  return ruts;
}

std::vector<RutPlan> ReadRuts(const ConfigMap& config) {
  std::vector<RutPlan> all;
  if (!config.Has("ruts")) return all;  // an absent key is not added to the resolved scenario
  for (const ConfigMap& item : config.List("ruts")) {
    RutPlan ruts;
    for (const auto& row :
         item.NumberRows("path_m", Between(-kFurthest_m, kFurthest_m, "m"), 2, 0)) {
      ruts.path_W_m.emplace_back(row[0], row[1]);
    }
    if (ruts.path_W_m.size() < 2) {
      item.Fault("path_m", {FaultKind::kOutOfRange,
                            fmt::format("{} points found, need at least 2, each [x, y] in m",
                                        ruts.path_W_m.size())});
    }
    ruts.size = ReadRutSize(item, 0, {});
    ruts.depth_m = item.Number("depth_m", Between(0, kDeepestRut_m, "m"));
    all.push_back(ruts);
  }
  return all;
}

void Press(const RutPlan& ruts, Columns* ground) {
  const double reach_m = 0.5 * (ruts.size.gauge_m + ruts.size.width_m);
  // Lists the columns in the boxes around the pieces of the path, each column once.
  std::vector<std::pair<int, int>> places;
  for (std::size_t p = 0; p + 1 < ruts.path_W_m.size(); ++p) {
    const Vec2 low_m = ruts.path_W_m[p].cwiseMin(ruts.path_W_m[p + 1]).array() - reach_m;
    const Vec2 high_m = ruts.path_W_m[p].cwiseMax(ruts.path_W_m[p + 1]).array() + reach_m;
    const int i0 = std::max(0, ground->NearestI(low_m.x()));
    const int i1 = std::min(ground->nx() - 1, ground->NearestI(high_m.x()));
    const int j0 = std::max(0, ground->NearestJ(low_m.y()));
    const int j1 = std::min(ground->ny() - 1, ground->NearestJ(high_m.y()));
    for (int j = j0; j <= j1; ++j) {
      for (int i = i0; i <= i1; ++i) places.emplace_back(j, i);
    }
  }
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  for (const auto& [j, i] : places) PressColumn(ruts, i, j, ground);
}

}  // namespace tera

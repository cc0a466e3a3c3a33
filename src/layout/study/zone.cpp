#include "layout/study/zone.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/config/plain_name.h"
#include "core/overloaded.h"
#include "core/polygon.h"
#include "core/random.h"
#include "core/units.h"

namespace tera {
namespace {

constexpr double kLongestZone_m =
    200;  ///< limit on every length of a zone; exceeds the range of every sensor

/// Smallest share of its bounding rectangle that an outline must fill. Points are drawn in that
/// rectangle, and most would be rejected below this share.
constexpr double kLeastFilled = 0.01, kPercent = 100;

/// Describes what is wrong with an outline, or returns an empty text.
std::string OutlineFault(const std::vector<Vec2>& corners_m) {
  if (corners_m.empty()) return "";  // the fault is already reported
  if (const auto sides = FirstCrossing(corners_m)) {
    return fmt::format("its sides {} and {} cross; name the corners in order around the region",
                       sides->first + 1, sides->second + 1);
  }
  Vec2 low_m = corners_m.front(), high_m = low_m;
  for (const Vec2& p : corners_m) {
    low_m = low_m.cwiseMin(p);
    high_m = high_m.cwiseMax(p);
  }
  const double around_m2 = (high_m - low_m).prod(), area_m2 = AreaOf(corners_m);
  if (area_m2 > 0 && area_m2 >= kLeastFilled * around_m2) return "";
  if (around_m2 <= 0 || area_m2 <= 0) {
    return "its corners lie on one line and enclose nothing; need corners around a region";
  }
  return fmt::format(
      "its corners enclose too little: {:.2g} m2, {:.2g} % of the rectangle around them; need at "
      "least {:g} %",
      area_m2, kPercent * area_m2 / around_m2, kPercent * kLeastFilled);
}

ZonePrism ReadPrism(const ConfigMap& config) {
  ZonePrism prism;
  for (const std::vector<double>& row : config.NumberRows("xy_m", Any("m"), 2, 3)) {
    prism.corners_m.emplace_back(row[0], row[1]);
  }
  const std::string fault = OutlineFault(prism.corners_m);
  if (!fault.empty()) {
    config.Fault("xy_m", fault);
    prism.corners_m.clear();
  }
  prism.low_m = config.Number("low_m", Any("m"), prism.low_m);
  prism.high_m = config.Number("high_m", Any("m"));
  if (prism.high_m <= prism.low_m) config.Fault("high_m", "need it above low_m");
  return prism;
}

/// Even-odd rule.
bool Contains(const std::vector<Vec2>& corners, const Vec2& p) {
  bool inside = false;
  for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
    const Vec2 &a = corners[i], &b = corners[j];
    if ((a.y() > p.y()) != (b.y() > p.y()) &&
        p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x()) {
      inside = !inside;
    }
  }
  return inside;
}

/// The bounding box of a shape, in Z.
struct Bounds {
  Vec3 low_m, high_m;
};

Bounds BoundsOf(const Zone& zone) {
  return std::visit(Overloaded{[](const ZoneBox& box) {
                                 return Bounds{-0.5 * box.size_m, 0.5 * box.size_m};
                               },
                               [](const ZoneCylinder& c) {
                                 return Bounds{Vec3(-c.radius_m, -c.radius_m, 0),
                                               Vec3(c.radius_m, c.radius_m, c.height_m)};
                               },
                               [](const ZonePrism& prism) {
                                 Bounds bounds{Vec3(0, 0, prism.low_m), Vec3(0, 0, prism.high_m)};
                                 bounds.low_m.head<2>() = bounds.high_m.head<2>() =
                                     prism.corners_m.front();
                                 for (const Vec2& p : prism.corners_m) {
                                   bounds.low_m.head<2>() = bounds.low_m.head<2>().cwiseMin(p);
                                   bounds.high_m.head<2>() = bounds.high_m.head<2>().cwiseMax(p);
                                 }
                                 return bounds;
                               }},
                    zone.shape);
}

bool IsInside(const Zone& zone, const Vec3& p_Z_m) {
  return std::visit(Overloaded{[](const ZoneBox&) { return true; },
                               [&](const ZoneCylinder& c) {
                                 return p_Z_m.head<2>().squaredNorm() <= c.radius_m * c.radius_m;
                               },
                               [&](const ZonePrism& prism) {
                                 return Contains(prism.corners_m, p_Z_m.head<2>());
                               }},
                    zone.shape);
}

/// About `wanted` cells of a box, as near to cubes as its thickness permits.
Eigen::Array3i CellsOf(const Vec3& extent_m, double wanted) {
  std::array<int, 3> axes = {0, 1, 2};  // the thinnest first
  std::sort(axes.begin(), axes.end(), [&](int a, int b) { return extent_m[a] < extent_m[b]; });
  Eigen::Array3i cells;
  double left_m3 = extent_m.prod();  // size over the remaining axes: a volume, an area, a length
  for (int a = 0; a < 3; ++a) {
    const double edge_m = std::pow(left_m3 / wanted, 1.0 / (3 - a));
    cells[axes[a]] = std::max(1, static_cast<int>(std::lround(extent_m[axes[a]] / edge_m)));
    left_m3 /= extent_m[axes[a]];
    wanted /= cells[axes[a]];
  }
  return cells;
}

}  // namespace

Zone ReadZone(const ConfigMap& config) {
  Zone zone;
  zone.name = config.Text("name");
  zone.place = config.Place("name");
  RequirePlainName(config, "name", zone.name);
  zone.frame = config.Text("frame", zone.frame);
  zone.level = config.Boolean("level", zone.level);
  zone.X_FZ = config.PoseXyzRpy();
  const Range length{.min = 0, .max = kLongestZone_m, .min_excluded = true, .unit = "m"};
  const int shapes = config.Has("box_m") + config.Has("cylinder") + config.Has("prism");
  if (shapes != 1) {
    config.Fault("",
                 "needs one shape: box_m: [LENGTH, WIDTH, HEIGHT], "
                 "cylinder: {radius_m, height_m} or prism: {xy_m, low_m, high_m}");
    return zone;
  }
  if (config.Has("box_m")) {
    zone.shape = ZoneBox{config.Vector3("box_m", length)};
  } else if (const auto cylinder = config.OptionalMap("cylinder")) {
    zone.shape =
        ZoneCylinder{cylinder->Number("radius_m", length), cylinder->Number("height_m", length)};
  } else {
    zone.shape = ReadPrism(config.Map("prism"));
    if (std::get<ZonePrism>(zone.shape).corners_m.empty()) zone.shape = ZoneBox{};
  }
  return zone;
}

double Volume_m3(const Zone& zone) {
  return std::visit(
      Overloaded{[](const ZoneBox& box) { return box.size_m.prod(); },
                 [](const ZoneCylinder& c) { return kPi * c.radius_m * c.radius_m * c.height_m; },
                 [](const ZonePrism& prism) {
                   return AreaOf(prism.corners_m) * (prism.high_m - prism.low_m);
                 }},
      zone.shape);
}

std::vector<Vec3> PointsIn(const Zone& zone, int count, std::uint64_t seed) {
  const Bounds bounds = BoundsOf(zone);
  const Vec3 extent_m = bounds.high_m - bounds.low_m;
  const Eigen::Array3i cells = CellsOf(extent_m, count * extent_m.prod() / Volume_m3(zone));
  const Stream stream(seed, "layout/zone/" + zone.name);
  std::vector<Vec3> points;
  std::uint64_t index = 0;
  for (int i = 0; i < cells[0]; ++i) {
    for (int j = 0; j < cells[1]; ++j) {
      for (int k = 0; k < cells[2]; ++k, ++index) {
        const Vec3 within(stream.Uniform(index, 0), stream.Uniform(index, 1),
                          stream.Uniform(index, 2));
        const Vec3 share = (Vec3(i, j, k) + within).cwiseQuotient(cells.matrix().cast<double>());
        const Vec3 p_m = bounds.low_m + share.cwiseProduct(extent_m);
        if (IsInside(zone, p_m)) points.push_back(p_m);
      }
    }
  }
  return points;
}

Pose Levelled(const Pose& X_WB) {
  const Vec3 x_W = X_WB.linear().col(0);
  return MakePose(X_WB.translation(), 0, 0, std::atan2(x_W.y(), x_W.x()));
}

}  // namespace tera

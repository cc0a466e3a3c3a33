#include "layout/sight/look.h"

#include <algorithm>

namespace tera {
namespace {

/// Whether the viewer can see a surface at this distance that returns the share `returned` of the
/// light.
bool IsInReach(const ViewField& field, double distance_m, double returned, bool ranges) {
  if (distance_m < field.nearest_m || distance_m > field.reach_m(returned)) return false;
  return !ranges || (distance_m >= field.min_distance_m && distance_m <= field.max_distance_m);
}

/// The view if nothing occludes the target.
Look Unhindered(const Viewer& viewer, const Target& target, const Asked& asked) {
  const ViewField& field = viewer.field;
  const Vec3 way_W_m = target.p_W_m - viewer.X_WS.translation();
  const double range_m = way_W_m.norm();
  if (range_m <= 0 || (asked.ranges && !field.ranges)) return {};
  const double cosine = target.normal_W ? -target.normal_W->dot(way_W_m) / range_m : 1;
  if (cosine <= 0) return {};
  const Vec3 p_S_m = viewer.X_WS.linear().transpose() * way_W_m;
  const double per_sr = field.per_steradian(p_S_m / range_m);
  if (per_sr <= 0) return {};
  const double distance_m = field.DistanceOf(p_S_m);
  Look look;
  look.per_m2 = per_sr * cosine / (range_m * range_m);
  look.sees = look.per_m2 >= asked.least_per_m2 &&
              IsInReach(field, distance_m, asked.reflectance * cosine, asked.ranges);
  if (!look.sees) look.why = Unseen::kTooFarOrSparse;
  if (asked.ranges) look.sigma_m = field.distance_sigma_m(distance_m) * range_m / distance_m;
  return look;
}

Sighting::Line LineTo(const Target& target, const Viewer& viewer, const Asked& asked) {
  const Vec3 from_W_m = viewer.X_WS.translation(), way_W_m = target.p_W_m - from_W_m;
  const double margin_m = std::clamp(asked.margin_m - Sighting::kTouch_m, 0.0, way_W_m.norm());
  return {from_W_m, target.p_W_m - margin_m * way_W_m.normalized(),
          viewer.field.through_glass && !asked.ranges};
}

}  // namespace

std::vector<Target> InTheAir(std::span<const Vec3> places_W_m) {
  std::vector<Target> targets;
  for (const Vec3& p_W_m : places_W_m) targets.push_back({p_W_m});
  return targets;
}

std::vector<Look> LookFrom(const Viewer& viewer, std::span<const Target> targets,
                           const Asked& asked, const Sighting& sighting) {
  std::vector<Look> looks;
  looks.reserve(targets.size());
  std::vector<Sighting::Line> lines;
  std::vector<std::size_t> tried;
  for (const Target& target : targets) {
    looks.push_back(Unhindered(viewer, target, asked));
    if (!looks.back().sees) continue;
    lines.push_back(LineTo(target, viewer, asked));
    tried.push_back(looks.size() - 1);
  }
  const std::vector<std::optional<Blocked>> blocked = sighting.Try(lines);
  for (std::size_t i = 0; i < tried.size(); ++i) {
    if (!blocked[i]) continue;
    Look& look = looks[tried[i]];
    look.sees = false;
    look.why = Unseen::kBlocked;
    look.by = *blocked[i];
  }
  return looks;
}

}  // namespace tera

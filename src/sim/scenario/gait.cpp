#include "sim/scenario/gait.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace tera {
namespace {

constexpr double kShortestStride_m = 0.1, kLongestStride_m = 10, kHighest_m = 1;
constexpr double kFurthest_deg = 180;
constexpr std::size_t kMostMoments = 1000;  // maximum number of samples of a stride

/// Interpolates samples of a stride linearly at the phase of `travel_m`.
double At(const std::vector<double>& row, double stride_m, double travel_m) {
  if (row.empty()) return 0;
  const double share = travel_m / stride_m - std::floor(travel_m / stride_m);
  const double at = share * static_cast<double>(row.size());
  const auto k = static_cast<std::size_t>(at) % row.size();
  const double t = at - std::floor(at);
  return row[k] + t * (row[(k + 1) % row.size()] - row[k]);
}

/// Index of the limb that the key names; -1 without that key.
int LimbNamed(const ConfigMap& config, const char* key, const std::vector<ObstacleLimb>& limbs) {
  if (!config.Has(key)) return -1;
  const std::string name = config.Text(key);
  const auto found = std::ranges::find(limbs, name, &ObstacleLimb::name);
  if (found != limbs.end()) return static_cast<int>(found - limbs.begin());
  config.Fault(
      key,
      {FaultKind::kNoSuchName,
       fmt::format(
           "'{}' is not a limb named above it; need the name of one, or remove it for the body",
           name)});
  return -1;
}

ObstacleLimb ReadLimb(const ConfigMap& config, const Visual& body,
                      const std::vector<ObstacleLimb>& before) {
  ObstacleLimb limb;
  limb.name = config.Text("name");
  limb.visual = body;
  limb.visual.node = config.Text("node", limb.name);
  limb.visual.place = config.Place();
  limb.of = LimbNamed(config, "of", before);
  limb.joint_B_m = config.Vector3("joint_m", Any("m"));
  for (const double deg : config.Numbers("swing_deg", Between(-kFurthest_deg, kFurthest_deg, "deg"),
                                         1, kMostMoments)) {
    limb.swing_rad.push_back(deg * kDeg);
  }
  return limb;
}

}  // namespace

Gait ReadGait(const ConfigMap& config, const Visual& body) {
  Gait gait;
  if (!config.Has("gait")) return gait;
  const ConfigMap given = config.Map("gait");
  gait.stride_m = given.Number("stride_m", Between(kShortestStride_m, kLongestStride_m, "m"), 1.4);
  gait.rise_m = given.Numbers("rise_m", Between(-kHighest_m, kHighest_m, "m"), 1, kMostMoments);
  for (const ConfigMap& item : given.List("limbs")) {
    gait.limbs.push_back(ReadLimb(item, body, gait.limbs));
    const std::string& name = gait.limbs.back().name;
    if (std::ranges::count(gait.limbs, name, &ObstacleLimb::name) > 1) {
      item.Fault("name",
                 {FaultKind::kRepeated,
                  fmt::format("'{}' is named twice; need another name for each limb", name)});
    }
  }
  if (gait.limbs.empty())
    given.Fault("limbs", {FaultKind::kMissing, "is empty; need a limb that swings, or no gait"});
  return gait;
}

int ReadLimbOf(const ConfigMap& config, const Gait& gait) {
  return LimbNamed(config, "limb", gait.limbs);
}

double RiseOf(const Gait& gait, double scale, double travel_m) {
  return scale * At(gait.rise_m, scale * gait.stride_m, travel_m);
}

std::vector<Pose> LimbPoses(const Gait& gait, double scale, double travel_m) {
  std::vector<Pose> X_BL;
  for (const ObstacleLimb& limb : gait.limbs) {
    const Vec3 joint_m = scale * limb.joint_B_m;
    const double swing_rad = At(limb.swing_rad, scale * gait.stride_m, travel_m);
    const Pose about =
        MakePose(joint_m) * Eigen::AngleAxisd(swing_rad, -Vec3::UnitY()) * MakePose(-joint_m);
    X_BL.push_back(limb.of < 0 ? about : X_BL[limb.of] * about);
  }
  return X_BL;
}

}  // namespace tera

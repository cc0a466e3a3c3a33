#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <string_view>

#include "core/units.h"
#include "sim/machine_doubts.h"

namespace tera {
namespace {

/// A box of a machine or an obstacle.
struct Part {
  std::string_view of;
  Pose X_WG = Pose::Identity();
  Vec3 size_m = Vec3::Zero();

  bool Holds(const Vec3& p_W_m) const {
    const Vec3 p_G_m = X_WG.inverse() * p_W_m;
    return (p_G_m.cwiseAbs().array() <= 0.5 * size_m.array()).all();
  }
};

std::vector<Part> PartsOf(const ScenarioMachine& machine) {
  const MachinePlacement& placement = machine.placement;
  const std::vector<Pose> X_WL =
      ForwardKinematics(placement.model, placement.X_WB, placement.q_rad);
  std::vector<Part> parts;
  for (std::size_t i = 0; i < placement.model.links.size(); ++i) {
    for (const CollisionBox& box : placement.model.links[i].collision) {
      parts.push_back({placement.name, X_WL[i] * box.X_BG, box.size_m});
    }
  }
  return parts;
}

std::vector<Part> PartsOf(const ScenarioObstacle& obstacle, const TerrainSurface& ground) {
  const Vec2& xy_m = obstacle.xy_W_m;
  const double z_m = ground.HeightAt(xy_m.x(), xy_m.y()) + obstacle.height_above_ground_m;
  const Pose X_WB = MakePose(Vec3(xy_m.x(), xy_m.y(), z_m), 0, 0, obstacle.yaw_rad);
  std::vector<Part> parts;
  for (const CollisionBox& box : obstacle.collision) {
    parts.push_back({obstacle.name, X_WB * box.X_BG, box.size_m});
  }
  return parts;
}

/// Whether the centre of a box of either object lies in a box of the other.
bool AreInOnePlace(const std::vector<Part>& a, const std::vector<Part>& b) {
  const auto holds = [](const std::vector<Part>& in, const std::vector<Part>& of) {
    return std::any_of(in.begin(), in.end(), [&](const Part& whole) {
      return std::any_of(of.begin(), of.end(),
                         [&](const Part& part) { return whole.Holds(part.X_WG.translation()); });
    });
  };
  return holds(a, b) || holds(b, a);
}

std::optional<std::string> DoubtOfPlace(std::string_view name, const Vec2& xy_m,
                                        const TerrainSurface& ground) {
  const Vec2& low_m = ground.origin_W_m;
  const Vec2 high_m = low_m + ground.cell_m * Vec2(ground.nx - 1, ground.ny - 1);
  if ((xy_m.array() >= low_m.array()).all() && (xy_m.array() <= high_m.array()).all()) {
    return std::nullopt;
  }
  return fmt::format(
      "{} is at ({:.4g}, {:.4g}) m, outside the site, which reaches from ({:.4g}, {:.4g}) to "
      "({:.4g}, {:.4g})",
      name, xy_m.x(), xy_m.y(), low_m.x(), low_m.y(), high_m.x(), high_m.y());
}

/// Warns of a sensor tens of metres from its link, and of a sensor below the ground.
std::optional<std::string> DoubtOfMount(const MachinePlacement& placement,
                                        const std::vector<Pose>& X_WL,
                                        const SensorDescription& sensor,
                                        const TerrainSurface& ground) {
  constexpr double kFarthest_m = 60, kDeepest_m = 0.1;
  const int link = placement.model.LinkIndex(sensor.link);
  if (link < 0) return std::nullopt;
  const double apart_m = sensor.X_BS.translation().norm();
  if (apart_m > kFarthest_m) {
    return fmt::format("{}, sensor {} sits {:.4g} m from the origin of {}: in mm? need metres",
                       placement.name, sensor.name, apart_m, sensor.link);
  }
  const Vec3 p_W_m = X_WL[static_cast<std::size_t>(link)] * sensor.X_BS.translation();
  const double depth_m = ground.HeightAt(p_W_m.x(), p_W_m.y()) - p_W_m.z();
  if (depth_m < kDeepest_m) return std::nullopt;
  return fmt::format("{}, sensor {} sits {:.2g} m below the ground: z of its mount points up",
                     placement.name, sensor.name, depth_m);
}

/// Warns of angles that are multiples of pi/4 as numbers in degrees, within three digits.
std::optional<std::string> DoubtOfAngles(const MachinePlacement& placement,
                                         const SensorDescription& sensor) {
  constexpr double kThreeDigits = 1e-3;
  const Vec3 rpy_rad = RpyFromRotation(sensor.X_BS.linear());
  for (const double angle_rad : rpy_rad) {
    const double quarters = std::abs(angle_rad) / kDeg / (kPi / 4);
    if (quarters < 0.5 || quarters > 8.5) continue;
    if (std::abs(quarters - std::round(quarters)) > kThreeDigits * quarters) continue;
    return fmt::format("{}, sensor {} is turned by {:.5g} deg: in radians? rpy_deg takes degrees",
                       placement.name, sensor.name, std::abs(angle_rad) / kDeg);
  }
  return std::nullopt;
}

std::optional<std::string> DoubtOfSpeed(const ScenarioObstacle& obstacle) {
  constexpr double kPerson_mps = 12, kAny_mps = 40;
  const double most_mps = obstacle.label == SemanticClass::kPerson ? kPerson_mps : kAny_mps;
  for (std::size_t k = 1; k < obstacle.path.size(); ++k) {
    const PathPoint &from = obstacle.path[k - 1], &to = obstacle.path[k];
    const double speed_mps = (to.xy_W_m - from.xy_W_m).norm() / (to.t_s - from.t_s);
    if (!(speed_mps > most_mps)) continue;
    return fmt::format("{} moves at {:.3g} m/s from {:g} to {:g} s", obstacle.name, speed_mps,
                       from.t_s, to.t_s);
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::string> PlacesInDoubt(const Scenario& scenario) {
  const TerrainSurface& ground = scenario.site->surface();
  std::vector<std::string> doubts;
  const auto add = [&](const std::optional<std::string>& doubt) {
    if (doubt) doubts.push_back(*doubt);
  };
  std::vector<std::vector<Part>> standing;
  std::vector<std::string_view> names;
  for (const ScenarioMachine& machine : scenario.machines) {
    add(DoubtOfPlace(machine.placement.name, machine.placement.X_WB.translation().head<2>(),
                     ground));
    const std::vector<Pose> X_WL =
        ForwardKinematics(machine.placement.model, machine.placement.X_WB, machine.placement.q_rad);
    for (const SensorDescription& sensor : machine.sensors) {
      add(DoubtOfMount(machine.placement, X_WL, sensor, ground));
      add(DoubtOfAngles(machine.placement, sensor));
    }
    standing.push_back(PartsOf(machine));
    names.push_back(machine.placement.name);
  }
  for (const ScenarioObstacle& obstacle : scenario.obstacles) {
    add(DoubtOfPlace(obstacle.name, obstacle.xy_W_m, ground));
    add(DoubtOfSpeed(obstacle));
    standing.push_back(PartsOf(obstacle, ground));
    names.push_back(obstacle.name);
  }
  // Obstacles may overlap each other, as bags on a pallet do.
  for (std::size_t a = 0; a < scenario.machines.size(); ++a) {
    for (std::size_t b = a + 1; b < standing.size(); ++b) {
      if (!AreInOnePlace(standing[a], standing[b])) continue;
      doubts.push_back(fmt::format("{} and {} start at the same place", names[a], names[b]));
    }
  }
  return doubts;
}

}  // namespace tera

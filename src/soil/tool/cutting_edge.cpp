#include "soil/tool/cutting_edge.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "soil/tool/contact_probe.h"
#include "soil/tool/layered_cut.h"
#include "soil/tool/slip_ahead.h"

namespace tera {
namespace {

constexpr double kElasticTravel_m = 0.006;  ///< travel over which the force builds up
constexpr double kNearAhead_m = 0.075;      ///< distance ahead at which the depth is measured
/// below this horizontal part, the mouth faces up or down
constexpr double kLeastLevelMouth = 0.1;
constexpr double kLeastLevel = 1e-6;       ///< least length of a horizontal direction
constexpr double kDeadLoad = 0.8;          ///< fill from which soil separates along the load
constexpr double kSlowestEdge_mps = 1e-4;  ///< slower edges keep their elastic travel

/// Horizontal unit vector in which the edge cuts: along the mouth's normal, or along the floor if
/// the mouth faces up or down. Empty if neither has a horizontal part.
std::optional<Vec3> CutDirection(const ShovelShape& shape, const Mat3& R_WB) {
  const auto level = [](const Vec3& v) { return Vec3(v - v.z() * Vec3::UnitZ()); };
  Vec3 travel_W = level(R_WB * shape.mouth_normal_B());
  if (travel_W.norm() < kLeastLevelMouth) travel_W = level(R_WB * shape.edge_direction_B());
  if (travel_W.norm() < kLeastLevel) return std::nullopt;
  return travel_W.normalized();
}

/// Replaces a share of the steel friction by soil friction.
void RubOnSoil(double share, CutLayer* layer) {
  layer->tool_friction_rad += share * (layer->friction_rad - layer->tool_friction_rad);
}

}  // namespace

/// A part of the edge's width, and the ground that it cuts.
struct CuttingEdge::Strip {
  Vec3 p_B, p_W;
  GroundAhead ahead;
  CutSoil soil;

  double depth_m() const { return ahead.depth_m(); }
};

/// The surface along which soil separates, and the load on it.
struct CuttingEdge::Plane {
  Vec3 up_W;                    ///< from the edge up the plane
  double on_soil = 0;           ///< share of the plane that is carried soil instead of steel
  double surcharge_npm = 0;     ///< carried weight per metre of width
  double surcharge_over_m = 1;  ///< least length over which this weight is spread
  double length_m = 0;          ///< length from the edge to the end of the plane
};

CuttingEdge::CuttingEdge(const Shovel& shovel, const std::vector<SoilType>& soils)
    : shovel_(shovel), piercing_(soils, shovel.edge_thickness_m) {}

std::array<CuttingEdge::Strip, CuttingEdge::kStrips> CuttingEdge::Strips(
    const ShovelShape& shape, const BodyState& body, const Vec3& travel_W,
    const std::vector<SoilType>& soils, Columns* ground) const {
  std::array<Strip, kStrips> strips;
  // An overhanging top edge clears the ground below it, so the depth is measured beyond it.
  const Vec3 mouth_W = body.X_WB.linear() * (shape.top_edge_B() - shape.edge_B());
  const double near_m =
      std::max(0.0, mouth_W.dot(travel_W)) + ContactProbeDistance_m(kNearAhead_m, ground->cell_m());
  for (int s = 0; s < kStrips; ++s) {
    Strip& strip = strips[s];
    strip.p_B = shape.edge_B() + ((s + 0.5) / kStrips - 0.5) * shovel_.width_m * Vec3::UnitY();
    strip.p_W = body.X_WB * strip.p_B;
    strip.ahead = LookAhead(strip.p_W, near_m, travel_W, *ground);
    if (strip.depth_m() <= 0) continue;
    const Vec2 near = (strip.p_W + near_m * travel_W).head<2>();
    const int i = std::clamp(ground->NearestI(near.x()), 0, ground->nx() - 1);
    const int j = std::clamp(ground->NearestJ(near.y()), 0, ground->ny() - 1);
    strip.soil = SoilAbove(ground->Touch(i, j), strip.p_W.z(), *ground, soils);
  }
  return strips;
}

CuttingEdge::Plane CuttingEdge::CutPlane(const ShovelShape& shape, const Mat3& R_WB,
                                         const Carried& carried) const {
  const Vec3 floor_W = -(R_WB * shape.edge_direction_B());
  Plane plane{.up_W = floor_W};
  plane.length_m = (shape.top_edge_B() - shape.edge_B()).norm();
  if (shovel_.capacity_m3 <= 0 || carried.mass_kg <= 0) return plane;
  const double fill = carried.volume_m3 / shovel_.capacity_m3;
  plane.on_soil = std::clamp((fill - kDeadLoad) / (1 - kDeadLoad), 0.0, 1.0);
  const Vec3 mouth_W = R_WB * (shape.top_edge_B() - shape.edge_B()).normalized();
  plane.up_W = ((1 - plane.on_soil) * floor_W + plane.on_soil * mouth_W).normalized();
  // Carried soil behind the plane moves with it and adds no surcharge.
  plane.surcharge_npm =
      (1 - plane.on_soil) * carried.mass_kg * kStandardGravity_mps2 / shovel_.width_m;
  plane.surcharge_over_m = shape.radius_m();
  return plane;
}

/// Force of failed ground on a strip.
CuttingForce CuttingEdge::CutBy(const Strip& strip, const Vec3& travel_W, const Plane& plane,
                                double speed_mps) const {
  CuttingInput in;
  in.width_m = shovel_.width_m / kStrips;
  in.depth_m = strip.depth_m();
  in.rake_rad = std::max(0.0, std::atan2(plane.up_W.z(), -plane.up_W.dot(travel_W)));
  CutSoil soil = strip.soil;
  RubOnSoil(plane.on_soil, &soil.mean);
  for (CutLayer& layer : soil.layer) RubOnSoil(plane.on_soil, &layer);
  in.speed_mps = std::max(0.0, speed_mps);
  in.flank_share = 1.0 / kStrips;
  SoilAhead ahead;
  ahead.blade_m = plane.length_m;
  ahead.carried_npm = plane.surcharge_npm;
  ahead.carried_over_m = plane.surcharge_over_m;
  return CutLayersAhead(in, strip.ahead, soil, ahead);
}

/// Resistance of the ground of a strip to piercing along the floor.
double CuttingEdge::PiercingForceOn_n(const Strip& strip, double sine_down) const {
  // The profile ends at the tips of the teeth, if there are any; the edge lies behind them.
  const double edge_area_m2 = shovel_.width_m * shovel_.edge_thickness_m;
  const double tooth_area_m2 = shovel_.teeth * shovel_.tooth_width_m * shovel_.tooth_thickness_m;
  const double edge_behind_m =
      shovel_.teeth > 0 ? shovel_.tooth_length_m * std::max(0.0, sine_down) : 0.0;
  return (tooth_area_m2 * piercing_.Pressure_pa(strip.soil, strip.depth_m()) +
          edge_area_m2 * piercing_.Pressure_pa(strip.soil, strip.depth_m() - edge_behind_m)) /
         kStrips;
}

/// Friction on floor and side walls of the carried soil that is pushed up the floor.
double CuttingEdge::DragInside_n(const ShovelShape& shape, const Mat3& R_WB, const Carried& carried,
                                 const SoilType& soil) const {
  if (carried.mass_kg <= 0) return 0;
  const Vec3 edge_B = shape.edge_direction_B();
  const Vec3& mouth_B = shape.mouth_normal_B();
  const Vec3 inward_W = R_WB * (mouth_B - mouth_B.dot(edge_B) * edge_B);
  const double normal_n =
      carried.mass_kg * kStandardGravity_mps2 * std::max(0.0, inward_W.normalized().z());
  const double length_m = (shape.top_edge_B() - shape.edge_B()).norm();
  const double depth_m = carried.volume_m3 / (shovel_.width_m * length_m);
  // coefficient of earth pressure at rest (Jaky)
  const double at_rest = 1 - std::sin(soil.friction_angle_rad);
  return std::tan(soil.soil_tool_friction_rad) * normal_n *
         (1 + at_rest * depth_m / shovel_.width_m);
}

Wrench CuttingEdge::Act(const ShovelShape& shape, const BodyState& body, const Carried& carried,
                        double dt_s, const std::vector<SoilType>& soils, Columns* ground) {
  Wrench wrench;
  lifted_W_m_.setZero();
  const Mat3& R_WB = body.X_WB.linear();
  const std::optional<Vec3> travel_W = CutDirection(shape, R_WB);
  if (!travel_W) return wrench;
  const std::array<Strip, kStrips> strips = Strips(shape, body, *travel_W, soils, ground);
  if (std::none_of(strips.begin(), strips.end(), [](const Strip& s) { return s.depth_m() > 0; })) {
    cut_travel_m_ = pierce_travel_m_ = 0;
    return wrench;
  }
  const Vec3 v_W = PointVelocity(body, shape.edge_B());
  const Vec3 cut_dir_W = R_WB * shape.edge_direction_B();
  cut_travel_m_ = std::clamp(cut_travel_m_ + v_W.dot(*travel_W) * dt_s, 0.0, kElasticTravel_m);
  pierce_travel_m_ =
      std::clamp(pierce_travel_m_ + v_W.dot(cut_dir_W) * dt_s, 0.0, kElasticTravel_m);
  const double cut_share = cut_travel_m_ / kElasticTravel_m;
  const double pierce_share = pierce_travel_m_ / kElasticTravel_m;
  const Plane plane = CutPlane(shape, R_WB, carried);
  const double drag_n = DragInside_n(shape, R_WB, carried, soils[carried.soil]);
  for (const Strip& strip : strips) {
    if (strip.depth_m() <= 0) continue;
    const Vec3 v_strip_W = PointVelocity(body, strip.p_B);
    const CuttingForce cut = CutBy(strip, *travel_W, plane, v_strip_W.dot(*travel_W));
    const Vec3 cut_W_n = -(cut.draft_n * *travel_W + cut.vertical_n * Vec3::UnitZ());
    lifted_W_m_ += cut.wedge_length_m / kStrips * travel_W->head<2>();
    const double pierce_n = PiercingForceOn_n(strip, -cut_dir_W.z()) + drag_n / kStrips;
    Vec3 force_W_n = cut_share * cut_W_n - pierce_share * pierce_n * cut_dir_W;
    // The ground never accelerates the edge along its motion.
    const double power_w = force_W_n.dot(v_strip_W), v2 = v_strip_W.squaredNorm();
    if (power_w > 0 && v2 > kSlowestEdge_mps * kSlowestEdge_mps) {
      force_W_n -= power_w / v2 * v_strip_W;
    }
    wrench.AddForceAt(force_W_n, strip.p_W, body.X_WB.translation());
  }
  return wrench;
}

}  // namespace tera

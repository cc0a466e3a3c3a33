#include "sim/events/tip_events.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "physics/description/payload.h"

namespace tera {
namespace {

constexpr TimeNs kTipPause_ns = 200'000'000;
constexpr TimeNs kLeastLift_ns = 100'000'000;
/// Patches of the flat underside face down within 11 deg in the machine's frame.
constexpr double kFlatUnderside = 0.98;

Vec2 CentreOfMass_m(const MachineModel& model, const MachineState& state) {
  Vec3 sum_kgm = Vec3::Zero();
  double sum_kg = 0;
  const auto add = [&](double mass_kg, int link, const Vec3& com_B_m) {
    sum_kgm += mass_kg * (state.links[static_cast<std::size_t>(link)].X_WB * com_B_m);
    sum_kg += mass_kg;
  };
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    add(model.links[i].mass_kg, static_cast<int>(i), model.links[i].com_B_m);
  }
  for (std::size_t s = 0; s < state.shovel_load.size(); ++s) {
    add(state.shovel_load[s].mass_kg, model.ground_tools.shovels[s].link,
        state.shovel_load[s].com_B_m);
  }
  return (sum_kgm / sum_kg).head<2>();
}

/// Corners of the flat undersides, seen from above.
std::vector<Vec2> Underside_m(const MachineModel& model, const MachineState& state) {
  std::vector<Vec2> corners;
  for (const RunningGear& gear : model.ground_tools.gears) {
    const Pose& X_WB = state.links[static_cast<std::size_t>(gear.link)].X_WB;
    for (const ContactPatch& patch : gear.patches) {
      if (patch.outward_B.z() > -kFlatUnderside) continue;
      const Vec3 along_B_m = 0.5 * patch.length_m * patch.travel_B;
      const Vec3 across_B_m = 0.5 * patch.width_m * patch.outward_B.cross(patch.travel_B);
      for (const double a : {-1.0, 1.0}) {
        for (const double b : {-1.0, 1.0}) {
          const Vec3 corner_W_m = X_WB * Vec3(patch.p_B_m + a * along_B_m + b * across_B_m);
          corners.emplace_back(corner_W_m.head<2>());
        }
      }
    }
  }
  return corners;
}

/// A point is within the convex hull of others unless these leave half of its horizon free.
bool IsAmong(const Vec2& p_m, const std::vector<Vec2>& others_m) {
  std::vector<double> bearings_rad;
  for (const Vec2& other_m : others_m) {
    const Vec2 to_m = other_m - p_m;
    bearings_rad.push_back(std::atan2(to_m.y(), to_m.x()));
  }
  std::ranges::sort(bearings_rad);
  double widest_rad = bearings_rad.front() + 2 * kPi - bearings_rad.back();
  for (std::size_t k = 1; k < bearings_rad.size(); ++k) {
    widest_rad = std::max(widest_rad, bearings_rad[k] - bearings_rad[k - 1]);
  }
  return widest_rad < kPi;
}

}  // namespace

TipEvents::TipEvents(const Scenario& scenario)
    : scenario_(scenario),
      beyond_({.kind = EventKind::kTip, .pause_ns = kTipPause_ns}),
      lifted_({.kind = EventKind::kTip, .pause_ns = kTipPause_ns, .least_ns = kLeastLift_ns}) {
  for (const ScenarioMachine& machine : scenario.machines) {
    models_.push_back(machine.placement.model);
    AddPayloads(&models_.back());
  }
}

bool TipEvents::IsStable(std::size_t machine, const MachineState& state) const {
  const std::vector<Vec2> underside_m = Underside_m(models_[machine], state);
  return underside_m.empty() || IsAmong(CentreOfMass_m(models_[machine], state), underside_m);
}

void TipEvents::Observe(const Instant& now) {
  for (std::size_t m = 0; m < models_.size(); ++m) {
    const MachineModel& model = models_[m];
    const MachineState& state = now.machines[m];
    const std::string& name = scenario_.machines[m].placement.name;
    if (model.fixed_base) continue;
    const double lean_rad = std::acos(std::clamp(state.links[0].X_WB.linear()(2, 2), -1.0, 1.0));
    if (!IsStable(m, state)) {
      beyond_.Hold({name, model.links[0].name, ""}, now.t_ns, now.t_ns, lean_rad);
    }
    for (std::size_t g = 0; g < state.gear_sinkage_m.size(); ++g) {
      if (state.gear_sinkage_m[g] > 0) continue;
      lifted_.Hold({name, model.ground_tools.gears[g].name, ""}, now.t_ns, now.t_ns, lean_rad);
    }
  }
  beyond_.Close(now.t_ns);
  lifted_.Close(now.t_ns);
}

std::vector<RecordedEvent> TipEvents::All() const {
  std::vector<RecordedEvent> all = beyond_.All();
  const std::vector<RecordedEvent> lifted = lifted_.All();
  all.insert(all.end(), lifted.begin(), lifted.end());
  return all;
}

}  // namespace tera

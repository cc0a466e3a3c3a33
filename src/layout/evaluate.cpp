#include "layout/evaluate.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/error.h"
#include "layout/measures/blind_map.h"
#include "layout/measures/coverage.h"
#include "layout/measures/elevation_map.h"
#include "layout/measures/people.h"
#include "layout/measures/shovel_view.h"

namespace tera {
namespace {

/// Name of the zone around the machine, which every study has.
constexpr char kAround[] = "around";

Zone AroundMachine(const LayoutStudy& study, const MachineModel& model) {
  return {.name = kAround,
          .frame = model.links.front().name,
          .level = true,
          .X_FZ = Pose::Identity(),
          .shape = ZoneCylinder{study.radius_m, study.height_m}};
}

/// The pose of a zone's frame now. `machine` is the studied one.
Pose FrameOf(const Zone& zone, const MachineModel& model, const MachineState& machine) {
  if (zone.frame == "W") return Pose::Identity();
  const Pose& X_WB = machine.links[model.LinkIndex(zone.frame)].X_WB;
  return zone.level ? Levelled(X_WB) : X_WB;
}

/// The corners of a zone's shape from above, in its own frame.
std::vector<Vec3> CornersOf(const Zone& zone) {
  std::vector<Vec3> corners;
  if (const auto* prism = std::get_if<ZonePrism>(&zone.shape)) {
    for (const Vec2& p_m : prism->corners_m) corners.emplace_back(p_m.x(), p_m.y(), prism->low_m);
    return corners;
  }
  const auto* box = std::get_if<ZoneBox>(&zone.shape);
  const Vec2 half_m = box ? Vec2(0.5 * box->size_m.head<2>())
                          : Vec2::Constant(std::get<ZoneCylinder>(zone.shape).radius_m);
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) corners.emplace_back(x * half_m.x(), y * half_m.y(), 0);
  }
  return corners;
}

/// A zone that stands in W must have a part of the site below it.
void RequireOnSite(const Zone& zone, const TerrainGrid& site) {
  const Vec2 low_m = site.origin_W_m;
  const Vec2 high_m(site.x_m(site.nx - 1), site.y_m(site.ny - 1));
  Vec2 from_m = Vec2::Constant(1e9), to_m = -from_m;
  for (const Vec3& p_Z_m : CornersOf(zone)) {
    const Vec3 p_W_m = zone.X_FZ * p_Z_m;
    from_m = from_m.cwiseMin(p_W_m.head<2>());
    to_m = to_m.cwiseMax(p_W_m.head<2>());
  }
  if ((to_m.array() > low_m.array()).all() && (from_m.array() < high_m.array()).all()) return;
  throw InputError(fmt::format(
      "study: zone '{}': lies beside the site, which reaches from x {} to {} m and y {} to {} m; "
      "need a place on it",
      zone.name, low_m.x(), high_m.x(), low_m.y(), high_m.y()));
}

void CheckZones(const LayoutStudy& study, const Scenario& scenario, const MachineModel& model) {
  for (const Zone& zone : study.zones) {
    if (zone.name == kAround) {
      throw InputError(fmt::format(
          "study: zone '{}': is the name of the volume around the machine; need another",
          zone.name));
    }
    if (zone.frame == "W") {
      RequireOnSite(zone, scenario.site->surface());
    } else if (model.LinkIndex(zone.frame) < 0) {
      std::vector<std::string> frames = {"W"};
      for (const Link& link : model.links) frames.push_back(link.name);
      throw InputError(fmt::format("study: zone '{}': there is no frame '{}'; need one of {}",
                                   zone.name, zone.frame, fmt::join(frames, ", ")));
    }
  }
}

/// The soil in each shovel of a machine, in the scene.
std::vector<std::uint16_t> SoilInstances(const MachinePlacement& placement,
                                         const SceneModel& scene) {
  std::vector<std::uint16_t> instances;
  for (const Shovel& shovel : placement.model.ground_tools.shovels) {
    const std::string name = placement.name + "/" + shovel.name + "_soil";
    const auto found = std::find_if(scene.instances.begin(), scene.instances.end(),
                                    [&](const SceneInstance& i) { return i.name == name; });
    const bool is_there = found != scene.instances.end();
    instances.push_back(is_there ? static_cast<std::uint16_t>(found - scene.instances.begin())
                                 : std::uint16_t{0});
  }
  return instances;
}

/// All that is measured of one layout.
struct Measures {
  std::vector<ZoneCoverage> zones;
  std::vector<BlindMap> maps;
  std::vector<PersonRange> people;
  std::vector<ShovelView> shovels;
  ElevationMap elevation;

  Measures(const LayoutStudy& study, const MachinePlacement& placement, const SceneModel& scene)
      : elevation(study.elevation) {
    const MachineModel& model = placement.model;
    zones.emplace_back(AroundMachine(study, model), study.points, study.seed);
    for (const Zone& zone : study.zones) zones.emplace_back(zone, study.points, study.seed);
    for (const double height_m : study.map_heights_m) maps.emplace_back(height_m);
    for (const Posture& posture : study.person.postures) {
      people.emplace_back(posture, study.person, study.seen.reflectance);
    }
    const std::vector<std::uint16_t> soil = SoilInstances(placement, scene);
    for (std::size_t s = 0; s < soil.size(); ++s) {
      shovels.emplace_back(model.ground_tools.shovels[s], soil[s]);
    }
  }
};

/// H: where maps are centred and what they are turned to.
Pose MapFrame(const MachineState& machine, int upper, const TerrainSurface& ground) {
  Pose X_WH = Levelled(machine.links[upper].X_WB);
  X_WH.translation().z() = ground.HeightAt(X_WH.translation().x(), X_WH.translation().y());
  return X_WH;
}

PolarMap SeenMap(const BlindMap& map) {
  return {.name = fmt::format("seen/{} m", map.height_m()),
          .title = fmt::format("Share of the cycle in which a place {} m above the ground is seen",
                               map.height_m()),
          .sectors = PolarGrid::kSectors,
          .rings = PolarGrid::kRings,
          .ring_m = PolarGrid::kRing_m,
          .value = map.SeenShare()};
}

void Append(std::vector<Figure> more, std::vector<Figure>* figures) {
  std::move(more.begin(), more.end(), std::back_inserter(*figures));
}

LayoutReport ReportOf(const Layout& layout, const Measures& measures, std::vector<double> t_s) {
  LayoutReport report;
  report.name = layout.name;
  report.file = layout.file.string();
  for (const Viewer& viewer : layout.viewers) report.viewers.push_back(viewer.name);
  report.expense = ExpenseOf(layout);
  report.t_s = std::move(t_s);
  for (const ZoneCoverage& zone : measures.zones) {
    Append(zone.Figures(), &report.figures);
    report.blind_causes[zone.zone().name] = zone.Causes();
    report.overlaps[zone.zone().name] = zone.Overlaps();
  }
  for (const BlindMap& map : measures.maps) {
    Append(map.Figures(), &report.figures);
    report.maps.push_back(SeenMap(map));
  }
  for (const PersonRange& person : measures.people) {
    Append(person.Figures(), &report.figures);
    report.curves.push_back(person.Curve());
  }
  for (const ShovelView& shovel : measures.shovels) Append(shovel.Figures(), &report.figures);
  Append(measures.elevation.Figures(), &report.figures);
  return report;
}

/// A moment of the cycle, as it is looked at.
struct Moment {
  const MachineModel& model;
  const MachineState& machine;
  const Pose X_WH;
  const Sighting& sighting;
  const TerrainSurface& ground;
};

void AddMoment(const LayoutStudy& study, const StudiedMachine& studied, const Moment& moment,
               const Layout& layout, Measures* measures) {
  const auto& [model, machine, X_WH, sighting, ground] = moment;
  for (ZoneCoverage& zone : measures->zones) {
    zone.Add(FrameOf(zone.zone(), model, machine), layout, study.seen, sighting, ground);
  }
  for (BlindMap& map : measures->maps) map.Add(X_WH, layout, study.seen, sighting, ground);
  for (PersonRange& person : measures->people) {
    person.Add(X_WH, studied.machine, layout, sighting, ground);
  }
  for (ShovelView& shovel : measures->shovels) shovel.Add(machine, layout, sighting);
  measures->elevation.Add(X_WH, layout, study.seen.reflectance, sighting, ground);
}

}  // namespace

std::vector<LayoutReport> Evaluate(const Cycle& cycle, const LayoutStudy& study,
                                   std::vector<Layout> layouts, const EvaluateOptions& options) {
  const Scenario& scenario = cycle.scenario();
  const StudiedMachine studied = FindMachine(study, scenario);
  const MachinePlacement& placement = scenario.machines[studied.machine].placement;
  CheckZones(study, scenario, placement.model);
  const SceneAssembly assembly(scenario);
  Sighting sighting(scenario, assembly, options.threads);
  std::vector<Measures> measures(layouts.size(), Measures(study, placement, assembly.model()));
  std::vector<double> t_s;
  cycle.ForEachMoment(study.rate_hz, [&](const Instant& now, const TerrainSurface& ground) {
    t_s.push_back(ToSeconds(now.t_ns));
    if (options.progress) options.progress(t_s.back(), scenario.duration_s);
    sighting.Show(now, ground);
    const MachineState& machine = now.machines[studied.machine];
    const Moment moment{placement.model, machine, MapFrame(machine, studied.upper, ground),
                        sighting, ground};
    for (std::size_t l = 0; l < layouts.size(); ++l) {
      MoveViewers(machine, &layouts[l]);
      AddMoment(study, studied, moment, layouts[l], &measures[l]);
    }
  });
  std::vector<LayoutReport> reports;
  for (std::size_t l = 0; l < layouts.size(); ++l) {
    reports.push_back(ReportOf(layouts[l], measures[l], t_s));
    reports.back().cycle = cycle.name();
  }
  return reports;
}

}  // namespace tera

#include "layout/measures/layout_measures.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/error.h"
#include "layout/sight/hull.h"

namespace tera {
namespace {

/// Unoccluded share of a viewer's field below which it gets a warning.
constexpr double kLeastSeen = 0.01;

Zone AroundMachine(const LayoutStudy& study, const MachineModel& model) {
  return {.name = kAroundZone,
          .frame = model.links.front().name,
          .level = true,
          .on_ground = true,
          .X_FZ = Pose::Identity(),
          .shape = ZoneCylinder{study.radius_m, study.height_m}};
}

/// The pose, moved vertically onto the ground.
Pose OnGround(Pose X_WF, const TerrainSurface& ground) {
  Vec3 p_W_m = X_WF.translation();
  p_W_m.z() = ground.HeightAt(p_W_m.x(), p_W_m.y());
  X_WF.translation() = p_W_m;
  return X_WF;
}

/// The current pose of a zone's frame. `machine` is the studied one.
Pose FrameOf(const Zone& zone, const MachineModel& model, const MachineState& machine,
             const TerrainSurface& ground) {
  if (zone.frame == "W") return Pose::Identity();
  const Pose& X_WB = machine.links[model.LinkIndex(zone.frame)].X_WB;
  const Pose X_WF = zone.level ? Levelled(X_WB) : X_WB;
  return zone.on_ground ? OnGround(X_WF, ground) : X_WF;
}

/// Scene instances of the soil in each shovel of a machine.
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

PolarMap SeenMap(const BlindMap& map) {
  return {.id = {Measure::kSeenMap, fmt::format("{}", map.height_m())},
          .title = fmt::format("Share of the cycle in which a place {} m above the ground is seen",
                               map.height_m()),
          .sectors = PolarGrid::kSectors,
          .rings = PolarGrid::kRings,
          .ring_m = PolarGrid::kRing_m,
          .value = map.SeenShare()};
}

/// Warning for a viewer that sees almost nothing around the machine.
std::string HiddenWarning(const std::string& viewer, const ZoneCoverage::FieldOf& field) {
  if (field.hidden_by.empty()) {
    return fmt::format(
        "{}: it sees nothing around the machine: no place there lies within its field of view and "
        "range; turn or move the sensor",
        viewer);
  }
  const auto most =
      std::max_element(field.hidden_by.begin(), field.hidden_by.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  constexpr double kPercent = 100;
  return fmt::format(
      "{}: it sees only {:.1f} % of the space around the machine that lies in its field of view; "
      "{} hides {:.0f} %; move or turn the sensor to a free view",
      viewer, kPercent * field.SeenShare(), most->first,
      kPercent * most->second / (field.seen + field.hidden));
}

/// Whether a figure of this subject is requested. With `of`, only that subject's name counts.
bool IsWanted(const WantedFigures& wanted, Subject subject, const std::string& of = "") {
  return !wanted || std::any_of(wanted->begin(), wanted->end(), [&](const FigureId& id) {
    return SubjectOf(id.measure) == subject && (of.empty() || id.of == of);
  });
}

}  // namespace

LayoutMeasures::LayoutMeasures(const LayoutStudy& study, const Scenario& scenario,
                               const SceneAssembly& assembly, const Layout& layout,
                               const WantedFigures& wanted)
    : study_(study),
      scenario_(scenario),
      assembly_(assembly),
      studied_(FindMachine(study, scenario)) {
  for (const Viewer& viewer : layout.viewers) {
    if (viewer.field.is_flat) flat_.insert(viewer.name);
  }
  AddZonesAndMaps(wanted);
  AddPeople(wanted);
  AddShovels(wanted);
  if (IsWanted(wanted, Subject::kElevation)) elevation_.emplace(study.elevation);
  if (IsWanted(wanted, Subject::kAntenna)) sky_.emplace(model(), studied_.machine, layout.sensors);
  if (IsWanted(wanted, Subject::kOccupancy)) {
    occupancy_.emplace(study.radius_m, study.height_m, study.information.voxel_m);
  }
}

const MachineModel& LayoutMeasures::model() const {
  return scenario_.machines[studied_.machine].placement.model;
}

void LayoutMeasures::AddZonesAndMaps(const WantedFigures& wanted) {
  const auto add_zone = [&](const Zone& zone) {
    if (!IsWanted(wanted, Subject::kZone, zone.name)) return;
    zones_.emplace_back(zone, study_.points, study_.seed);
  };
  add_zone(AroundMachine(study_, model()));
  for (const Zone& zone : study_.zones) add_zone(zone);
  for (const double height_m : study_.map_heights_m) {
    if (IsWanted(wanted, Subject::kHeight, fmt::format("{}", height_m)))
      maps_.emplace_back(height_m);
  }
  if (IsWanted(wanted, Subject::kPurpose)) pixels_.emplace();
}

void LayoutMeasures::AddPeople(const WantedFigures& wanted) {
  const double reflectance = study_.seen.reflectance;
  for (const Posture& posture : study_.person.postures) {
    if (!IsWanted(wanted, Subject::kPosture, posture.name)) continue;
    people_.emplace_back(posture, study_.person, reflectance);
  }
  if (IsWanted(wanted, Subject::kEntropy)) {
    entropy_.emplace(study_.person, study_.information, reflectance);
  }
}

void LayoutMeasures::AddShovels(const WantedFigures& wanted) {
  const std::vector<Shovel>& shovels = model().ground_tools.shovels;
  const std::vector<std::uint16_t> soil =
      SoilInstances(scenario_.machines[studied_.machine].placement, assembly_.model());
  for (std::size_t s = 0; s < shovels.size(); ++s) {
    if (IsWanted(wanted, Subject::kShovel, shovels[s].name))
      shovels_.emplace_back(shovels[s], soil[s]);
  }
}

Places LayoutMeasures::PlacesOf(const LookedAt& moment) const {
  const auto& [now, sighting, ground] = moment;
  const MachineState& machine = now.machines[studied_.machine];
  Places places;
  places.X_WH = OnGround(Levelled(machine.links[studied_.upper].X_WB), ground);
  places.hull_m = HullRadii_m(places.X_WH, studied_.machine, PolarGrid::kSectors, sighting);
  for (const ZoneCoverage& zone : zones_) {
    places.zones_W_m.push_back(
        zone.PlacesInAir(FrameOf(zone.zone(), model(), machine, ground), sighting, ground));
  }
  const auto around = [&, &sighting = sighting, &ground = ground](double height_m) {
    PolarPlaces at = PlacesAt(height_m, places.X_WH, sighting, ground);
    LeaveOutHull(places.hull_m, &at);
    return at;
  };
  for (const BlindMap& map : maps_) places.maps.push_back(around(map.height_m()));
  if (pixels_) places.pixels = around(PixelDensity::kHeight_m);
  if (occupancy_) places.occupants = OccupantsAt(now, scenario_, assembly_, studied_.machine);
  return places;
}

void LayoutMeasures::Add(const LookedAt& moment, const Places& places, const Layout& layout) {
  const auto& [now, sighting, ground] = moment;
  const auto& [X_WH, hull_m, zones_W_m, maps, pixels, occupants] = places;
  const MachineState& machine = now.machines[studied_.machine];
  const double reflectance = study_.seen.reflectance;
  outline_m_.resize(hull_m.size());
  std::transform(hull_m.begin(), hull_m.end(), outline_m_.begin(), outline_m_.begin(),
                 [](double now_m, double before_m) { return std::max(now_m, before_m); });
  for (std::size_t z = 0; z < zones_.size(); ++z) {
    zones_[z].Add(zones_W_m[z], layout, study_.seen, sighting);
  }
  for (std::size_t m = 0; m < maps_.size(); ++m) {
    maps_[m].Add(maps[m], layout, study_.seen, sighting);
  }
  for (PersonRange& person : people_) person.Add(X_WH, hull_m, layout, sighting, ground);
  for (ShovelView& shovel : shovels_) shovel.Add(machine, layout, reflectance, sighting);
  if (elevation_) elevation_->Add(X_WH, layout, reflectance, sighting, ground);
  if (pixels_) pixels_->Add(pixels, layout, sighting);
  if (occupancy_) occupancy_->Add(X_WH, occupants, layout, reflectance, sighting);
  if (sky_) sky_->Add(machine, sighting);
  if (entropy_) entropy_->Add(X_WH, hull_m, layout, sighting, ground);
}

void LayoutMeasures::CheckMounts(const LookedAt& moment, const Layout& layout) {
  mounts_.Add(studied_.machine, layout.viewers, moment.sighting);
}

std::vector<std::string> LayoutMeasures::MountWarnings() const {
  std::vector<std::string> warnings = mounts_.Warnings();
  std::set<std::string> told = flat_;
  for (const BuriedMount& mount : mounts_.Buried()) told.insert(mount.viewer);
  for (const ZoneCoverage& zone : zones_) {
    if (zone.zone().name != kAroundZone) continue;
    for (const auto& [viewer, field] : zone.Fields()) {
      if (told.contains(viewer) || field.SeenShare() >= kLeastSeen) continue;
      warnings.push_back(HiddenWarning(viewer, field));
    }
  }
  return warnings;
}

void LayoutMeasures::RequirePlaces() const {
  for (const ZoneCoverage& zone : zones_) {
    if (zone.HadPlaces()) continue;
    throw InputError(zone.zone().place,
                     {FaultKind::kOutOfRange,
                      fmt::format("'{}' lies in the ground, in a solid body or outside the site at "
                                  "every moment; need a zone that contains air over the site",
                                  zone.zone().name)});
  }
}

std::vector<Figure> LayoutMeasures::Figures() const {
  std::vector<Figure> figures;
  const auto append = [&](std::vector<Figure> more) {
    std::move(more.begin(), more.end(), std::back_inserter(figures));
  };
  for (const ZoneCoverage& zone : zones_) append(zone.Figures());
  for (const BlindMap& map : maps_) append(map.Figures());
  for (const PersonRange& person : people_) append(person.Figures());
  for (const ShovelView& shovel : shovels_) append(shovel.Figures());
  if (elevation_) append(elevation_->Figures());
  if (pixels_) append(pixels_->Figures());
  if (occupancy_) append(occupancy_->Figures());
  if (entropy_) append(entropy_->Figures());
  if (sky_) append(sky_->Figures());
  return figures;
}

void LayoutMeasures::Report(LayoutReport* report) const {
  report->figures = Figures();
  for (const ZoneCoverage& zone : zones_) {
    report->blind_causes[zone.zone().name] = zone.Causes();
    report->overlaps[zone.zone().name] = zone.Overlaps();
  }
  for (const BlindMap& map : maps_) report->maps.push_back(SeenMap(map));
  for (const PersonRange& person : people_) {
    report->curves.push_back(person.Curve());
    for (PolarMap& map : person.Maps()) report->maps.push_back(std::move(map));
  }
  if (pixels_) {
    report->maps.push_back(pixels_->Map());
    for (PolarCurve& curve : pixels_->Curves()) report->curves.push_back(std::move(curve));
  }
  if (sky_) {
    for (PolarMap& map : sky_->Maps()) report->maps.push_back(std::move(map));
  }
  report->outline_m = outline_m_;
  report->warnings = MountWarnings();
}

}  // namespace tera

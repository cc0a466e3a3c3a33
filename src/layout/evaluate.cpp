#include "layout/evaluate.h"

#include <fmt/format.h>

#include <iterator>
#include <optional>
#include <utility>
#include <variant>

#include "core/error.h"
#include "dataset/files/file_digest.h"
#include "layout/measures/eye_masking.h"
#include "layout/measures/joint_information.h"
#include "layout/measures/layout_measures.h"

namespace tera {
namespace {

/// Corners of a zone's bounding shape from above, in Z.
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

/// Throws unless a part of the site lies below a zone in W.
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
  throw InputError(zone.place,
                   {FaultKind::kOutOfRange,
                    fmt::format("'{}' lies outside the site, which reaches from x {} to {} m and y "
                                "{} to {} m; need a place on it",
                                zone.name, low_m.x(), high_m.x(), low_m.y(), high_m.y())});
}

}  // namespace

void CheckStudy(const LayoutStudy& study, const Scenario& scenario) {
  const MachineModel& model =
      scenario.machines[FindMachine(study, scenario).machine].placement.model;
  if (study.eye) LinkOfEye(*study.eye, model);
  for (const Zone& zone : study.zones) {
    if (zone.name == kAroundZone) {
      throw InputError(
          zone.place,
          {FaultKind::kRepeated,
           fmt::format(
               "'{}' is the reserved name of the volume around the machine; need another name",
               zone.name)});
    }
    if (zone.frame == "W") {
      RequireOnSite(zone, scenario.site->surface());
    } else if (model.LinkIndex(zone.frame) < 0) {
      std::vector<std::string> frames = {"W"};
      for (const Link& link : model.links) frames.push_back(link.name);
      throw InputError(zone.place,
                       {FaultKind::kNoSuchName,
                        fmt::format("'{}' refers to the unknown frame '{}'; need one of {}",
                                    zone.name, zone.frame, fmt::join(frames, ", "))});
    }
  }
}

namespace {

LayoutReport ReportOf(const Layout& layout, const Cycle& cycle, const std::vector<double>& t_s) {
  LayoutReport report;
  report.name = layout.name;
  report.file = layout.file.string();
  report.cycle = cycle.name();
  for (const Viewer& viewer : layout.viewers) report.viewers.push_back(viewer.name);
  report.expense = ExpenseOf(layout);
  report.t_s = t_s;
  return report;
}

template <typename T>
void Append(std::vector<T> more, std::vector<T>* all) {
  std::move(more.begin(), more.end(), std::back_inserter(*all));
}

void RequireMounts(const Layout& layout, const LayoutMeasures& measures) {
  const std::vector<std::string> warnings = measures.MountWarnings();
  if (warnings.empty()) return;
  throw InputError(layout.file.string(), fmt::format("{}", fmt::join(warnings, "\n")));
}

}  // namespace

std::vector<LayoutReport> Evaluate(const Cycle& cycle, const LayoutStudy& study,
                                   std::vector<Layout> layouts, const EvaluateOptions& options) {
  const Scenario& scenario = cycle.scenario();
  const StudiedMachine studied = FindMachine(study, scenario);
  CheckStudy(study, scenario);
  const SceneAssembly assembly(scenario);
  Sighting sighting(scenario, assembly, options.threads);
  const MachineModel& model = scenario.machines[studied.machine].placement.model;
  std::vector<LayoutMeasures> measures;
  std::vector<JointInformation> joints;
  for (Layout& layout : layouts) {
    PutInAir(study.air, &layout);
    measures.emplace_back(study, scenario, assembly, layout);
    joints.emplace_back(model, studied.upper, layout.sensors);
  }
  std::optional<EyeMasking> eye;
  if (study.eye) eye.emplace(*study.eye);
  std::vector<double> t_s;
  const auto look = [&](const Instant& now, const TerrainSurface& ground) {
    t_s.push_back(ToSeconds(now.t_ns));
    if (options.progress) options.progress(t_s.back(), scenario.duration_s);
    sighting.Show(now, ground);
    const LookedAt moment{now, sighting, ground};
    const Places places = measures.front().PlacesOf(moment);
    if (eye) {
      const MachineState& machine = now.machines[studied.machine];
      const Pose& X_WB = machine.links[LinkOfEye(*study.eye, model)].X_WB;
      eye->Add(places.X_WH, X_WB, studied.machine, sighting);
    }
    for (std::size_t l = 0; l < layouts.size(); ++l) {
      MoveViewers(now.machines[studied.machine], &layouts[l]);
      measures[l].CheckMounts(moment, layouts[l]);
      measures[l].Add(moment, places, layouts[l]);
      joints[l].Keep();
    }
  };
  cycle.ForEachMoment(study.rate_hz, look, [&](const Instant& now, const TerrainSurface&) {
    for (JointInformation& of : joints) of.Add(now.t_ns, now.machines[studied.machine]);
  });
  std::vector<LayoutReport> reports;
  for (std::size_t l = 0; l < layouts.size(); ++l) {
    if (options.strict) RequireMounts(layouts[l], measures[l]);
    measures[l].RequirePlaces();
    LayoutReport report = ReportOf(layouts[l], cycle, t_s);
    report.asked_sha256 = Sha256Of(study.resolved_yaml + cycle.resolved_yaml());
    measures[l].Report(&report);
    if (eye) Append(eye->Figures(), &report.figures);
    Append(joints[l].Figures(), &report.figures);
    if (eye) Append(eye->Warnings(), &report.warnings);
    Append(FlatWarnings(layouts[l]), &report.warnings);
    Append(joints[l].Warnings(), &report.warnings);
    reports.push_back(std::move(report));
  }
  return reports;
}

}  // namespace tera

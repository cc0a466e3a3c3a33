#include "layout/optimise/appraisal.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "core/config/spelling.h"
#include "core/error.h"
#include "layout/evaluate.h"
#include "layout/sight/mount_check.h"

namespace tera {
namespace {

constexpr double kBytesPerGB = 1e9;

/// Quantities that a search can limit.
constexpr std::array<const char*, 4> kTaken = {"cost", "power_w", "data_mbyteps", "sensors"};

/// A layout's value of a limited quantity, or nothing if `name` is a figure.
std::optional<double> Taken(const std::string& name, const Layout& layout) {
  const Expense expense = ExpenseOf(layout);
  if (name == "cost") return expense.cost;
  if (name == "power_w") return expense.power_w;
  if (name == "data_mbyteps") return expense.data_mbyteps;
  if (name == "sensors") return static_cast<double>(layout.sensors.size());
  return std::nullopt;
}

std::optional<double> MostOf(const Limits& limits, std::string_view name) {
  if (name == "cost") return limits.cost;
  if (name == "power_w") return limits.power_w;
  if (name == "data_mbyteps") return limits.data_mbyteps;
  return limits.sensors;
}

/// The position in the file, or `otherwise` if there is none.
std::string PlaceOr(const std::string& place, const char* otherwise) {
  return place.empty() ? otherwise : place;
}

/// The part before the first slash.
std::string_view FamilyOf(std::string_view figure) { return figure.substr(0, figure.find('/')); }

/// Suggestions for an unknown objective: the names of its family, or else all families.
std::string InsteadOf(const std::string& figure, const std::vector<std::string>& names) {
  std::vector<std::string> alike, families;
  for (const std::string& name : names) {
    if (FamilyOf(name) == FamilyOf(figure)) alike.push_back(name);
    const bool has_more = name.find('/') != name.npos;
    const std::string family = std::string(FamilyOf(name)) + (has_more ? "/..." : "");
    if (families.empty() || families.back() != family) families.push_back(family);
  }
  return fmt::format("; need one of {}", fmt::join(alike.empty() ? families : alike, ", "));
}

/// The centre and the corners of a mount's bounds.
std::vector<Vec3> PlacesOf(const MountBounds& mount) {
  std::vector<Vec3> places = {0.5 * (mount.low_B_m + mount.high_B_m)};
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 place = mount.low_B_m;
    for (int axis = 0; axis < 3; ++axis) {
      if (corner >> axis & 1) place[axis] = mount.high_B_m[axis];
    }
    places.push_back(place);
  }
  return places;
}

}  // namespace

Appraisal::Appraisal(const LayoutSearch& search, const LayoutStudy& study, const Cycle& cycle,
                     int threads, std::int64_t most_bytes)
    : search_(search),
      study_(study),
      scenario_(cycle.scenario()),
      studied_(FindMachine(study, cycle.scenario())),
      assembly_(cycle.scenario()) {
  CheckStudy(study, scenario_);
  if (!search.keep.empty()) {
    kept_ = cycle.WithRig(studied_.machine, search.keep).machines[studied_.machine].sensors;
  }
  for (const Objective& objective : search.objectives) {
    if (const auto id = FigureIdOf(objective.figure)) wanted_.push_back(*id);
  }
  RequirePlaces();
  RequireWithinLimits();
  RequireReachable();
  const double rate_hz = search.moments / scenario_.duration_s;
  cycle.ForEachMoment(rate_hz, [&](const Instant& now, const TerrainSurface& ground) {
    if (moments_.size() == static_cast<std::size_t>(search.moments)) return;
    moments_.push_back(
        {now, ground, std::make_unique<Sighting>(scenario_, assembly_, threads), {}});
    Moment& moment = moments_.back();
    moment.sighting->Show(now, ground);
    RequireRoom(most_bytes);
    moment.places = MeasuresOf({}).PlacesOf({moment.now, *moment.sighting, moment.ground});
  });
  RequireFigures();
}

std::int64_t Appraisal::HalfOfMemory() {
  return std::int64_t{sysconf(_SC_PHYS_PAGES)} * sysconf(_SC_PAGESIZE) / 2;
}

/// Extrapolates from the moments stored so far. Later moments tend to need more memory, since
/// excavation makes their ground more complex.
void Appraisal::RequireRoom(std::int64_t most_bytes) const {
  double bytes = 0;
  for (const Moment& moment : moments_) bytes += static_cast<double>(moment.sighting->bytes());
  const double all_bytes = bytes / static_cast<double>(moments_.size()) * search_.moments;
  if (all_bytes <= static_cast<double>(most_bytes)) return;
  throw InputError(
      PlaceOr(search_.place, "moments"),
      {FaultKind::kOutOfRange,
       fmt::format("{} moments of this cycle take {:.2g} GB of memory, but {:.2g} GB may be used; "
                   "need about {:.0f} moments, or a smaller site",
                   search_.moments, all_bytes / kBytesPerGB,
                   static_cast<double>(most_bytes) / kBytesPerGB,
                   std::floor(static_cast<double>(most_bytes) / all_bytes * search_.moments))});
}

void Appraisal::RequirePlaces() const {
  for (const SensorSlot& slot : search_.slots) {
    for (const SensorDescription& sensor : kept_) {
      if (sensor.name != slot.name) continue;
      throw InputError(
          PlaceOr(slot.place, "sensors"),
          {FaultKind::kRepeated,
           fmt::format("'{}' is already the name of a kept sensor; need another name", slot.name)});
    }
    for (const MountBounds& mount : slot.mounts) {
      if (model().LinkIndex(mount.link) >= 0) continue;
      std::vector<std::string> links;
      for (const Link& link : model().links) links.push_back(link.name);
      throw InputError(
          PlaceOr(mount.place, "sensors"),
          {FaultKind::kNoSuchName,
           fmt::format("'{}' is mounted on the unknown link '{}'; the machine's links are {}",
                       slot.name, mount.link, fmt::join(links, ", "))});
    }
  }
}

void Appraisal::RequireFigures() {
  const LayoutMeasures measures(study_, scenario_, assembly_, Laid(BoundsOf(search_).high));
  std::vector<std::string> names(kTaken.begin(), kTaken.end());
  for (const Figure& figure : measures.Figures()) names.push_back(NameOf(figure.id));
  for (const Objective& objective : search_.objectives) {
    const std::optional<FigureId> id = FigureIdOf(objective.figure);
    signs_.push_back(id && IsMoreBetter(id->measure) ? -1 : 1);
    if (std::find(names.begin(), names.end(), objective.figure) != names.end()) continue;
    std::string found = fmt::format("there is no figure '{}'{}", objective.figure,
                                    DidYouMean(objective.figure, names));
    if (id && SubjectOf(id->measure) == Subject::kEye) {
      found = fmt::format("'{}' measures masking of the operator's eye, which no layout changes",
                          objective.figure);
    } else if (id && SubjectOf(id->measure) == Subject::kState) {
      found = fmt::format(
          "'{}' depends on inertial units, encoders and antennas, which no search places",
          objective.figure);
    }
    throw InputError(PlaceOr(objective.place, "objectives"),
                     fmt::format("{}{}", found, InsteadOf(objective.figure, names)));
  }
}

void Appraisal::RequireWithinLimits() const {
  if (Beyond(LayoutOfSensors(kept_, model())) <= 0) return;
  throw InputError(PlaceOr(search_.limits.place, "limits"),
                   "the kept sensors already exceed them; raise a limit or keep fewer sensors");
}

/// Smallest possible `name` of a layout that has all mandatory sensors and at least one lidar or
/// camera.
double Appraisal::LeastTaken(const char* name) const {
  const Layout kept = LayoutOfSensors(kept_, model());
  double taken = *Taken(name, kept);
  bool sees = !kept.viewers.empty();
  std::optional<double> least_optional;
  for (const SensorSlot& slot : search_.slots) {
    std::optional<double> least;
    for (const TypeChoice& type : slot.types) {
      Layout alone;
      alone.sensors = {type.sensor};
      const double of_type = *Taken(name, alone);
      least = std::min(least.value_or(of_type), of_type);
    }
    if (slot.optional) {
      least_optional = std::min(least_optional.value_or(*least), *least);
    } else {
      taken += *least;
      sees = true;
    }
  }
  return sees ? taken : taken + least_optional.value_or(0);
}

void Appraisal::RequireReachable() const {
  for (const char* name : kTaken) {
    const std::optional<double> most = MostOf(search_.limits, name);
    if (!most || LeastTaken(name) <= *most) continue;
    throw InputError(PlaceOr(search_.limits.place, "limits"),
                     fmt::format("{} {:.6g} is too low: the mandatory sensors with at least one "
                                 "lidar or camera need {:.6g}; raise it, or make sensors optional",
                                 name, *most, LeastTaken(name)));
  }
}

double Appraisal::Beyond(const Layout& layout) const {
  double beyond = 0;
  for (const char* name : kTaken) {
    const std::optional<double> most = MostOf(search_.limits, name);
    if (!most) continue;
    const double taken = *Taken(name, layout);
    // Any positive amount violates a limit of zero.
    if (taken > *most) beyond += *most > 0 ? taken / *most - 1 : taken;
  }
  return beyond;
}

/// The machine part that contains all of the mount's PlacesOf at every moment, or nothing.
std::optional<std::string> Appraisal::PartAround(const SensorSlot& slot,
                                                 const MountBounds& mount) const {
  std::vector<SensorDescription> sensors;
  for (const Vec3& place_B_m : PlacesOf(mount)) {
    sensors.push_back(slot.types.front().sensor);
    sensors.back().name = std::to_string(sensors.size());
    sensors.back().link = mount.link;
    sensors.back().X_BS = MakePose(place_B_m);
  }
  Layout layout = LayoutOfSensors(std::move(sensors), model());
  std::string part;
  for (const Moment& moment : moments_) {
    MoveViewers(moment.now.machines[studied_.machine], &layout);
    MountCheck check;
    check.Add(studied_.machine, layout.viewers, *moment.sighting);
    std::set<std::string> buried;
    for (const BuriedMount& one : check.Buried()) buried.insert(one.viewer);
    if (buried.size() < layout.viewers.size()) return std::nullopt;
    part = check.Buried().front().part;
  }
  return part;
}

std::vector<std::string> Appraisal::Warnings() const {
  std::vector<std::string> warnings;
  for (const SensorSlot& slot : search_.slots) {
    for (const MountBounds& mount : slot.mounts) {
      const std::optional<std::string> part = PartAround(slot, mount);
      if (!part) continue;
      warnings.push_back(
          fmt::format("{}: a mount of '{}' lies inside {} everywhere within its bounds and sees "
                      "nothing else; need bounds in free air",
                      PlaceOr(mount.place, "sensors"), slot.name, *part));
    }
  }
  return warnings;
}

LayoutMeasures Appraisal::MeasuresOf(const Layout& layout) const {
  return LayoutMeasures(study_, scenario_, assembly_, layout, wanted_);
}

Layout Appraisal::Laid(const Genes& genes) const {
  Layout layout = LayoutOf(search_, genes, kept_, model());
  PutInAir(study_.air, &layout);
  return layout;
}

Appraised Appraisal::Of(Layout layout) const {
  LayoutMeasures measures = MeasuresOf(layout);
  for (const Moment& moment : moments_) {
    MoveViewers(moment.now.machines[studied_.machine], &layout);
    measures.Add({moment.now, *moment.sighting, moment.ground}, moment.places, layout);
  }
  const std::vector<Figure> figures = measures.Figures();
  constexpr double kSeesNothing = 1;  // equals the violation of a layout that takes twice a limit
  Appraised appraised{{}, Beyond(layout) + (layout.viewers.empty() ? kSeesNothing : 0)};
  for (const Objective& objective : search_.objectives) {
    if (const std::optional<double> taken = Taken(objective.figure, layout)) {
      appraised.objectives.push_back(*taken);
      continue;
    }
    const FigureId id = *FigureIdOf(objective.figure);
    const auto figure =
        std::find_if(figures.begin(), figures.end(), [&](const Figure& f) { return f.id == id; });
    const double value = objective.at_worst ? WorstOf(*figure) : MeanOf(*figure);
    appraised.objectives.push_back(IsMoreBetter(id.measure) ? -value : value);
  }
  return appraised;
}

}  // namespace tera

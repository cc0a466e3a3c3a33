#include "layout/optimise/appraisal.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "core/error.h"
#include "layout/evaluate.h"

namespace tera {
namespace {

constexpr double kBytesPerGB = 1e9;

/// What a layout takes of a name, if it is no figure of what it sees.
std::optional<double> Taken(const std::string& name, const Layout& layout) {
  const Expense expense = ExpenseOf(layout);
  if (name == "cost") return expense.cost;
  if (name == "power_w") return expense.power_w;
  if (name == "data_mbyteps") return expense.data_mbyteps;
  if (name == "sensors") return static_cast<double>(layout.sensors.size());
  return std::nullopt;
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
  for (const Objective& objective : search.objectives) wanted_.push_back(objective.figure);
  RequirePlaces();
  RequireWithinLimits();
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

/// By what the moments so far take; later ones, whose ground is dug up more, take more rather.
void Appraisal::RequireRoom(std::int64_t most_bytes) const {
  double bytes = 0;
  for (const Moment& moment : moments_) bytes += static_cast<double>(moment.sighting->bytes());
  const double all_bytes = bytes / static_cast<double>(moments_.size()) * search_.moments;
  if (all_bytes <= static_cast<double>(most_bytes)) return;
  throw InputError(fmt::format(
      "moments: {} of this cycle take {:.2g} GB of memory, of which {:.2g} GB may be used; need "
      "about {:.0f}, or a smaller site",
      search_.moments, all_bytes / kBytesPerGB, static_cast<double>(most_bytes) / kBytesPerGB,
      std::floor(static_cast<double>(most_bytes) / all_bytes * search_.moments)));
}

void Appraisal::RequirePlaces() const {
  const MachineModel& model = scenario_.machines[studied_.machine].placement.model;
  for (const SensorSlot& slot : search_.slots) {
    for (const SensorDescription& sensor : kept_) {
      if (sensor.name != slot.name) continue;
      throw InputError(fmt::format(
          "sensors: '{}' is the name of a sensor that is kept; need another", slot.name));
    }
    for (const MountBounds& mount : slot.mounts) {
      if (model.LinkIndex(mount.link) >= 0) continue;
      std::vector<std::string> links;
      for (const Link& link : model.links) links.push_back(link.name);
      throw InputError(
          fmt::format("sensors: '{}' is mounted on '{}', which the machine has not; "
                      "its links are {}",
                      slot.name, mount.link, fmt::join(links, ", ")));
    }
  }
}

void Appraisal::RequireFigures() {
  const LayoutMeasures measures(study_, scenario_, assembly_, Laid(BoundsOf(search_).high));
  std::vector<std::string> names = {"cost", "power_w", "data_mbyteps", "sensors"};
  std::set<std::string> to_be_large;
  for (const Figure& figure : measures.Figures()) {
    names.push_back(figure.name);
    if (figure.more_is_better) to_be_large.insert(figure.name);
  }
  for (const Objective& objective : search_.objectives) {
    signs_.push_back(to_be_large.contains(objective.figure) ? -1 : 1);
    if (std::find(names.begin(), names.end(), objective.figure) != names.end()) continue;
    const bool is_of_eye = objective.figure.starts_with("eye/");
    throw InputError(fmt::format(
        "objectives: {}; need one of {}",
        is_of_eye
            ? fmt::format("'{}' is what the machine hides from an eye, which no layout changes",
                          objective.figure)
            : fmt::format("no figure '{}'", objective.figure),
        fmt::join(names, ", ")));
  }
}

void Appraisal::RequireWithinLimits() const {
  Layout kept = LayoutOfSensors(kept_, scenario_.machines[studied_.machine].placement.model);
  if (Beyond(kept) <= 0) return;
  throw InputError(
      "limits: the sensors that are kept are beyond them already; raise a limit or keep fewer");
}

double Appraisal::Beyond(const Layout& layout) const {
  const Limits& limits = search_.limits;
  double beyond = 0;
  for (const auto& [name, most] : {std::pair{"cost", limits.cost},
                                   {"power_w", limits.power_w},
                                   {"data_mbyteps", limits.data_mbyteps},
                                   {"sensors", limits.sensors}}) {
    if (!most) continue;
    const double taken = *Taken(name, layout);
    // A limit of nothing is gone beyond by whatever is taken.
    if (taken > *most) beyond += *most > 0 ? taken / *most - 1 : taken;
  }
  return beyond;
}

LayoutMeasures Appraisal::MeasuresOf(const Layout& layout) const {
  return LayoutMeasures(study_, scenario_, assembly_, layout, wanted_);
}

Layout Appraisal::Laid(const Genes& genes) const {
  return LayoutOf(search_, genes, kept_, scenario_.machines[studied_.machine].placement.model);
}

Appraised Appraisal::Of(Layout layout) const {
  LayoutMeasures measures = MeasuresOf(layout);
  for (const Moment& moment : moments_) {
    MoveViewers(moment.now.machines[studied_.machine], &layout);
    measures.Add({moment.now, *moment.sighting, moment.ground}, moment.places, layout);
  }
  const std::vector<Figure> figures = measures.Figures();
  Appraised appraised{{}, Beyond(layout)};
  for (const Objective& objective : search_.objectives) {
    if (const std::optional<double> taken = Taken(objective.figure, layout)) {
      appraised.objectives.push_back(*taken);
      continue;
    }
    const auto figure = std::find_if(figures.begin(), figures.end(),
                                     [&](const Figure& f) { return f.name == objective.figure; });
    const double value = objective.at_worst ? WorstOf(*figure) : MeanOf(*figure);
    appraised.objectives.push_back(figure->more_is_better ? -value : value);
  }
  return appraised;
}

}  // namespace tera

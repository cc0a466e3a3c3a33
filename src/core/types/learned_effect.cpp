#include "core/types/learned_effect.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/config/config_layers.h"

namespace tera {
namespace {

constexpr std::size_t kMostKnots = 1000;
constexpr double kMostShare = 9;  ///< a share of 9 gives ten times the rate

constexpr std::string_view kNeed =
    "a table, {variable: NAME, unit: UNIT, as: added or share, at: [..], value: [..], low: [..], "
    "high: [..]}, or none to take it away";

/// Returns the variable that `map` names. For an unknown name, reports a fault and returns the
/// first variable.
LearnedVariable ReadVariable(const ConfigMap& map, std::span<const LearnedVariable> variables) {
  const std::string name = map.Text("variable"), unit = map.Text("unit");
  const auto at = std::find_if(variables.begin(), variables.end(),
                               [&](const LearnedVariable& one) { return one.name == name; });
  if (at == variables.end()) {
    std::vector<std::string> names;
    for (const LearnedVariable& one : variables) names.push_back(one.name);
    if (!name.empty()) {
      map.Fault("variable", {FaultKind::kNoSuchName,
                             fmt::format("'{}' is no variable that a simulation knows here, need "
                                         "one of {}",
                                         name, fmt::join(names, ", "))});
    }
    return variables.front();
  }
  if (!unit.empty() && unit != at->unit) {
    map.Fault("unit", fmt::format("'{}' found, but {} is in {}; need that, and the knots in it",
                                  unit, name, at->unit));
  }
  return *at;
}

void CheckKnots(const ConfigMap& map, const std::vector<double>& at) {
  for (std::size_t k = 1; k < at.size(); ++k) {
    if (at[k] > at[k - 1]) continue;
    map.Fault("at", fmt::format("{:g} follows {:g}, need knots that increase from each to the next",
                                at[k], at[k - 1]));
    return;
  }
}

void CheckBand(const ConfigMap& map, const LearnedEffect& learned) {
  for (std::size_t k = 0; k < learned.at.size(); ++k) {
    if (learned.low[k] <= learned.value[k] && learned.value[k] <= learned.high[k]) continue;
    map.Fault("value",
              fmt::format("{:g} at {:g} is not within its band from {:g} to {:g}, need "
                          "low <= value <= high at every knot",
                          learned.value[k], learned.at[k], learned.low[k], learned.high[k]));
    return;
  }
}

/// Reads the lists and reports only the first fault among them.
void ReadTable(const ConfigMap& map, LearnedEffect* learned) {
  const std::size_t before = internal::ConfigDocument::FaultsWith(map);
  learned->at = map.Numbers("at", Any(learned->variable.unit), 2, kMostKnots);
  const Range each = learned->is_share ? Between(-1, kMostShare, "1") : Any("rad/s or m/s");
  const Range band = Any(each.unit);
  learned->value = map.Numbers("value", each, 2, kMostKnots);
  const bool has_band = map.Has("low") || map.Has("high");
  learned->low = has_band ? map.Numbers("low", band, 2, kMostKnots) : learned->value;
  learned->high = has_band ? map.Numbers("high", band, 2, kMostKnots) : learned->value;
  if (internal::ConfigDocument::FaultsWith(map) > before) return;
  for (const auto& [key, list] :
       {std::pair("value", &learned->value), {"low", &learned->low}, {"high", &learned->high}}) {
    if (list->size() == learned->at.size()) continue;
    map.Fault(key, fmt::format("{} numbers found, but 'at' has {} knots; need one for each",
                               list->size(), learned->at.size()));
    return;
  }
  CheckKnots(map, learned->at);
  CheckBand(map, *learned);
}

/// Value at the distance `beyond` outside the end knot: falls linearly from `end` to 0 over
/// `interval`.
double Tapered(double end, double beyond, double interval) {
  return end * std::max(0.0, 1 - beyond / interval);
}

}  // namespace

double LearnedEffect::At(double x) const {
  const std::size_t last = at.size() - 1;
  if (x <= at[0]) return Tapered(value[0], at[0] - x, at[1] - at[0]);
  if (x >= at[last]) return Tapered(value[last], x - at[last], at[last] - at[last - 1]);
  const auto above =
      static_cast<std::size_t>(std::upper_bound(at.begin(), at.end(), x) - at.begin());
  const double part = (x - at[above - 1]) / (at[above] - at[above - 1]);
  return std::lerp(value[above - 1], value[above], part);
}

std::optional<LearnedEffect> ReadLearnedEffect(const ConfigMap& target,
                                               std::span<const LearnedVariable> variables) {
  const auto map = internal::ConfigDocument::MapOrNone(target, "learned", std::string(kNeed));
  if (!map) return std::nullopt;
  LearnedEffect learned;
  learned.variable = ReadVariable(*map, variables);
  learned.is_share = map->Choice("as", {"added", "share"}) == "share";
  ReadTable(*map, &learned);
  return learned;
}

}  // namespace tera

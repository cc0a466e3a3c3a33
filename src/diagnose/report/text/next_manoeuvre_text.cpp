#include "diagnose/report/text/next_manoeuvre_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>
#include <vector>

#include "diagnose/report/text/wording.h"

namespace tera {
namespace {

std::vector<std::string> SpacedAll(const std::vector<std::string>& identifiers) {
  std::vector<std::string> names;
  for (const std::string& identifier : identifiers) names.push_back(Spaced(identifier));
  return names;
}

constexpr std::size_t kMostNamed = 3;  ///< mechanisms of a target that are named one by one

/// Mechanisms that could not be seen, by target: "backlash and sag of the boom", "12 mechanisms of
/// the slew".
std::vector<std::string> Shown(const std::vector<DiscriminatedSet>& sets) {
  std::vector<std::pair<std::string, std::vector<std::string>>> by_target;
  for (const DiscriminatedSet& set : sets) {
    if (set.is_class) continue;
    if (by_target.empty() || by_target.back().first != set.target) {
      by_target.push_back({set.target, {}});
    }
    by_target.back().second.push_back(Spaced(set.members.front()));
  }
  std::vector<std::string> parts;
  for (const auto& [target, names] : by_target) {
    const std::string what =
        names.size() > kMostNamed ? fmt::format("{} mechanisms", names.size()) : Listed(names);
    parts.push_back(fmt::format("{} of the {}", what, Spaced(target)));
  }
  return parts;
}

}  // namespace

std::string SentenceOf(const NextManoeuvre& next) {
  std::vector<std::string> does;
  for (const DiscriminatedSet& set : next.discriminated) {
    if (!set.is_class) continue;
    does.push_back(fmt::format("tells {} of the {} apart", Listed(SpacedAll(set.members)),
                               Spaced(set.target)));
  }
  if (const auto shown = Shown(next.discriminated); !shown.empty()) {
    does.push_back("would show " + Listed(shown));
  }
  std::string text = fmt::format("Next manoeuvre ({}, {:.0f} s; {}): {}. Power {} at least.",
                                 kNextManoeuvreFile, next.duration_s, next.description,
                                 fmt::join(does, "; "), Significant(next.power, 2));
  for (const DiscriminatedSet& set : next.not_discriminated) {
    if (!set.is_class) continue;
    text += fmt::format(" It does not tell {} of the {} apart.", Listed(SpacedAll(set.members)),
                        Spaced(set.target));
  }
  if (!next.deferred.empty()) {
    text += fmt::format(" Left for another: {}.", Listed(SpacedAll(next.deferred)));
  }
  return text;
}

std::string CsvOf(const NextManoeuvre& next) {
  std::string csv = fmt::format("t_ns,{}\n", fmt::join(next.commands.columns, ","));
  for (std::size_t r = 0; r < next.commands.rows.size(); ++r) {
    csv += fmt::format("{}", next.commands.t_ns[r]);
    for (const double lever : next.commands.rows[r]) csv += fmt::format(",{:.4g}", lever);
    csv += "\n";
  }
  return csv;
}

}  // namespace tera

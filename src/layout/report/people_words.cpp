#include "layout/report/people_words.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "layout/report/words.h"

namespace tera {
namespace {

std::string PostureLine(const LayoutReport& report, const std::string& posture) {
  // Indices in kQuarters, from the quarter that is hardest to see.
  constexpr std::array<std::pair<std::size_t, const char*>, 4> kSides = {
      {{2, "behind"}, {1, "to the left"}, {3, "to the right"}, {0, "ahead"}}};
  std::vector<std::string> always, never;
  for (const auto& [quarter, side] : kSides) {
    const std::optional<AlwaysDetected> at = AlwaysDetectedIn(report, posture, quarter);
    if (!at) continue;
    if (at->IsNowhere()) {
      never.emplace_back(side);
    } else {
      always.push_back(fmt::format("{1} {0}", side, RangeText(*at)));
    }
  }
  if (always.empty() && never.empty()) return "";
  const std::string person = "A " + Spaced(posture) + " person is ";
  if (always.empty()) {
    return person + "nowhere detected at every moment in all directions of a quarter.";
  }
  std::string line = fmt::format("{}detected at every moment {}", person, fmt::join(always, ", "));
  if (!never.empty()) line += fmt::format("; at no distance {}", fmt::join(never, ", "));
  return line + ".";
}

/// The posture that is detected at the fewest places.
std::string HardestPosture(const LayoutReport& report) {
  const Figure* hardest = nullptr;
  std::string name;
  const std::vector<std::string> postures = PosturesOf(report);
  for (const std::string& posture : postures) {
    const Figure* share = FindFigure(report, {Measure::kDetectedShare, posture});
    if (hardest && WorstOf(*share) >= WorstOf(*hardest)) continue;
    hardest = share;
    name = posture;
  }
  if (postures.size() < 2) return "";
  return fmt::format(
      "A {} person is the hardest to detect; share of the places up to 12 m from the machine: {}.",
      Spaced(name), MeanAndWorstText(report, *hardest));
}

}  // namespace

std::vector<std::string> PosturesOf(const LayoutReport& report) {
  std::vector<std::string> postures;
  for (const Figure& figure : report.figures) {
    if (figure.id.measure == Measure::kDetectedShare) postures.push_back(figure.id.of);
  }
  return postures;
}

std::optional<AlwaysDetected> AlwaysDetectedIn(const LayoutReport& report,
                                               const std::string& posture, std::size_t quarter) {
  const Figure* from = FindFigure(report, {Measure::kDetectedFrom, posture, quarter});
  const Figure* to = FindFigure(report, {Measure::kDetectedTo, posture, quarter});
  const Figure* over = FindFigure(report, {Measure::kDetectedOver, posture, quarter});
  if (!from || !to || !over) return std::nullopt;
  AlwaysDetected always{.from_m = WorstOf(*from), .to_m = WorstOf(*to)};
  constexpr double kStep_m = 1;  // between the tested distances
  for (std::size_t m = 0; m < over->at.size(); ++m) {
    always.has_gaps |= over->at[m] < to->at[m] - from->at[m] + 0.5 * kStep_m;
  }
  return always;
}

std::string RangeText(const AlwaysDetected& always) {
  if (always.IsNowhere()) return "at no distance";
  if (always.from_m == always.to_m) return fmt::format("at {:.0f} m", always.to_m);
  return fmt::format("from {:.0f} to {:.0f} m{}", always.from_m, always.to_m,
                     always.has_gaps ? " (with gaps)" : "");
}

std::string QuartersText() {
  return "The quarters ahead, left, behind and right hold all directions within 45° of straight "
         "ahead, left, back and right of the upper structure. For people, the worst direction of a "
         "quarter decides. Distances of people run from the machine's outline (undercarriage, "
         "tracks, blade and upper structure from above) to the middle of the person. For camera "
         "pixels, distances run from the upper structure's origin, and a quarter has the mean over "
         "its directions.";
}

std::vector<std::string> PeopleAnswer(const LayoutReport& report) {
  std::vector<std::string> lines = {HardestPosture(report)};
  for (const std::string& posture : PosturesOf(report)) {
    lines.push_back(PostureLine(report, posture));
  }
  std::erase(lines, "");
  if (const Figure* p = FindFigure(report, {Measure::kProbability, "standing"})) {
    lines.push_back(
        fmt::format("Probability that lidars detect a standing person up to 12 m from the machine, "
                    "mean over the places: {}.",
                    MeanAndWorstText(report, *p)));
  }
  return lines;
}

}  // namespace tera

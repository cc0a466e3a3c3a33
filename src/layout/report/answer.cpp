#include "layout/report/answer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <utility>

#include "layout/report/people_words.h"
#include "layout/report/words.h"
#include "layout/study/zone.h"

namespace tera {
namespace {

constexpr double kPercent = 100;

/// The most frequent cause, and the second if its share is at least a tenth.
std::string MainCauses(const std::map<std::string, double>& causes) {
  std::vector<std::pair<double, std::string>> by_share;
  for (const auto& [name, share] : causes) by_share.emplace_back(share, name);
  std::sort(by_share.rbegin(), by_share.rend());
  constexpr double kWorthSaying = 0.05;
  constexpr std::size_t kMost = 4;
  std::vector<std::string> said;
  for (const auto& [share, name] : by_share) {
    if (said.size() == kMost || share < kWorthSaying) break;
    said.push_back(fmt::format("{} {:.0f} %", name, kPercent * share));
  }
  return fmt::format("{}", fmt::join(said, ", "));
}

}  // namespace

std::vector<std::string> Answer(const LayoutReport& report) {
  std::vector<std::string> lines;
  if (const Figure* seen = FindFigure(report, {Measure::kSeenBy1, kAroundZone})) {
    lines.push_back(fmt::format("Coverage of the space around the machine: {}.",
                                MeanAndWorstText(report, *seen)));
  }
  const auto causes = report.blind_causes.find(kAroundZone);
  const Figure* blind = FindFigure(report, {Measure::kBlindVolume, kAroundZone});
  if (blind && causes != report.blind_causes.end() && !causes->second.empty()) {
    lines.push_back(fmt::format("Blind volume: {}; main causes: {}.",
                                MeanAndWorstText(report, *blind), MainCauses(causes->second)));
  }
  for (std::string& line : PeopleAnswer(report)) lines.push_back(std::move(line));
  const std::string shovel = DiggingShovel(report);
  if (const Figure* edge = FindFigure(report, {Measure::kEdgeSeen, shovel})) {
    lines.push_back(fmt::format("Coverage of the {}'s cutting edge: {}.", Spaced(shovel),
                                MeanAndWorstText(report, *edge)));
  }
  return lines;
}

}  // namespace tera

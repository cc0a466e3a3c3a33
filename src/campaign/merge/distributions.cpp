#include "campaign/merge/distributions.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "core/parse_number.h"

namespace tera {
namespace {

constexpr std::size_t kMostCounted = 12;  ///< largest number of different values that a row lists

/// Value below which the fraction `share` of sorted numbers lies.
double AtShare(const std::vector<double>& sorted, double share) {
  return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1) + 0.5)];
}

std::string CountsOf(const std::vector<std::string>& texts) {
  std::map<std::string, int> counts;
  for (const std::string& text : texts) ++counts[text];
  if (counts.size() > kMostCounted) return fmt::format("{} different values", counts.size());
  std::string row;
  for (const auto& [text, count] : counts) {
    row += fmt::format("{}{}: {}", row.empty() ? "" : ", ", text, count);
  }
  return row;
}

std::string RowOf(const std::vector<std::string>& texts) {
  std::vector<double> numbers;
  for (const std::string& text : texts) {
    const auto number = ParseFinite(text);
    if (!number) return CountsOf(texts);
    numbers.push_back(*number);
  }
  std::sort(numbers.begin(), numbers.end());
  if (numbers.front() == numbers.back()) return fmt::format("{:.4g}", numbers.front());
  return fmt::format("{:.4g} to {:.4g}; quartiles {:.4g}, {:.4g}, {:.4g}", numbers.front(),
                     numbers.back(), AtShare(numbers, 0.25), AtShare(numbers, 0.5),
                     AtShare(numbers, 0.75));
}

std::string RangesRow(const char* name, const RangeHistogram& counts) {
  const std::int64_t all = std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
  if (all == 0) return "";
  std::string row = fmt::format("| {} | {} |", name, all);
  for (const double share : {0.1, 0.5, 0.9}) {
    std::int64_t sum = 0;
    std::size_t bin = 0;
    while (bin + 1 < counts.size() &&
           static_cast<double>(sum + counts[bin]) < share * static_cast<double>(all)) {
      sum += counts[bin++];
    }
    row += fmt::format(" {} |", bin + 1);
  }
  return row + "\n";
}

}  // namespace

std::string ValuesTable(const CampaignState& state) {
  std::map<std::string, std::vector<std::string>> values;
  for (const auto& [_, record] : state.done) {
    for (const auto& [key, text] : record.values) values[key].push_back(text);
  }
  std::string table = "| key | episodes | values |\n| --- | --- | --- |\n";
  for (const auto& [key, texts] : values) {
    table += fmt::format("| `{}` | {} | {} |\n", key, texts.size(), RowOf(texts));
  }
  return table;
}

std::string ContentsTable(const DatasetStatistics& statistics) {
  std::string table = "| class | pixels | boxes | points |\n| --- | --- | --- | --- |\n";
  for (const auto& [name, of_class] : statistics.classes) {
    table += fmt::format("| {} | {} | {} | {} |\n", name, of_class.pixels, of_class.boxes,
                         of_class.points);
  }
  const std::string ranges =
      RangesRow("depth pictures", statistics.depth_m) + RangesRow("scans", statistics.range_m);
  if (ranges.empty()) return table;
  return table +
         "\n| ranges of | count | 10 % within m | 50 % | 90 % |\n| --- | --- | --- | --- | --- "
         "|\n" +
         ranges;
}

void AddCounts(const DatasetStatistics& of_episode, DatasetStatistics* sum) {
  for (const auto& [name, of_class] : of_episode.classes) {
    ClassStatistics& total = sum->classes[name];
    total.pixels += of_class.pixels;
    total.boxes += of_class.boxes;
    total.points += of_class.points;
  }
  for (std::size_t bin = 0; bin < sum->depth_m.size(); ++bin) {
    sum->depth_m[bin] += of_episode.depth_m[bin];
    sum->range_m[bin] += of_episode.range_m[bin];
  }
  sum->pictures += of_episode.pictures;
  sum->scans += of_episode.scans;
  sum->boxes += of_episode.boxes;
  sum->points += of_episode.points;
}

std::string CampaignReport(const Plan& plan, const CampaignState& state) {
  std::string text =
      fmt::format("# {}\n\n```\n{}```\n\n", plan.campaign.name, StatusText(plan, state));
  if (state.done.empty()) return text;
  double wall_s = 0, simulated_s = 0, mb = 0;
  std::map<std::string, int> hosts;
  for (const auto& [_, record] : state.done) {
    wall_s += record.wall_s;
    simulated_s += record.simulated_s;
    mb += 1e-6 * static_cast<double>(record.bytes);
    ++hosts[record.host];
  }
  const auto count = static_cast<double>(state.done.size());
  text += fmt::format(
      "| of an episode | mean | all |\n| --- | --- | --- |\n| simulated s | {:.2f} | {:.1f} |\n"
      "| wall s | {:.2f} | {:.1f} |\n| MB on disk | {:.2f} | {:.1f} |\n| MB of memory, peak | | "
      "{:.0f} |\n| computers | | {} |\n\n",
      simulated_s / count, simulated_s, wall_s / count, wall_s, mb / count, mb,
      state.LargestPeakMb(), hosts.size());
  return text + ValuesTable(state);
}

}  // namespace tera

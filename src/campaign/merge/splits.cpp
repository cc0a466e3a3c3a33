#include "campaign/merge/splits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/config/spelling.h"
#include "core/error.h"
#include "core/random.h"

namespace tera {
namespace {

std::string GroupOf(const Splits& splits, const EpisodeRecord& record) {
  if (splits.by.empty()) return fmt::format("{}", record.number);
  std::string group;
  for (const std::string& key : splits.by) {
    const auto value = record.values.find(key);
    if (value != record.values.end()) {
      group += fmt::format("{}={};", key, value->second);
      continue;
    }
    std::vector<std::string> known;
    for (const auto& [name, _] : record.values) known.push_back(name);
    throw InputError(
        "splits.by",
        {FaultKind::kNoSuchName, fmt::format("'{}' is neither a factor nor drawn in episode {}{}; "
                                             "name a key that varies",
                                             key, record.number, DidYouMean(key, known))});
  }
  return group;
}

}  // namespace

std::map<int, std::string> PartsOf(const Campaign& campaign,
                                   const std::map<int, EpisodeRecord>& records) {
  const Splits& splits = campaign.splits;
  std::map<int, std::string> parts;
  if (splits.shares.empty()) {
    for (const auto& [number, _] : records) parts[number] = "";
    return parts;
  }
  std::map<std::pair<std::uint64_t, std::string>, std::vector<int>> groups;
  for (const auto& [number, record] : records) {
    const std::string group = GroupOf(splits, record);
    groups[{HashText(fmt::format("{}/{}/{}", campaign.name, campaign.seed, group)), group}]
        .push_back(number);
  }
  if (groups.size() < splits.shares.size()) {
    throw InputError("splits", {FaultKind::kInconsistent,
                                fmt::format("{} groups of equal values cannot fill {} parts; vary "
                                            "the keys of splits.by more, or name fewer parts",
                                            groups.size(), splits.shares.size())});
  }
  std::vector<double> lacking;
  for (const auto& [_, share] : splits.shares) {
    lacking.push_back(share * static_cast<double>(records.size()));
  }
  std::size_t left = groups.size();
  std::vector<bool> is_empty(lacking.size(), true);
  for (const auto& [_, numbers] : groups) {
    auto most = std::max_element(lacking.begin(), lacking.end());
    // The last groups go to splits that are still empty.
    if (left-- <= static_cast<std::size_t>(std::ranges::count(is_empty, true))) {
      most = lacking.begin() + (std::ranges::find(is_empty, true) - is_empty.begin());
    }
    is_empty[static_cast<std::size_t>(most - lacking.begin())] = false;
    *most -= static_cast<double>(numbers.size());
    const std::string& part = splits.shares[static_cast<std::size_t>(most - lacking.begin())].first;
    for (const int number : numbers) parts[number] = part;
  }
  return parts;
}

}  // namespace tera

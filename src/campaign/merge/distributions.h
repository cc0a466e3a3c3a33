#pragma once

#include <string>

#include "campaign/work/index.h"
#include "dataset/lint/lint.h"

namespace tera {

/// Markdown table of the values that factors and draws took: quartiles of numbers, and counts of
/// other values.
std::string ValuesTable(const CampaignState& state);

/// Markdown tables of classes and measured ranges.
std::string ContentsTable(const DatasetStatistics& statistics);

/// Adds the counts of classes, ranges, images, scans, boxes and points to `sum`.
void AddCounts(const DatasetStatistics& of_episode, DatasetStatistics* sum);

/// Markdown report of a campaign: state, values, and computing cost of episodes.
std::string CampaignReport(const Plan& plan, const CampaignState& state);

}  // namespace tera

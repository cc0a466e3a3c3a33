#pragma once

#include <string>

#include "campaign/work/index.h"
#include "dataset/lint/lint.h"

namespace tera {

/// Table (Markdown) of the values that factors and draws took: numbers by their quartiles, other
/// values by their counts.
std::string ValuesTable(const CampaignState& state);

/// Tables (Markdown) of classes and of measured ranges.
std::string ContentsTable(const DatasetStatistics& statistics);

/// Adds the counts of classes, ranges, pictures, scans, boxes and points.
void AddCounts(const DatasetStatistics& of_episode, DatasetStatistics* sum);

/// Report (Markdown) of a campaign: its state, its values, and its episodes' costs.
std::string CampaignReport(const Plan& plan, const CampaignState& state);

}  // namespace tera

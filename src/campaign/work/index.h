#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "campaign/plan/plan.h"
#include "campaign/work/episode_record.h"

namespace tera {

/// Episodes of a campaign by state.
struct CampaignState {
  std::map<int, EpisodeRecord> done;
  std::map<int, Failure> failed;
  std::set<int> begun;       ///< in work/: running or interrupted
  std::vector<int> missing;  ///< neither done nor failed, in ascending order

  double LargestPeakMb() const;  ///< largest peak memory of an episode; 0 if none is done
  double MeanWall_s() const;     ///< mean duration of an episode; 0 if none is done
};

/// Updates index.sqlite to the content of the folder and returns the state. The index can be
/// deleted, because it is derived from the folder. Its table `episodes` has one row per complete or
/// failed episode.
///
/// Throws  InputError if the index or an episode belongs to another campaign, or if the file is not
///         an index.
CampaignState RefreshIndex(const Plan& plan);

/// Status report: counts, reasons of failures, and rejections by rule.
std::string StatusText(const Plan& plan, const CampaignState& state);

/// Deletes failures for which a retry may succeed, or all failures. Returns their number.
int ClearFailures(const Plan& plan, bool all);

}  // namespace tera

#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "campaign/plan/plan.h"
#include "campaign/work/episode_record.h"

namespace tera {

/// Episodes of a campaign by how far they are.
struct CampaignState {
  std::map<int, EpisodeRecord> done;
  std::map<int, Failure> failed;
  std::set<int> begun;       ///< in work/: at work now, or stopped
  std::vector<int> missing;  ///< neither done nor failed, in order

  double LargestPeakMb() const;  ///< 0 without episodes
  double MeanWall_s() const;     ///< 0 without episodes
};

/// Updates index.sqlite to the folder's contents, and returns it. The index is derived: deleted, it
/// is made anew. Table `episodes` has a row of each episode that is whole or failed.
///
/// Throws  InputError: an index or an episode of another campaign, a file that is no index.
CampaignState RefreshIndex(const Plan& plan);

/// Report for people: counts, reasons, refusals by rule.
std::string StatusText(const Plan& plan, const CampaignState& state);

/// Clears the failures of which another try may end otherwise, or all. Returns their number.
int ClearFailures(const Plan& plan, bool all);

}  // namespace tera

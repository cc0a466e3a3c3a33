#pragma once

#include <map>
#include <string>

#include "campaign/plan/campaign.h"
#include "campaign/work/episode_record.h"

namespace tera {

/// Split of each episode, by episode number. All are empty if the campaign has no splits.
///
/// Model   Episodes with equal values of `by` form a group; without `by`, each episode is a group.
///         Groups are sorted by a hash of their values. Each group goes to the split that is
///         furthest below its share; the last groups go to splits that are still empty. The result
///         depends only on the records.
/// Throws  InputError if an episode has no value for a key, or if there are fewer groups than
///         splits.
std::map<int, std::string> PartsOf(const Campaign& campaign,
                                   const std::map<int, EpisodeRecord>& records);

}  // namespace tera

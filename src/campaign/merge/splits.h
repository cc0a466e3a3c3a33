#pragma once

#include <map>
#include <string>

#include "campaign/plan/campaign.h"
#include "campaign/work/episode_record.h"

namespace tera {

/// The part of each episode, by number; all empty without splits.
///
/// Model   episodes of equal values of `by` are a group; without `by` each is its own. Groups, in
///         the order of a hash of their values, go to the part that lacks most of its share. The
///         result depends on the records alone.
/// Throws  InputError if an episode has no value of a key, and if there are fewer groups than
/// parts.
std::map<int, std::string> PartsOf(const Campaign& campaign,
                                   const std::map<int, EpisodeRecord>& records);

}  // namespace tera

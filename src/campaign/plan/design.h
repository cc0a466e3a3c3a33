#pragma once

#include <string>
#include <vector>

#include "campaign/plan/campaign.h"

namespace tera {

struct SetValue {
  std::string key, yaml;
};

/// Values of the factors in episode `number`, counted from 0. The result is a pure function of the
/// campaign.
///
/// Model   full: all combinations of levels in order, with the last factor fastest.
///         latin_hypercube: one random permutation of strata per factor, and a random position
///         within the stratum. sobol: the sequence without its first point, the origin. A factor
///         with levels divides the unit interval into equal parts.
/// Source  McKay, Beckman, Conover 1979; Joe, Kuo 2008, by Boost.Random.
std::vector<SetValue> DesignPoint(const Campaign& campaign, int number);

}  // namespace tera

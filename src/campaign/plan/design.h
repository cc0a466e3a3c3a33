#pragma once

#include <string>
#include <vector>

#include "campaign/plan/campaign.h"

namespace tera {

/// A key and its value, as YAML.
struct SetValue {
  std::string key, yaml;
};

/// The values of the factors in episode `number`, from 0: a pure function of the campaign.
///
/// Model   full takes combinations of levels in turn, the last factor fastest. latin_hypercube has
///         one random permutation of strata for each factor, and a random place in each stratum.
///         sobol is the sequence without its first point, the origin. Levels share a factor's range
///         evenly.
/// Source  McKay, Beckman, Conover 1979; Joe, Kuo 2008, by Boost.Random.
std::vector<SetValue> DesignPoint(const Campaign& campaign, int number);

}  // namespace tera

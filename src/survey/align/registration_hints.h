#pragma once

#include <string>
#include <vector>

#include "survey/align/registration.h"

namespace tera {

/// Sentences that say why two clouds could not be registered. Either one cloud fits at the scale of
/// another unit, or the clouds lie as far apart as map coordinates do.
///
/// Model   each cloud is scaled from millimetres, centimetres and feet if the two then have similar
///         sizes, and Register aligns the pair again.
std::vector<std::string> RegistrationHints(const std::vector<Vec3>& a_m,
                                           const std::vector<Vec3>& b_m,
                                           const RegistrationRequest& request,
                                           const Registration& found);

}  // namespace tera

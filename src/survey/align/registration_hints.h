#pragma once

#include <string>
#include <vector>

#include "survey/align/registration.h"

namespace tera {

/// Possible reasons why two clouds could not be registered, as sentences. A cloud may fit after a
/// change of its unit of length. Or the clouds may be far apart, because only one of them has map
/// coordinates.
///
/// Model   A cloud is converted from millimetres, centimetres and feet. If the sizes of the clouds
///         are then similar, Register aligns them again.
std::vector<std::string> RegistrationHints(const std::vector<Vec3>& a_m,
                                           const std::vector<Vec3>& b_m,
                                           const RegistrationRequest& request,
                                           const Registration& found);

}  // namespace tera

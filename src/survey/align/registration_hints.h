#pragma once

#include <string>
#include <vector>

#include "survey/align/registration.h"

namespace tera {

/// Why two clouds that were not registered may not lie on each other, as sentences: one of them
/// fits when it is scaled as another unit would scale it, or lies as far from the other as
/// coordinates of a map do.
///
/// Model   each of the two is taken in millimetres, centimetres and feet, where it is then not far
///         smaller or larger than the other, and registered anew, as Register does.
std::vector<std::string> RegistrationHints(const std::vector<Vec3>& a_m,
                                           const std::vector<Vec3>& b_m,
                                           const RegistrationRequest& request,
                                           const Registration& found);

}  // namespace tera

#pragma once

#include <string>

#include "survey/align/registration.h"

namespace tera {

/// registration.json (docs/reference/survey.md): the pose with its covariance, or why there is
/// none.
std::string RegistrationJson(const Registration& registration, const std::string& a,
                             const std::string& b);

}  // namespace tera

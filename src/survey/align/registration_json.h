#pragma once

#include <string>

#include "survey/align/registration.h"

namespace tera {

/// Text of registration.json (docs/reference/survey.md): the pose with its covariance, or the
/// reason why there is none.
std::string RegistrationJson(const Registration& registration, const std::string& a,
                             const std::string& b);

}  // namespace tera

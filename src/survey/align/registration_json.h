#pragma once

#include <string>

#include "survey/align/registration.h"

namespace tera {

/// Text of registration.json (docs/reference/survey.md): the pose and its covariance, or the reason
/// for a failure.
std::string RegistrationJson(const Registration& registration, const std::string& a,
                             const std::string& b);

}  // namespace tera

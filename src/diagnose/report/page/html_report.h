#pragma once

#include <string>

#include "diagnose/diagnosis.h"

namespace tera {

/// The report as one page with embedded styles and figures, without network or scripts, for light
/// screens, dark screens and paper. `recording` is the subtitle.
///
/// Text and figures use degrees. Tables of parameters and sizes use the units of effects.yaml.
std::string HtmlReport(const Diagnosis& diagnosis, const std::string& recording);

}  // namespace tera

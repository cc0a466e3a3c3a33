#pragma once

#include <string>

#include "diagnose/diagnosis.h"

namespace tera {

/// The report as one page without network or scripts. Styles and figures are in it, for light and
/// dark screens and for paper. `recording` stands under the title.
///
/// Text and figures are in degrees; the tables of parameters and sizes are as in effects.yaml.
std::string HtmlReport(const Diagnosis& diagnosis, const std::string& recording);

}  // namespace tera

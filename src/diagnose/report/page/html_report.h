#pragma once

#include <string>

#include "diagnose/diagnosis.h"

namespace tera {

/// A page that says it all and needs nothing else: no network, no script; styles and figures are in
/// it, for light and dark screens and for paper. `recording` stands under the title.
///
/// Text and figures in degrees; the tables of parameters and sizes as in effects.yaml.
std::string HtmlReport(const Diagnosis& diagnosis, const std::string& recording);

}  // namespace tera

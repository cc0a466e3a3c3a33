#pragma once

#include <string>
#include <vector>

#include "layout/layout_report.h"

namespace tera {

/// The answer first: what the layout sees, what it does not and why, people, the bucket.
std::vector<std::string> Answer(const LayoutReport& report);

}  // namespace tera

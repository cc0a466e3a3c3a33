#pragma once

#include <string>
#include <vector>

#include "layout/layout_report.h"

namespace tera {

/// The summary that a report starts with: coverage, blind places and their causes, people, bucket.
std::vector<std::string> Answer(const LayoutReport& report);

}  // namespace tera

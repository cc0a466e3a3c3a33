#pragma once

#include <string>
#include <vector>

#include "layout/layout_report.h"

namespace tera {

/// Summary at the head of a report: coverage, blind places and their causes, people, bucket.
std::vector<std::string> Answer(const LayoutReport& report);

}  // namespace tera

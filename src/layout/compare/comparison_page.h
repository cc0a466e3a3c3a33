#pragma once

#include <string>
#include <vector>

#include "layout/layout_report.h"

namespace tera {

/// An HTML page that compares the first layout with each of the others. It has a summary, a radar
/// chart of the main figures, blind maps with their difference, ranges of person detection, and a
/// table of all figures.
///
/// Throws  InputError as Compare does.
std::string ComparisonPage(const std::vector<LayoutReport>& reports);
/// All figures and their differences as CSV.
std::string ComparisonCsv(const std::vector<LayoutReport>& reports);
/// The summary sentences of the page as plain text for a terminal.
std::vector<std::string> ComparisonWords(const std::vector<LayoutReport>& reports);

}  // namespace tera

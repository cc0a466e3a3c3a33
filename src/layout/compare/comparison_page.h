#pragma once

#include <string>
#include <vector>

#include "layout/layout_report.h"

namespace tera {

/// A page that compares each of the other layouts with the first. It has sentences, a radar chart
/// of the main figures, blind maps with their difference, people, and all figures.
///
/// Throws  InputError as Compare does.
std::string ComparisonPage(const std::vector<LayoutReport>& reports);
/// The table of all figures and differences as CSV.
std::string ComparisonCsv(const std::vector<LayoutReport>& reports);
/// The words alone, for a terminal.
std::vector<std::string> ComparisonWords(const std::vector<LayoutReport>& reports);

}  // namespace tera
